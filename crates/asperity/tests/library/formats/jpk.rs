//! JPK images.

use super::instrument::{assert_heights, stored};
use super::tiff::{Value, thumbnail, tiff};
use super::*;

#[derive(Clone)]
struct Picture {
    big_endian: bool,
    /// Bits of a number, and 1 to 3 for unsigned, signed and floating.
    kind: [u16; 2],
    method: u16,
    numbers: Vec<u8>,
    names: [&'static str; 2],
    retrace: u16,
    default: &'static str,
    scaling: &'static str,
    encoder: &'static str,
    unit: &'static str,
}

const FACTOR: f64 = 0.25e-9;
const OFFSET: f64 = -13.5e-9;

impl Picture {
    fn of(big_endian: bool, kind: [u16; 2], numbers: Vec<u8>) -> Self {
        let (names, default, scaling) = (["height", "Height"], "calibrated", "LinearScaling");
        let (method, retrace, encoder, unit) = (1, 0, "SignedIntegerWithValidity", "m");
        Self { big_endian, kind, method, numbers, names, retrace, default, scaling, encoder, unit }
    }

    fn directory(&self) -> Vec<(u16, Value)> {
        let [bits, format] = self.kind;
        // In strips of three lines and of one.
        let strips = self.numbers.chunks(3 * NX * usize::from(bits) / 8).map(<[u8]>::to_vec).collect();
        vec![
            (256, Value::Long(NX as u32)),
            (257, Value::Long(NY as u32)),
            (258, Value::Short(bits)),
            (262, Value::Short(1)),
            (273, Value::Strips(self.method, strips)),
            (277, Value::Short(1)),
            (278, Value::Short(3)),
            (339, Value::Short(format)),
            (0x8050, Value::Text(self.names[0])),
            (0x8051, Value::Short(self.retrace)),
            (0x8052, Value::Text(self.names[1])),
            (0x8080, Value::Short(2)),
            (0x8081, Value::Text(self.default)),
            (0x8090, Value::Text("raw")),
            (0x80a1, Value::Text("SignedInteger")),
            (0x80a3, Value::Text("NullScaling")),
            (0x80c0, Value::Text("calibrated")),
            (0x80d1, Value::Text(self.encoder)),
            (0x80d2, Value::Text(self.unit)),
            (0x80d3, Value::Text(self.scaling)),
            (0x80d4, Value::Double(FACTOR)),
            (0x80d5, Value::Double(OFFSET)),
        ]
    }
}

/// The first directory: a thumbnail and what all channels have in common.
fn grid() -> Vec<(u16, Value)> {
    let [x, y] = [NX as f64 * PIXEL[0], -(NY as f64) * PIXEL[1]];
    [thumbnail(), vec![(0x8042, Value::Double(x)), (0x8043, Value::Double(y))]].concat()
}

fn bytes(picture: &Picture) -> Vec<u8> {
    tiff(picture.big_endian, &[grid(), picture.directory()])
}

/// Heights in lines from the bottom, in units of a quarter nanometre and 54 of them higher.
fn upwards() -> impl Iterator<Item = f64> {
    (0..NX * NY).map(|k| 4.0 * z(k % NX, NY - 1 - k / NX) + 54.0)
}

fn integers() -> Vec<u8> {
    upwards().flat_map(|z| if z.is_nan() { i32::MAX } else { z as i32 }.to_le_bytes()).collect()
}

fn good() -> Picture {
    Picture::of(false, [32, 2], integers())
}

pub fn image() -> Vec<u8> {
    let phase = Picture { names: ["phase", "Phase"], unit: "deg", ..good() };
    let retrace = Picture { retrace: 1, ..good() };
    tiff(false, &[grid(), phase.directory(), retrace.directory(), good().directory()])
}

fn assert_jpk(bytes: &[u8], line: impl Fn(usize) -> usize) {
    assert_heights(bytes, None, PIXEL, |ix, iy| 1e-9 * z(ix, line(iy)));
}

#[test]
fn jpk_of_every_number_type_byte_order_and_packing() {
    macro_rules! check {
        ($($kind:ty, $bits:literal, $format:literal, $missing:expr;)*) => {$(
            for big_endian in [false, true] {
                let numbers = upwards().map(|z| if z.is_nan() { $missing as f64 } else { z });
                let picture = Picture::of(big_endian, [$bits, $format], stored::<$kind>(numbers, big_endian));
                for method in [1, 8, 32773] {
                    assert_jpk(&bytes(&Picture { method, ..picture.clone() }), |iy| iy);
                }
            }
        )*};
    }
    check! {
        u16, 16, 1, u16::MAX; i16, 16, 2, i16::MAX; u32, 32, 1, u32::MAX; i32, 32, 2, i32::MAX;
        f32, 32, 3, f32::NAN; f64, 64, 3, f64::NAN;
    }
    let reflected = [grid(), vec![(0x8045, Value::Short(1))]].concat();
    assert_jpk(&tiff(false, &[reflected, good().directory()]), |iy| NY - 1 - iy);
}

#[test]
fn jpk_channels() {
    let (_folder, path) = file(image());
    let channel = metadata(&path).unwrap().channel.unwrap();
    assert_eq!(channel.name, "Height");
    assert_eq!(others(&channel), ["\"Phase\" (deg)", "\"Height (retrace)\""]);
    assert_jpk(&image(), |iy| iy);
    // A mark of missing points is a height where no encoder says that it marks them.
    let (_folder, path) = file(bytes(&Picture { encoder: "SignedInteger", ..good() }));
    let highest =
        height_map(&path, ReadOptions::default()).unwrap().heights().iter().copied().fold(0.0, f64::max);
    assert_eq!(highest, f64::from(i32::MAX) * FACTOR);
    // Numbers without a scale have no unit.
    let raw = Picture { default: "raw", ..good() };
    let (_folder, path) = file(bytes(&raw));
    assert!(!metadata(&path).unwrap().has_unit);
    damage::assert_no_panic(&image());
}

#[test]
fn bad_jpk_is_refused() {
    let with = |change: fn(&mut Picture)| {
        let mut picture = good();
        change(&mut picture);
        bytes(&picture)
    };
    assert_refused!(Unsupported, tiff(false, &[grid()]));
    assert_refused!(Unsupported, with(|picture| picture.unit = "A"));
    assert_refused!(Unsupported, with(|picture| picture.scaling = "CubicScaling"));
    assert_refused!(Corrupt, with(|picture| picture.default = "nominal"));
    assert_refused!(Corrupt, with(|picture| picture.method = 4242));
    assert_refused!(Corrupt, with(|picture| picture.numbers.truncate(60)));
    for (method, width) in [(1, 60_000), (8, 60_000), (8, u32::MAX)] {
        let mut large = Picture { method, ..good() }.directory();
        (large[0].1, large[1].1) = (Value::Long(width), Value::Long(60_000));
        assert_refused!(Corrupt, tiff(false, &[grid(), large]), width);
    }
    let mut flat = grid();
    flat.last_mut().unwrap().1 = Value::Double(0.0);
    assert_refused!(Corrupt, tiff(false, &[flat, good().directory()]));
}

/// The strips of a picture are a list, the count of which is a claim.
#[test]
fn more_strips_than_the_file_has_bytes_for_are_refused() {
    let bytes = tiff(false, &[grid(), Picture { method: 8, ..good() }.directory()]);
    // Tag 273, four bytes each, two of them.
    let entry = [273u16.to_le_bytes(), 4u16.to_le_bytes(), [2, 0], [0, 0]].concat();
    let place = bytes.windows(8).position(|window| window == entry).unwrap() + 4;
    let mut bytes = bytes;
    bytes[place..place + 4].copy_from_slice(&4_000_000u32.to_le_bytes());
    assert_refused!(Corrupt, bytes);
}
