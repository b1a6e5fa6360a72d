//! Nanoscope files: versions, sizes, scales, refusals, a file of an instrument.

use super::damage::{cut, damage};
use super::instrument::{assert_heights, filled};
use super::{NX, NY, PIXEL, file};
use asperity::topography::read::{MapFile, ReadOptions, height_map, metadata};

const FACTOR: f64 = 0.25;
/// Bytes of the header of a file with one image.
const HEADER: usize = 1800;

/// A file with one channel or two.
struct Spm {
    version: &'static str,
    pixel_bytes: usize,
    bytes: usize,
    points: [usize; 2],
    /// Of the Ciao scan list.
    scan: &'static str,
    /// Of the image.
    image: &'static str,
    size: &'static str,
    scale: &'static str,
    sensitivity: &'static str,
}

impl Spm {
    fn new() -> Self {
        Self {
            version: "0x09010201",
            pixel_bytes: 2,
            bytes: 2,
            points: [NX, NY],
            scan: "\\Samps/line: 5\r\n\\Lines: 4\r\n\\Aspect Ratio: 1:1\r\n",
            image: "\\Aspect Ratio: 1:1\r\n",
            size: "\\Scan Size: 10 12 ~m",
            scale: "@2:Z scale: V [Sens. Zsens] (0.006 V/LSB) 65536.00 V",
            sensitivity: "@Sens. Zsens: V 0.2500000 nm/V",
        }
    }

    /// A file of images with these names.
    fn with(&self, names: &[&str]) -> Vec<u8> {
        let length = NX * NY * self.bytes;
        let begin = |k: usize| HEADER * names.len() + k * length;
        let mut header = format!(
            "\\*File list\r\n\\Version: {}\r\n\\*Scanner list\r\n\\{}\r\n\\*Ciao scan list\r\n{}",
            self.version, self.sensitivity, self.scan
        );
        for (k, name) in names.iter().enumerate() {
            header += &format!(
                "\\*Ciao image list\r\n\\Data offset: {}\r\n\\Data length: {length}\r\n\\Bytes/pixel: {}\r\n\\Samps/line: {}\r\n\
                 \\Number of lines: {}\r\n{}\r\n{}\\Line Direction: {}\r\n\\{}\r\n\\@2:Image Data: S [X] \"{name}\"\r\n",
                begin(k),
                self.pixel_bytes,
                self.points[0],
                self.points[1],
                self.size,
                self.image,
                ["Retrace", "Trace"][k],
                self.scale,
            );
        }
        let mut bytes: Vec<u8> =
            (header + "\\*File list end\r\n").chars().map(|letter| letter as u8).collect();
        assert!(bytes.len() <= begin(0), "{}", bytes.len());
        bytes.resize(begin(0), 0);
        for k in 0..names.len() {
            for place in 0..NX * NY {
                // Line after line from the bottom; the second channel is ten higher.
                let value = (filled(place % NX, NY - 1 - place / NX) + 10.0 * k as f64) / FACTOR;
                let value = value as i32;
                match self.bytes {
                    2 => bytes.extend((value as i16).to_le_bytes()),
                    _ => bytes.extend(value.to_le_bytes()),
                }
            }
        }
        bytes
    }

    fn bytes(&self) -> Vec<u8> {
        self.with(&["Height"])
    }
}

/// Asserts that a file holds the map in units of `unit` with this pixel.
fn assert_map(bytes: &[u8], unit: f64, pixel: [f64; 2]) {
    assert_heights(bytes, None, pixel, |ix, iy| unit * filled(ix, iy));
}

#[test]
fn numbers_of_16_and_32_bits_in_every_version() {
    let new = Spm::new;
    assert_map(&new().bytes(), 1e-9, PIXEL);
    assert_map(&Spm { version: "0x04320003", ..new() }.bytes(), 1e-9, PIXEL);
    // From version 9.2 on the numbers have four bytes, also where Bytes/pixel is 2.
    assert_map(&Spm { version: "0x09300201", bytes: 4, ..new() }.bytes(), 1e-9, PIXEL);
    assert_map(
        &Spm { version: "0x10000102", bytes: 4, pixel_bytes: 4, ..new() }.bytes(),
        1e-9 / 65536.0,
        PIXEL,
    );
    assert_map(
        &Spm { version: "0x08150300", bytes: 4, pixel_bytes: 4, ..new() }.bytes(),
        1e-9 / 65536.0,
        PIXEL,
    );
    let bytes = [b"\\*EC ", &new().bytes()[2..]].concat();
    // The header is three bytes longer and the padding after it three bytes shorter.
    let padding = bytes.windows(3).position(|three| three == [0; 3]).unwrap();
    assert_map(&[&bytes[..padding], &bytes[padding + 3..]].concat(), 1e-9, PIXEL);
}

#[test]
fn sizes_of_scans() {
    let new = Spm::new;
    let size = |size| Spm { size, ..new() }.bytes();
    assert_map(&size("\\Scan size: 10000 12000 nm"), 1e-9, PIXEL);
    assert_map(&size("\\Scan size: 10 ~m"), 1e-9, [2e-6, 2.5e-6]);
    // A scan of 10 um x 10 um of which a part is in the image.
    let oblong = "\\Aspect Ratio: 0.5\r\n";
    let part = |lines| Spm { image: oblong, scan: lines, size: "\\Scan Size: 10 10 ~m", ..new() }.bytes();
    assert_map(&part("\\Samps/line: 5\r\n\\Lines: 5\r\n\\Aspect Ratio: 1:1\r\n"), 1e-9, [2e-6; 2]);
    assert_map(&part("\\Samps/line: 5\r\n\\Lines: 4\r\n\\Aspect Ratio: 2:1\r\n"), 1e-9, [2e-6; 2]);
    // A scan that was stopped; sizes that stand in the scan list only.
    let valid = "\\Valid data len X: 5\r\n\\Valid data len Y: 4\r\n";
    let stopped = Spm { points: [5, 16], image: valid, scan: "", size: "\\Scan Size: 10 48 ~m", ..new() };
    assert_map(&stopped.bytes(), 1e-9, PIXEL);
    let global = Spm { points: [5, 16], size: "\\Scan Size: 10 48 ~m", ..new() };
    assert_map(&global.bytes(), 1e-9, PIXEL);
}

#[test]
fn scales_of_heights() {
    let new = Spm::new;
    // nm/V times mV.
    let milli = Spm {
        scale: "@2:Z scale: V [Sens. AmplSens] (0.015 mV/LSB) 65536.00 mV",
        sensitivity: "@Sens. AmplSens: V 250.0000 nm/V",
        ..new()
    };
    assert_map(&milli.bytes(), 1e-9, PIXEL);
    // Heights without a sensitivity.
    let hard = Spm { scale: "@2:Z scale: V (0.006 nm/LSB) 16384.00 nm", ..new() };
    assert_map(&hard.bytes(), 1e-9, PIXEL);
    // Other quantities.
    for (scale, sensitivity) in [
        ("[Sens. Phase] (0.005 \u{b0}/LSB) 180.0 \u{b0}", "Sens. Phase: V 1.000000 "),
        ("[Sens. Log] (0.1 log(Arb)/LSB) 32.0 log(Arb)", "Sens. Log: V 1.0 log(Pa)/log(Arb)"),
        ("[Sens. F] (0.1 Arb/LSB) 4096.0 Arb", "Sens. F: V 1.0 N/m*Arb"),
        ("[Sens. Unknown] (0.1 V/LSB) 24.0 V", "Sens. F: V 1.0 N/m*Arb"),
    ] {
        let (of_image, sensitivity) = (format!("@2:Z scale: V {scale}"), format!("@{sensitivity}"));
        let other = Spm { scale: of_image.leak(), sensitivity: sensitivity.leak(), ..new() };
        assert_refused!(Unsupported, other.bytes(), scale);
    }
}

#[test]
fn images_of_one_name_have_their_direction() {
    let (_folder, path) = file(Spm::new().with(&["Height", "Height"]));
    let channel = metadata(&path).unwrap().channel.unwrap();
    assert_eq!(
        (channel.name.as_str(), super::others(&channel).join("")),
        ("Height Trace", "\"Height Retrace\"".to_owned())
    );
    assert_eq!(height_map(&path, ReadOptions::default()).unwrap().heights()[NY] as f32, 11.25e-9);
    let mut retrace = MapFile::new(&path, ReadOptions::default());
    retrace.channel = Some("height retrace".to_owned());
    assert_eq!(retrace.height_map().unwrap().heights()[NY] as f32, 1.25e-9);
    let (_folder, path) = file(Spm::new().with(&["Phase", "Height"]));
    assert_eq!(metadata(&path).unwrap().channel.unwrap().name, "Height");
}

#[test]
fn files_that_are_refused() {
    let new = Spm::new;
    let bytes = new().bytes();
    // The numbers stay in their place.
    let replaced = |from: &str, to: &str| {
        let header = String::from_utf8_lossy(&bytes[..HEADER]).replace(from, to);
        let mut header = header.trim_end_matches('\0').as_bytes().to_vec();
        header.resize(HEADER, 0);
        [&header, &bytes[HEADER..]].concat()
    };
    assert_refused!(Unsupported, "\\*Force file list\r\n\\Version: 0x09010300\r\n");
    assert_refused!(Unsupported, "?*File list\r\n\\Version: 0x04320003\r\n");
    let text = String::from_utf8_lossy(&bytes).replace("\r\n", "\n");
    assert_refused!(Corrupt, text);
    assert_refused!(Corrupt, replaced("File list end", "File list and"));
    assert_refused!(Corrupt, &bytes[..bytes.len() - 1]);
    assert_refused!(Corrupt, {
        let images = "\\*Ciao image list\r\n".repeat(65);
        format!("\\*File list\r\n{images}\\*File list end\r\n")
    });
    assert_refused!(Unsupported, "\\*File list\r\n\\*File list end\r\n");
    assert_refused!(Unsupported, replaced("@2:Z scale: V", "Z scale: 1.5"));
    assert_refused!(Unsupported, Spm { pixel_bytes: 8, ..new() }.bytes());
    assert_refused!(Corrupt, Spm { points: [5, 9], scan: "", ..new() }.bytes());
    assert_refused!(Corrupt, replaced("Samps/line: 5\r\n\\Number", "Samps/line: x\r\n\\Number"));
    assert_refused!(Corrupt, replaced("Data offset", "Data onset"));
    assert_refused!(Corrupt, replaced("10 12 ~m", "10 12 parsec"));
    assert_refused!(Corrupt, replaced("10 12 ~m", "x 12 ~m"));
    assert_refused!(Corrupt, replaced("10 12 ~m", "0 12 ~m"));
    assert_refused!(Corrupt, replaced("65536.00 V", "x V"));
    assert_refused!(Corrupt, replaced("V 0.2500000", "V x"));
    cut(&bytes, 0..2000);
    damage(&bytes);
    damage(&new().with(&["Height", "Height"]));
}
