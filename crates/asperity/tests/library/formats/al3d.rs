//! Alicona files.

use super::damage::assert_no_panic;
use super::instrument::{assert_heights, stored};
use super::{NX, NY, PIXEL, assert_truncated, in_lines, z};

/// Bytes of the magic and of a tag.
const MAGIC: usize = 17;
const TAG: usize = 52;
const MISSING: &str = "3.000000028082e+15";

/// A tag: a key of 20 bytes, a value of 30, and the end of a line.
fn tag(key: &str, value: &str) -> Vec<u8> {
    let mut bytes = vec![0; TAG];
    bytes[..key.len()].copy_from_slice(key.as_bytes());
    bytes[20..20 + value.len()].copy_from_slice(value.as_bytes());
    bytes[50..].copy_from_slice(b"\r\n");
    bytes
}

/// A file with these tags beside those that say how many there are; `depth` follows them.
fn of(tags: &[(&str, &str)], depth: &[u8]) -> Vec<u8> {
    let count = tags.len().to_string();
    let head = [("Version", "1"), ("TagCount", &count)];
    let tags: Vec<u8> = head.iter().chain(tags).flat_map(|(key, value)| tag(key, value)).collect();
    [b"AliconaImaging\0\r\n", &tags[..], depth].concat()
}

/// The tags of the map, its depth image behind `count` of them.
fn tags(count: usize) -> Vec<(&'static str, String)> {
    vec![
        ("CreatingApplication", "a test".to_owned()),
        ("Cols", NX.to_string()),
        ("Rows", NY.to_string()),
        ("PixelSizeXMeter", format!("{:e}", PIXEL[0])),
        ("PixelSizeYMeter", PIXEL[1].to_string()),
        ("InvalidPixelValue", MISSING.to_owned()),
        ("DepthImageOffset", (MAGIC + TAG * (count + 2)).to_string()),
    ]
}

/// A file where the value of a tag is another, or with a tag more.
fn with(key: &str, value: &str, depth: &[u8]) -> Vec<u8> {
    let is_new = tags(0).iter().all(|(found, _)| *found != key);
    let tags = tags(if is_new { 8 } else { 7 });
    let mut tags: Vec<(&str, &str)> = tags.iter().map(|(key, value)| (*key, value.as_str())).collect();
    if is_new {
        tags.push((key, value));
    } else if let Some(tag) = tags.iter_mut().find(|tag| tag.0 == key) {
        tag.1 = value;
    }
    of(&tags, depth)
}

/// The depth image with this mark of missing points, and bytes between its lines.
fn depth(missing: f32, gap: usize) -> Vec<u8> {
    let numbers = in_lines()
        .flat_map(|z| if z.is_nan() { missing } else { z as f32 * 1e-9 }.to_le_bytes())
        .collect::<Vec<_>>();
    numbers.chunks(4 * NX).flat_map(|line| [line, &vec![255; gap]].concat()).collect()
}

fn wanted(ix: usize, iy: usize) -> f64 {
    f64::from(z(ix, iy) as f32 * 1e-9)
}

#[test]
fn al3d_heights_with_lines_of_every_kind() {
    // The mark is rounded in the tag.
    let mark = 3e15;
    // Lines begin at multiples of eight bytes, of which there are three here, ...
    let padded = with("Title", "a map", &[depth(mark, 4), vec![0; 8]].concat());
    // ... but not where the end of the file, or the texture, says that they do not.
    let packed = with("Title", "a map", &depth(mark, 0));
    let start = MAGIC + TAG * 10 + 4 * NX * NY;
    let textured = with("TextureImageOffset", &start.to_string(), &[depth(mark, 0), vec![0; 60]].concat());
    for bytes in [&padded, &packed, &textured] {
        let head = assert_heights(bytes, None, PIXEL, wanted);
        assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Depth".to_owned()));
        assert_no_panic(bytes);
    }
    // Points that are no number are missing with any mark.
    assert_heights(with("InvalidPixelValue", "nan", &depth(f32::NAN, 0)), None, PIXEL, wanted);
    let whole = stored::<f32>(std::iter::repeat_n(1.0, NX * NY), false);
    assert_heights(with("InvalidPixelValue", "-1", &whole), None, PIXEL, |_, _| 1.0);
}

#[test]
fn bad_al3d_is_refused() {
    let image = depth(0.0, 0);
    let bad = |key: &str, value: &str| with(key, value, &image);
    for (key, value) in
        [("Cols", "five"), ("Rows", "-4"), ("PixelSizeXMeter", ""), ("DepthImageOffset", "1.5")]
    {
        assert_refused!(Corrupt, bad(key, value), key);
    }
    for key in ["Cols", "Rows", "PixelSizeYMeter", "DepthImageOffset"] {
        let tags = tags(6);
        let kept = tags.iter().filter(|tag| tag.0 != key).map(|(key, value)| (*key, value.as_str()));
        assert_refused!(Corrupt, of(&kept.collect::<Vec<_>>(), &image), key);
    }
    assert_refused!(Unsupported, bad("DepthImageOffset", "0"));
    assert_refused!(Corrupt, bad("Cols", "0"));
    assert_refused!(Corrupt, bad("PixelSizeXMeter", "-1"));
    let huge = u64::MAX.to_string();
    assert_refused!(Corrupt, bad("Cols", &huge));
    assert_refused!(Corrupt, bad("DepthImageOffset", &huge));
    assert_refused!(Corrupt, bad("Rows", "1000000"));
    assert_refused!(Corrupt, &of(&[], &[])[..MAGIC + TAG]);
    let mut many = of(&[], &image);
    many[MAGIC + TAG + 20..MAGIC + TAG + 25].copy_from_slice(b"99999");
    assert_refused!(Corrupt, many);
    let mut more = of(&[], &image);
    more[MAGIC + TAG + 20..MAGIC + TAG + 40].copy_from_slice(huge.as_bytes());
    assert_refused!(Corrupt, more);
    // Cut in its numbers, lines are not taken for packed ones.
    let whole = with("Title", "a map", &depth(0.0, 4));
    assert_truncated(&whole, MAGIC..MAGIC + TAG * 10 + 4 * NX * NY);
}
