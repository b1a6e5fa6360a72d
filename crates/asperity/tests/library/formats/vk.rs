//! Keyence files.

use std::io::{Cursor, Write};

use super::instrument::{Bytes, Number, assert_heights, filled, read, stored};
use super::refused::Good;
use super::{AS_IT_IS, NX, NY, PIXEL, channels};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Heights are not negative: stored from the lowest of the map.
const LOWEST: f64 = -13.5;
const STEP: f64 = 250e-9;

/// A file of this version with a picture of heights of the type `T` and one of light.
fn vk<T: Number>(version: u8) -> Vec<u8> {
    let places = if version == 4 { 18 } else { 17 };
    let conditions = 12 + 4 * places;
    let mut header = Bytes::new(conditions + 320, false);
    header.text(0, [b'V', b'K', b'0' + version, b'_']);
    for (axis, length) in [PIXEL[0], PIXEL[1], STEP].into_iter().enumerate() {
        header.put(conditions + 168 + 4 * axis, (length * 1e12).round() as u32);
    }
    let light = picture::<u16>(|_, _| 7.0);
    header.put(12 + 4 * 3, (conditions + 320) as u32);
    header.put(12 + 4 * 6, (conditions + 320 + light.len()) as u32);
    let heights = picture::<T>(|ix, iy| (filled(ix, iy) - LOWEST) / 0.25);
    [header.bytes, light, heights].concat()
}

fn picture<T: Number>(of: impl Fn(usize, usize) -> f64) -> Vec<u8> {
    let numbers = stored::<T>((0..NX * NY).map(|k| of(k % NX, k / NX)), false);
    let bits = 8 * numbers.len() / (NX * NY);
    let sizes = [NX, NY, bits, 1, numbers.len(), 0, 0].map(|size| (size as u32).to_le_bytes()).concat();
    [sizes, vec![0; 768], numbers].concat()
}

/// The same within a zip archive behind a picture, as versions 6 and 7 are.
fn packed(version: u8, inner: &[u8]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file("Vk4File", SimpleFileOptions::default()).unwrap();
    archive.write_all(inner).unwrap();
    let archive = archive.finish().unwrap().into_inner();
    [&[b'V', b'K', b'0' + version], &b"a picture"[..], &archive].concat()
}

pub fn good() -> Vec<Good> {
    let whole = vk::<u16>(4);
    vec![
        Good { file: |inner| packed(6, &inner), ..Good::whole("vk packed", &*whole) },
        Good::whole("vk of zeros", packed(7, &vec![0; 1 << 20])),
        Good { truncated: whole.len() - 2 * NX * NY..whole.len(), ..Good::whole("vk", whole) },
    ]
}

#[test]
fn vk_heights_of_every_version_and_type() {
    let wanted = |ix: usize, iy: usize| 1e-6 * (filled(ix, iy) - LOWEST);
    for version in [3, 4] {
        for bytes in [vk::<u8>(version), vk::<u16>(version), vk::<u32>(version)] {
            assert_heights(&bytes, None, PIXEL, wanted);
            assert_eq!(channels(&bytes), ["Height", "\"Light\" (grey)"]);
        }
    }
    for version in [6, 7] {
        assert_heights(packed(version, &vk::<u32>(4)), None, PIXEL, wanted);
    }
    assert_eq!(read(vk::<u16>(4), Some("height"), AS_IT_IS).1.heights().len(), NX * NY);
}
