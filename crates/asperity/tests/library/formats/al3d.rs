//! Alicona files.

use super::instrument::{assert_heights, stored};
use super::refused::Good;
use super::{NX, NY, PIXEL, in_lines, z};

/// Bytes of the magic and of a tag.
const MAGIC: usize = 17;
const TAG: usize = 52;
/// Where the depth image begins.
const DEPTH: usize = MAGIC + 10 * TAG;
/// In single precision 3e15.
const MISSING: &str = "3.000000028082e+15";
const TITLE: (&str, &str) = ("Title", "a map");

/// A tag: a key of 20 bytes, a value of 30, and the end of a line.
fn tag(key: &str, value: &str) -> Vec<u8> {
    let mut bytes = vec![0; TAG];
    bytes[..key.len()].copy_from_slice(key.as_bytes());
    bytes[20..20 + value.len()].copy_from_slice(value.as_bytes());
    bytes[50..].copy_from_slice(b"\r\n");
    bytes
}

/// A file with this mark of missing points and one tag more; `depth` follows the tags.
fn al3d(missing: &str, last: (&str, &str), depth: &[u8]) -> Vec<u8> {
    let tags: Vec<u8> = [
        ("Version", "1"),
        ("TagCount", "8"),
        ("CreatingApplication", "a test"),
        ("Cols", &NX.to_string()),
        ("Rows", &NY.to_string()),
        ("PixelSizeXMeter", &format!("{:e}", PIXEL[0])),
        ("PixelSizeYMeter", &PIXEL[1].to_string()),
        ("InvalidPixelValue", missing),
        ("DepthImageOffset", &DEPTH.to_string()),
        last,
    ]
    .iter()
    .flat_map(|(key, value)| tag(key, value))
    .collect();
    [b"AliconaImaging\0\r\n", &tags[..], depth].concat()
}

/// The depth image with this mark of missing points, and bytes between its lines.
fn depth(missing: f32, gap: usize) -> Vec<u8> {
    let numbers = in_lines()
        .flat_map(|z| if z.is_nan() { missing } else { z as f32 * 1e-9 }.to_le_bytes())
        .collect::<Vec<_>>();
    numbers.chunks(4 * NX).flat_map(|line| [line, &vec![255; gap]].concat()).collect()
}

/// Cut in its numbers, lines are not taken for packed ones.
pub fn good() -> Vec<Good> {
    let whole = al3d(MISSING, TITLE, &depth(0.0, 4));
    vec![Good { truncated: MAGIC..DEPTH + 4 * NX * NY, ..Good::whole("al3d", whole) }]
}

fn wanted(ix: usize, iy: usize) -> f64 {
    f64::from(z(ix, iy) as f32 * 1e-9)
}

#[test]
fn al3d_heights_with_lines_of_every_kind() {
    let mark = 3e15;
    // Lines begin at multiples of eight bytes, of which there are three here, ...
    let padded = al3d(MISSING, TITLE, &[depth(mark, 4), vec![0; 8]].concat());
    // ... but not where the end of the file, or the texture, says that they do not.
    let packed = al3d(MISSING, TITLE, &depth(mark, 0));
    let texture = (DEPTH + 4 * NX * NY).to_string();
    let textured = al3d(MISSING, ("TextureImageOffset", &texture), &[depth(mark, 0), vec![0; 60]].concat());
    for bytes in [padded, packed, textured] {
        let head = assert_heights(bytes, None, PIXEL, wanted);
        assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Depth".to_owned()));
    }
    // Points that are no number are missing with any mark.
    assert_heights(al3d("nan", TITLE, &depth(f32::NAN, 0)), None, PIXEL, wanted);
    let whole = stored::<f32>(std::iter::repeat_n(1.0, NX * NY), false);
    assert_heights(al3d("-1", TITLE, &whole), None, PIXEL, |_, _| 1.0);
}
