//! What the tests of instruments' files share: bytes at given places, numbers of every type, and the map that must come back.

use std::io::Write;

use super::{AS_IT_IS, NX, NY, file, z};
use asperity::topography::Rows;
use asperity::topography::read::{MapFile, Metadata, ReadOptions};

/// A number of a file.
pub trait Number: Copy {
    fn of(value: f64) -> Self;
    fn bytes(self, big_endian: bool) -> Vec<u8>;
}

macro_rules! number {
    ($($kind:ty)*) => {$(
        impl Number for $kind {
            fn of(value: f64) -> Self {
                value as $kind
            }

            fn bytes(self, big_endian: bool) -> Vec<u8> {
                if big_endian { self.to_be_bytes().to_vec() } else { self.to_le_bytes().to_vec() }
            }
        }
    )*};
}
number! { u8 u16 u32 u64 i8 i16 i32 i64 f32 f64 }

/// A header: zeros, and what is put between them.
pub struct Bytes {
    pub bytes: Vec<u8>,
    big_endian: bool,
}

impl Bytes {
    pub fn new(count: usize, big_endian: bool) -> Self {
        Self { bytes: vec![0; count], big_endian }
    }

    pub fn put(&mut self, at: usize, number: impl Number) {
        self.text(at, number.bytes(self.big_endian));
    }

    pub fn text(&mut self, at: usize, text: impl AsRef<[u8]>) {
        let text = text.as_ref();
        self.bytes[at..at + text.len()].copy_from_slice(text);
    }
}

/// Heights as numbers of a type.
pub fn stored<T: Number>(heights: impl Iterator<Item = f64>, big_endian: bool) -> Vec<u8> {
    heights.flat_map(|height| T::of(height).bytes(big_endian)).collect()
}

/// A text with changes.
pub fn edited(text: &str, changes: &[[&str; 2]]) -> String {
    changes.iter().fold(text.to_owned(), |text, [old, new]| {
        assert!(text.contains(old), "no {old} in {text}");
        text.replace(old, new)
    })
}

/// Bytes that are packed by zlib.
pub fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// The height of the point that is missing, in files that cannot say so.
const FILLED: f64 = 5.0;

/// The map with that point filled.
pub fn filled(ix: usize, iy: usize) -> f64 {
    if z(ix, iy).is_nan() { FILLED } else { z(ix, iy) }
}

/// Lines along x, the bottom one first.
pub fn upwards() -> impl Iterator<Item = [usize; 2]> {
    (0..NX * NY).map(|k| [k % NX, NY - 1 - k / NX])
}

/// Reads a channel; the size of the header is that of the map.
pub fn read(
    bytes: impl AsRef<[u8]>,
    channel: Option<&str>,
    given: ReadOptions,
) -> (Metadata, asperity::HeightMap) {
    let (_folder, path) = file(bytes);
    let file = MapFile { channel: channel.map(str::to_owned), ..MapFile::new(&path, given) };
    let (head, map) = (file.metadata().unwrap(), file.height_map().unwrap());
    assert_eq!((head.points, map.points()), ([NX, NY], [NX, NY]));
    (head, map)
}

/// Asserts the pixel and the heights of a channel, with the offset of its file.
pub fn assert_heights(
    bytes: impl AsRef<[u8]>,
    channel: Option<&str>,
    pixel: [f64; 2],
    wanted: impl Fn(usize, usize) -> f64,
) -> Metadata {
    let (head, map) = read(bytes, channel, AS_IT_IS);
    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 4e-15 * scale;
    assert!(map.pixel().iter().zip(pixel).all(|(&a, b)| close(a, b, b)), "{:?} {pixel:?}", map.pixel());
    let wanted: Vec<f64> = (0..NX * NY).map(|k| wanted(k / NY, k % NY)).collect();
    let largest = wanted.iter().fold(0.0f64, |largest, z| largest.max(z.abs()));
    for (k, (found, wanted)) in map.heights().iter().zip(wanted).enumerate() {
        let found = found + map.offset();
        let same = close(found, wanted, largest) || found.is_nan() && wanted.is_nan();
        assert!(same, "x {} y {}: {found} {wanted}", k / NY, k % NY);
    }
    head
}
