//! Digital Surf files.

use std::io::Write;

use super::damage::assert_no_panic;
use super::instrument::{Bytes, Number, assert_heights, filled, read, stored};
use super::{NX, NY, assert_truncated, file, in_lines, z};
use asperity::topography::read::{MapFile, ReadOptions};

/// A header and what follows it.
struct Sur {
    big_endian: bool,
    objects: u16,
    kind: u16,
    bits: u16,
    name: &'static str,
    /// Of x, y and z.
    steps: [f32; 3],
    units: [&'static [u8]; 3],
    offset: f32,
    /// The least height, where missing points are marked.
    least: Option<i32>,
    size: [i32; 2],
    numbers: Vec<u8>,
    /// The streams that the numbers are packed in.
    streams: usize,
}

impl Sur {
    /// Heights in quarters of a nanometre, and a mark two steps below the least.
    fn of<T: Number>(big_endian: bool) -> Self {
        let least = -54;
        let number = |z: f64| if z.is_nan() { f64::from(least - 2) } else { 4.0 * z };
        Self {
            big_endian,
            objects: 1,
            kind: 2,
            bits: 8 * size_of::<T>() as u16,
            name: "Topography",
            steps: [2.0, 3e-3, 0.25],
            units: [b"\xb5m", b"mm", b"nm"],
            offset: 8.0,
            least: Some(least),
            size: [NX as i32, NY as i32],
            numbers: stored::<T>(in_lines().map(number), big_endian),
            streams: 0,
        }
    }

    fn changed(mut self, change: impl Fn(&mut Self)) -> Self {
        change(&mut self);
        self
    }

    fn bytes(&self) -> Vec<u8> {
        let mut header = Bytes::new(512, self.big_endian);
        header.text(0, if self.streams > 0 { "DSCOMPRESSED" } else { "DIGITAL SURF" });
        header.put(12, if self.big_endian { 257u16 } else { 0 });
        header.put(14, self.objects);
        header.put(18, self.kind);
        header.text(20, "the object");
        header.put(86, u16::from(self.least.is_some()));
        header.put(98, self.bits);
        header.put(100, self.least.unwrap_or(0));
        for axis in 0..3 {
            header.put(120 + 4 * axis, self.steps[axis]);
            header.text(180 + 16 * axis, self.units[axis]);
        }
        header.put(108, self.size[0]);
        header.put(112, self.size[1]);
        header.text(164, self.name);
        header.put(334, 3u16);
        header.put(336, 4u16);
        header.put(474, self.offset);
        let packed = self.packed();
        header.put(324, packed.len() as u32);
        let numbers = if self.streams > 0 { &packed } else { &self.numbers };
        [&header.bytes[..], b"abcdefg", numbers].concat()
    }

    fn packed(&self) -> Vec<u8> {
        let (mut directory, mut all) = ((self.streams as u32).bytes(self.big_endian), Vec::new());
        for part in self.numbers.chunks(self.numbers.len().div_ceil(self.streams.max(1))) {
            let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            encoder.write_all(part).unwrap();
            let packed = encoder.finish().unwrap();
            let lengths = [part.len() as u32, packed.len() as u32];
            directory.extend(lengths.map(|length| length.bytes(self.big_endian)).concat());
            all.extend(packed);
        }
        [directory, all].concat()
    }
}

fn pixel() -> [f64; 2] {
    [2e-6, 1e-3 * f64::from(3e-3f32)]
}

#[test]
fn sur_heights_of_every_type() {
    for sur in [Sur::of::<i16>, Sur::of::<i32>] {
        for big_endian in [false, true] {
            let bytes = sur(big_endian).bytes();
            let head = assert_heights(bytes, None, pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
            assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Topography".to_owned()));
        }
        for (streams, big_endian) in [(1, false), (3, false), (2, true)] {
            let bytes = sur(big_endian).changed(|sur| sur.streams = streams).bytes();
            assert_heights(bytes, None, pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
        }
    }
    // Where no points are marked, all numbers are heights.
    let bytes = Sur::of::<i16>(false).changed(|sur| sur.least = None).bytes();
    let wanted = |ix, iy| 1e-9 * (if z(ix, iy).is_nan() { -14.0 } else { z(ix, iy) } + 8.0);
    assert_heights(&bytes, None, pixel(), wanted);
    // A mark that is given is a number as it is stored.
    let (_folder, path) = file(&bytes);
    let given = MapFile { missing: super::marks(&[-56.0]), ..MapFile::new(&path, ReadOptions::default()) };
    assert!(given.height_map().unwrap().heights()[3 * NY + 1].is_nan());
}

#[test]
fn sur_of_several_objects() {
    for streams in [0, 2] {
        let first =
            Sur::of::<i32>(false).changed(|sur| (sur.objects, sur.name, sur.streams) = (3, "", streams));
        let numbers = stored::<i16>((0..NX * NY).map(|k| filled(k % NX, k / NX) * 4.0), false);
        let second = Sur { numbers, least: None, streams, ..Sur::of::<i16>(false) };
        let third = Sur::of::<i16>(false).changed(|sur| (sur.name, sur.units[2]) = ("Light", b"V"));
        // What follows the objects that are read is left.
        let bytes = [first.bytes(), second.bytes(), third.bytes(), b"and more".to_vec()].concat();
        let (head, _) = read(&bytes, None, ReadOptions::default());
        assert_eq!(super::others(&head.channel.unwrap()), ["\"the object\"", "\"Light\" (V)"]);
        assert_heights(&bytes, Some("THE object"), pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
        assert_heights(&bytes, Some("Topography"), pixel(), |ix, iy| 1e-9 * (filled(ix, iy) + 8.0));
        assert_no_panic(&bytes);
    }
}

/// A unit that is given is that of the heights of a file that states the one of its pixel only.
#[test]
fn sur_without_a_unit_takes_one() {
    let bytes = Sur::of::<i16>(false).changed(|sur| sur.units[2] = b"").bytes();
    let (_folder, path) = file(bytes);
    let read = |unit| super::height_map(&path, ReadOptions { pixel: None, unit: Some(unit) }).unwrap();
    let (map, same) = (read(super::LengthUnits::same(1e-9)), read(super::LengthUnits::same(1e-6)));
    assert_eq!((map.pixel(), same.pixel()), (pixel(), pixel()));
    assert!((same.heights()[NY] / map.heights()[NY] / 1e3 - 1.0).abs() < 1e-12);
    assert!((map.heights()[0] - map.heights()[NY] - 1e-9 * (z(0, 0) - z(1, 0))).abs() < 1e-15);
}

#[test]
fn bad_sur_is_refused() {
    let with = |change: fn(&mut Sur)| Sur::of::<i16>(false).changed(change).bytes();
    for kind in [4, 14, 18, 21] {
        assert_refused!(Unsupported, Sur::of::<i16>(false).changed(|sur| sur.kind = kind).bytes(), kind);
    }
    assert_refused!(Unsupported, with(|sur| (sur.kind, sur.size[1]) = (1, 1)));
    assert_heights(with(|sur| sur.kind = 1), None, pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
    assert_refused!(Unsupported, with(|sur| sur.bits = 8));
    assert_refused!(Corrupt, with(|sur| sur.size[0] = -5));
    assert_refused!(Corrupt, with(|sur| sur.size[0] = 0));
    assert_refused!(Corrupt, with(|sur| sur.steps[0] = 0.0));
    assert_refused!(Corrupt, with(|sur| sur.offset = f32::NAN));
    assert_refused!(Unsupported, with(|sur| sur.units[2] = b"V"));
    assert_refused!(Options, with(|sur| sur.units[2] = b""));
    for size in [[i32::MAX; 2], [0x7fff; 2]] {
        assert_refused!(Corrupt, Sur::of::<i32>(false).changed(|sur| sur.size = size).bytes(), size);
    }
    let bytes = Sur::of::<i32>(false).changed(|sur| (sur.size, sur.streams) = ([16_000; 2], 1)).bytes();
    assert_refused!(Corrupt, bytes);
    let whole = with(|_| ());
    assert_truncated(&whole, 12..whole.len());
    let packed = with(|sur| sur.streams = 2);
    let changed = |at: usize, value: u8| {
        let mut bytes = packed.clone();
        bytes[at] = value;
        bytes
    };
    let streams = 512 + 7;
    assert_refused!(Corrupt, changed(streams, 0));
    assert_refused!(Corrupt, changed(streams + 2, 255));
    assert_refused!(Corrupt, changed(streams + 4, 19));
    assert_refused!(Corrupt, changed(streams + 8, 0));
    assert_refused!(Corrupt, changed(streams + 12, 21));
    assert_refused!(Corrupt, changed(streams + 20, 0));
}
