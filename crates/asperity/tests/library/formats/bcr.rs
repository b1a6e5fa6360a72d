//! BCR-STM and BCRF files.

use super::instrument::{Number, assert_heights, read, stored};
use super::refused::Good;
use super::{NX, NY, PIXEL, in_lines, read_head, z};
use asperity::topography::read::ReadOptions;

/// How a header is written.
#[derive(Clone, Copy, PartialEq)]
enum Letters {
    Latin1,
    Utf16,
    /// With a mark of the byte order before it.
    MarkedUtf16,
}

use Letters::{Latin1, MarkedUtf16, Utf16};

/// The lines that every header of these numbers has.
fn header(format: &str, is_intel: bool) -> String {
    format!(
        "fileformat = {format}\n%\n# a comment\nxpixels = {NX}\nypixels = {NY}\nxlength = 10\nylength = 0.012\nxunit = \u{b5}m\n \
         yunit = mm\nzunit = nm\nintelmode = {}\nbit2nm = 0.25\nvoidpixels = 1\nbias = \n",
        u8::from(is_intel)
    )
}

/// A header filled with spaces, then the numbers.
fn of(header: &str, letters: Letters, length: usize, numbers: &[u8]) -> Vec<u8> {
    let text: Vec<char> = header.chars().chain(std::iter::repeat(' ')).take(length).collect();
    let mut bytes = if letters == MarkedUtf16 { vec![0xff, 0xfe] } else { Vec::new() };
    match letters {
        Latin1 => bytes.extend(text.iter().map(|&letter| letter as u8)),
        Utf16 | MarkedUtf16 => bytes.extend(text.iter().flat_map(|&letter| (letter as u16).to_le_bytes())),
    }
    [&bytes, numbers].concat()
}

/// Heights in quarters, with this mark of missing points.
fn numbers<T: Number>(missing: f64, is_intel: bool) -> Vec<u8> {
    stored::<T>(in_lines().map(|z| if z.is_nan() { missing } else { 4.0 * z }), !is_intel)
}

/// A header of usual length, then 16-bit numbers.
fn usual(header: &str) -> Vec<u8> {
    of(header, Latin1, 2048, &numbers::<i16>(32_767.0, true))
}

/// What is changed is the header.
pub fn good() -> Vec<Good> {
    let file = |header| usual(&String::from_utf8(header).unwrap());
    let header = header("bcrstm", true);
    vec![Good { file, truncated: 64..usual(&header).len(), ..Good::whole("bcr", header) }]
}

fn wanted(ix: usize, iy: usize) -> f64 {
    1e-9 * z(ix, iy)
}

#[test]
fn bcr_heights_of_every_kind() {
    for letters in [Latin1, Utf16, MarkedUtf16] {
        let unicode = if letters == Latin1 { "" } else { "_unicode" };
        for is_intel in [true, false] {
            let files = [
                ("bcrstm", numbers::<i16>(32_767.0, is_intel)),
                ("bcrf", numbers::<f32>(f64::from(f32::MAX), is_intel)),
                ("bcrf", numbers::<f32>(1.7e38, is_intel)),
                ("bcrf", numbers::<f32>(f64::NAN, is_intel)),
            ];
            for (format, numbers) in files {
                let header = header(&format!("{format}{unicode}"), is_intel);
                let head = assert_heights(of(&header, letters, 2048, &numbers), None, PIXEL, wanted);
                assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Heights".to_owned()));
                // Headers of other lengths state them.
                for length in [400, 5000] {
                    let stated = header.replacen("%\n", &format!("headersize = {length}\n"), 1);
                    assert_heights(of(&stated, letters, length, &numbers), None, PIXEL, wanted);
                }
            }
        }
    }
}

#[test]
fn bcr_without_units_is_in_nanometres() {
    let header = header("bcrstm", true);
    let bare: String =
        header.lines().filter(|line| !line.contains("unit")).map(|line| format!("{line}\n")).collect();
    assert_heights(usual(&bare), None, [2e-9, 3e-12], wanted);
    let default = bare.replace("bit2nm = 0.25\n", "").replace("intelmode = 1\n", "");
    assert_heights(usual(&default), None, [2e-9, 3e-12], |ix, iy| 4e-9 * z(ix, iy));
    // Without a size the pixel is given.
    let given = ReadOptions { pixel: Some([1e-6; 2]), unit: None };
    let (head, map) = read(usual(&header.replace("xlength = 10", "")), None, given);
    assert_eq!((head.pixel, map.pixel()), (None, [1e-6; 2]));
    // So it is where the size is none of length.
    assert_eq!(read_head(usual(&header.replace("yunit = mm", "yunit = s"))).pixel, None);
}
