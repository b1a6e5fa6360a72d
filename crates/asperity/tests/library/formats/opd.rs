//! Wyko files.

use super::instrument::{Bytes, Number, assert_heights, filled, stored};
use super::refused::Good;
use super::{NX, NY, channels, z};

/// A pixel of 2 um x 3 um, in single precision.
const PIXEL_MM: f32 = 2e-3;
const ASPECT: f32 = 1.5;
/// Two heights to a wave.
const WAVE_NM: f32 = 500.0;
const ARRAY: u16 = 3;

fn pixel() -> [f64; 2] {
    [1e-3 * f64::from(PIXEL_MM), 1.5e-3 * f64::from(PIXEL_MM)]
}

type Block = (&'static str, u16, Vec<u8>);

fn opd(blocks: &[Block]) -> Vec<u8> {
    let mut bytes = vec![1, 0];
    let directory = ("Directory", 1, vec![0; 24 * (blocks.len() + 1)]);
    for (name, kind, content) in [&directory].into_iter().chain(blocks) {
        let mut entry = Bytes::new(24, false);
        entry.text(0, name);
        entry.put(16, *kind);
        entry.put(18, content.len() as u32);
        entry.put(22, 0xffffu16);
        bytes.extend(entry.bytes);
    }
    blocks.iter().for_each(|(.., content)| bytes.extend(content));
    bytes
}

fn float(name: &'static str, value: f32) -> Block {
    (name, 7, value.to_le_bytes().to_vec())
}

fn mult(value: u16) -> Block {
    ("Mult", 6, value.to_le_bytes().to_vec())
}

/// An array of numbers, column after column from the bottom.
fn array<T: Number>(name: &'static str, heights: impl Fn(usize, usize) -> f64) -> Block {
    let numbers = stored::<T>((0..NX * NY).map(|k| heights(k / NY, NY - 1 - k % NY)), false);
    let head = [NX as u16, NY as u16, size_of::<T>() as u16].map(u16::to_le_bytes).concat();
    (name, ARRAY, [head, numbers].concat())
}

/// A file of these blocks and those that every file has.
fn with(blocks: impl IntoIterator<Item = Block>) -> Vec<u8> {
    let mut all = vec![("Title", 5, b"a map".to_vec()), ("Empty", 5, Vec::new())];
    all.extend(blocks);
    all.extend([float("Pixel_size", PIXEL_MM), float("Wavelength", WAVE_NM), float("Aspect", ASPECT)]);
    opd(&all)
}

pub fn good() -> Vec<Good> {
    let whole = with([array::<f32>("Raw", filled), mult(1)]);
    vec![Good { truncated: 13..whole.len(), ..Good::whole("opd", whole) }]
}

fn or(missing: f64, height: f64) -> f64 {
    if height.is_nan() { missing } else { height }
}

#[test]
fn opd_heights_of_every_type() {
    let wave = 1e-9 * f64::from(WAVE_NM);
    for (name, missing) in [("Raw", 1e38), ("RAW_DATA", 2e38), ("RAW DATA", f64::NAN), ("OPD", f64::INFINITY)]
    {
        let bytes = with([array::<f32>(name, |ix, iy| or(missing, z(ix, iy)))]);
        let head = assert_heights(bytes, None, pixel(), |ix, iy| z(ix, iy) * wave);
        assert_eq!(head.channel.unwrap().name, name);
    }
    for missing in [32_766.0, 32_767.0] {
        let numbers = array::<i16>("SAMPLE_DATA", |ix, iy| or(missing, 4.0 * z(ix, iy)));
        assert_heights(with([mult(4), numbers]), None, pixel(), |ix, iy| z(ix, iy) * wave);
    }
    // Bytes have no mark of missing points and no sign.
    let bytes = with([array::<u8>("Raw", |ix, iy| 4.0 * filled(ix, iy) + 54.0), mult(4)]);
    assert_heights(bytes, None, pixel(), |ix, iy| (filled(ix, iy) + 13.5) * wave);
    // Without an aspect ratio the pixel is a square.
    let square = opd(&[array::<f32>("Raw", filled), float("Wavelength", 1.0), float("Pixel_size", PIXEL_MM)]);
    assert_heights(square, None, [pixel()[0]; 2], |ix, iy| filled(ix, iy) * 1e-9);
}

#[test]
fn opd_channels_are_its_arrays() {
    let bytes = with([
        array::<u8>("Image", |_, _| 1.0),
        ("Other", ARRAY, vec![1; 9]),
        array::<f32>("RAW_DATA", |ix, iy| filled(ix, iy) + 1.0),
        array::<f32>("RAW DATA", filled),
    ]);
    assert_eq!(channels(&bytes), ["RAW_DATA", "\"Image\" (grey)", "\"RAW DATA\""]);
    assert_heights(&bytes, Some("raw data"), pixel(), |ix, iy| filled(ix, iy) * 5e-7);
}
