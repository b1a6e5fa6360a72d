//! JPK images.

use super::instrument::{assert_heights, stored};
use super::refused::Good;
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
    encoder: &'static str,
    unit: &'static str,
}

const FACTOR: f64 = 0.25e-9;
const OFFSET: f64 = -13.5e-9;

impl Picture {
    fn of(big_endian: bool, kind: [u16; 2], numbers: Vec<u8>) -> Self {
        let (names, default) = (["height", "Height"], "calibrated");
        let (method, retrace, encoder, unit) = (1, 0, "SignedIntegerWithValidity", "m");
        Self { big_endian, kind, method, numbers, names, retrace, default, encoder, unit }
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
            (0x80d3, Value::Text("LinearScaling")),
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

fn integers() -> Picture {
    let numbers = upwards().map(|z| if z.is_nan() { f64::from(i32::MAX) } else { z });
    Picture::of(false, [32, 2], stored::<i32>(numbers, false))
}

pub fn good() -> Vec<Good> {
    vec![
        Good::whole("jpk", bytes(&integers())),
        Good::whole("jpk packed", bytes(&Picture { method: 8, ..integers() })),
        Good::whole("jpk without channels", tiff(false, &[grid()])),
    ]
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
    assert_jpk(&tiff(false, &[reflected, integers().directory()]), |iy| NY - 1 - iy);
}

#[test]
fn jpk_channels() {
    let phase = Picture { names: ["phase", "Phase"], unit: "deg", ..integers() };
    let retrace = Picture { retrace: 1, ..integers() };
    let directories = [&phase, &retrace, &integers()].map(Picture::directory);
    let all = tiff(false, &[vec![grid()], directories.to_vec()].concat());
    assert_eq!(channels(&all), ["Height", "\"Phase\" (deg)", "\"Height (retrace)\""]);
    assert_jpk(&all, |iy| iy);
    // A mark of missing points is a height where no encoder says that it marks them.
    let (_folder, path) = file(bytes(&Picture { encoder: "SignedInteger", ..integers() }));
    let highest = height_map(&path, AS_IT_IS).unwrap().heights().iter().copied().fold(0.0, f64::max);
    assert_eq!(highest, f64::from(i32::MAX) * FACTOR);
    // Numbers without a scale have no unit.
    let raw = Picture { default: "raw", ..integers() };
    assert!(!read_head(bytes(&raw)).has_unit);
}
