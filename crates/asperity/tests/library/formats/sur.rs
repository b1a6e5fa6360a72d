//! Digital Surf files.

use super::instrument::{Bytes, Number, assert_heights, deflated, filled, stored};
use super::refused::Good;
use super::{AS_IT_IS, NX, NY, channels, file, in_lines, z};
use asperity::topography::read::MapFile;

/// A header and what follows it.
struct Sur {
    big_endian: bool,
    objects: u16,
    kind: u16,
    bits: u16,
    name: &'static str,
    /// Of x, y and z.
    units: [&'static [u8]; 3],
    /// The least height, where missing points are marked.
    least: Option<i32>,
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
            units: [b"\xb5m", b"mm", b"nm"],
            least: Some(least),
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
            header.put(120 + 4 * axis, [2.0f32, 3e-3, 0.25][axis]);
            header.text(180 + 16 * axis, self.units[axis]);
        }
        header.put(108, NX as i32);
        header.put(112, NY as i32);
        header.text(164, self.name);
        header.put(334, 3u16);
        header.put(336, 4u16);
        header.put(474, 8f32);
        let packed = self.packed();
        header.put(324, packed.len() as u32);
        let numbers = if self.streams > 0 { &packed } else { &self.numbers };
        [&header.bytes[..], b"abcdefg", numbers].concat()
    }

    fn packed(&self) -> Vec<u8> {
        let (mut directory, mut all) = ((self.streams as u32).bytes(self.big_endian), Vec::new());
        for part in self.numbers.chunks(self.numbers.len().div_ceil(self.streams.max(1))) {
            let packed = deflated(part);
            let lengths = [part.len() as u32, packed.len() as u32];
            directory.extend(lengths.map(|length| length.bytes(self.big_endian)).concat());
            all.extend(packed);
        }
        [directory, all].concat()
    }
}

pub fn good() -> Vec<Good> {
    let whole = Sur::of::<i16>(false).bytes();
    let packed = Sur::of::<i16>(false).changed(|sur| sur.streams = 2).bytes();
    vec![Good { truncated: 12..whole.len(), ..Good::whole("sur", whole) }, Good::whole("sur packed", packed)]
}

fn pixel() -> [f64; 2] {
    [2e-6, 1e-3 * f64::from(3e-3f32)]
}

#[test]
fn sur_heights_of_every_type() {
    for sur in [Sur::of::<i16>, Sur::of::<i32>] {
        // Surfaces, and series of profiles; as they are and packed.
        for (kind, streams, big_endian) in
            [(2, 0, false), (2, 0, true), (1, 0, false), (2, 1, false), (2, 3, false), (2, 2, true)]
        {
            let bytes = sur(big_endian).changed(|sur| (sur.kind, sur.streams) = (kind, streams)).bytes();
            let head = assert_heights(bytes, None, pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
            assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Topography".to_owned()));
        }
    }
    // Where no points are marked, all numbers are heights.
    let bytes = Sur::of::<i16>(false).changed(|sur| sur.least = None).bytes();
    let wanted = |ix, iy| 1e-9 * (if z(ix, iy).is_nan() { -14.0 } else { z(ix, iy) } + 8.0);
    assert_heights(&bytes, None, pixel(), wanted);
    // A mark that is given is a number as it is stored.
    let (_folder, path) = file(&bytes);
    let given = MapFile { missing: super::marks(&[-56.0]), ..MapFile::new(&path, AS_IT_IS) };
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
        assert_eq!(channels(&bytes)[1..], ["\"the object\"", "\"Light\" (V)"]);
        assert_heights(&bytes, Some("THE object"), pixel(), |ix, iy| 1e-9 * (z(ix, iy) + 8.0));
        assert_heights(&bytes, Some("Topography"), pixel(), |ix, iy| 1e-9 * (filled(ix, iy) + 8.0));
    }
}
