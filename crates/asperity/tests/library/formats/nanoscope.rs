//! Nanoscope files: versions, sizes, scales.

use super::instrument::{assert_heights, edited, filled, stored, upwards};
use super::refused::Good;
use super::{NX, NY, PIXEL, channels};

const FACTOR: f64 = 0.25;
/// Bytes of the header of a file with one image.
const HEADER: usize = 1800;

/// The header of images with these names, with changes to its text.
fn header(names: &[&str], bytes: usize, changes: &[[&str; 2]]) -> String {
    let length = NX * NY * bytes;
    let image = |(k, name): (usize, &&str)| {
        format!(
            "\\*Ciao image list\r\n\\Data offset: {}\r\n\\Data length: {length}\r\n\\Bytes/pixel: 2\r\n\\Samps/line: {NX}\r\n\
             \\Number of lines: {NY}\r\n\\Scan Size: 10 12 ~m\r\n\\Aspect Ratio: 1:1\r\n\\Line Direction: {}\r\n\
             \\@2:Z scale: V [Sens. Zsens] (0.006 V/LSB) 65536.00 V\r\n\\@2:Image Data: S [X] \"{name}\"\r\n",
            HEADER * names.len() + k * length,
            ["Retrace", "Trace"][k],
        )
    };
    let images: String = names.iter().enumerate().map(image).collect();
    let text = format!(
        "\\*File list\r\n\\Version: 0x09010201\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 0.2500000 nm/V\r\n\\*Ciao scan list\r\n\
         \\Samps/line: 5\r\n\\Lines: 4\r\n\\Aspect Ratio: 1:1\r\n{images}\\*File list end\r\n"
    );
    edited(&text, changes)
}

/// A file of one image of 16-bit numbers.
fn spm(changes: &[[&str; 2]]) -> Vec<u8> {
    whole(&header(&["Height"], 2, changes), 1, 2)
}

/// A header, filled up, and numbers of images; those of the second are ten higher.
fn whole(header: &str, images: usize, bytes: usize) -> Vec<u8> {
    let mut all: Vec<u8> = header.chars().map(|letter| letter as u8).collect();
    assert!(all.len() <= HEADER * images, "{}", all.len());
    all.resize(HEADER * images, 0);
    for k in 0..images {
        let numbers = upwards().map(|[ix, iy]| (filled(ix, iy) + 10.0 * k as f64) / FACTOR);
        all.extend(if bytes == 2 { stored::<i16>(numbers, false) } else { stored::<i32>(numbers, false) });
    }
    all
}

/// What is changed is the header.
pub fn good() -> Vec<Good> {
    let file = |header| whole(&String::from_utf8(header).unwrap(), 1, 2);
    let header = header(&["Height"], 2, &[]);
    let images = "\\*Ciao image list\r\n".repeat(65);
    vec![
        Good { file, truncated: 100..HEADER + 2 * NX * NY, ..Good::whole("nanoscope", header) },
        Good::whole("nanoscope of many images", format!("\\*File list\r\n{images}\\*File list end\r\n")),
    ]
}

/// Asserts that a file holds the map in units of `unit` with this pixel.
fn assert_map(bytes: &[u8], unit: f64, pixel: [f64; 2]) {
    assert_heights(bytes, None, pixel, |ix, iy| unit * filled(ix, iy));
}

#[test]
fn numbers_of_16_and_32_bits_in_every_version() {
    assert_map(&spm(&[]), 1e-9, PIXEL);
    assert_map(&spm(&[["0x09010201", "0x04320003"]]), 1e-9, PIXEL);
    // From version 9.2 on the numbers have four bytes, also where Bytes/pixel is 2.
    for (version, pixel, unit) in [
        ("0x09300201", "pixel: 2", 1e-9),
        ("0x10000102", "pixel: 4", 1e-9 / 65536.0),
        ("0x08150300", "pixel: 4", 1e-9 / 65536.0),
    ] {
        let changes = [["0x09010201", version], ["pixel: 2", pixel]];
        assert_map(&whole(&header(&["Height"], 4, &changes), 1, 4), unit, PIXEL);
    }
    assert_map(&spm(&[["\\*File list\r\n\\V", "\\*EC File list\r\n\\V"]]), 1e-9, PIXEL);
}

#[test]
fn sizes_of_scans() {
    let size = "Scan Size: 10 12 ~m";
    assert_map(&spm(&[[size, "Scan size: 10000 12000 nm"]]), 1e-9, PIXEL);
    assert_map(&spm(&[[size, "Scan size: 10 ~m"]]), 1e-9, [2e-6, 2.5e-6]);
    // A scan of 10 um x 10 um of which a part is in the image.
    let scan = "Lines: 4\r\n\\Aspect Ratio: 1:1\r\n\\*Ciao";
    let part = ["~m\r\n\\Aspect Ratio: 1:1", "~m\r\n\\Aspect Ratio: 0.5"];
    for of_scan in
        ["Lines: 5\r\n\\Aspect Ratio: 1:1\r\n\\*Ciao", "Lines: 4\r\n\\Aspect Ratio: 2:1\r\n\\*Ciao"]
    {
        assert_map(&spm(&[[size, "Scan Size: 10 10 ~m"], part, [scan, of_scan]]), 1e-9, [2e-6; 2]);
    }
    // A scan that was stopped; sizes that stand in the scan list only.
    let (stopped, size) = (["lines: 4", "lines: 16"], [size, "Scan Size: 10 48 ~m"]);
    let valid =
        ["\\Aspect Ratio: 1:1\r\n\\Line D", "\\Valid data len X: 5\r\n\\Valid data len Y: 4\r\n\\Line D"];
    let none = ["\\Samps/line: 5\r\n\\Lines: 4\r\n\\Aspect Ratio: 1:1\r\n\\*Ciao", "\\*Ciao"];
    assert_map(&spm(&[stopped, size, valid, none]), 1e-9, PIXEL);
    assert_map(&spm(&[stopped, size]), 1e-9, PIXEL);
}

#[test]
fn scales_of_heights() {
    let scale = "[Sens. Zsens] (0.006 V/LSB) 65536.00 V";
    // nm/V times mV.
    let sensitivity = ["Sens. Zsens: V 0.2500000 nm/V", "Sens. AmplSens: V 250.0000 nm/V"];
    let milli = [scale, "[Sens. AmplSens] (0.015 mV/LSB) 65536.00 mV"];
    assert_map(&spm(&[sensitivity, milli]), 1e-9, PIXEL);
    // Heights without a sensitivity.
    assert_map(&spm(&[[scale, "(0.006 nm/LSB) 16384.00 nm"]]), 1e-9, PIXEL);
}

#[test]
fn images_of_one_name_have_their_direction() {
    let both = |names| whole(&header(names, 2, &[]), 2, 2);
    let heights = both(&["Height", "Height"]);
    assert_eq!(channels(&heights), ["Height Trace", "\"Height Retrace\""]);
    for (channel, higher) in [(None, 10.0), (Some("height retrace"), 0.0)] {
        assert_heights(&heights, channel, PIXEL, |ix, iy| 1e-9 * (filled(ix, iy) + higher));
    }
    assert_eq!(channels(both(&["Phase", "Height"]))[0], "Height");
}
