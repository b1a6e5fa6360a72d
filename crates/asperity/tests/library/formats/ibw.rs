//! Igor binary waves.

use super::instrument::{assert_heights, stored, upwards};
use super::*;

#[derive(Clone)]
struct Wave {
    big_endian: bool,
    kind: u16,
    sizes: [u32; 4],
    unit: &'static str,
    /// Units of x and y; those of more than three letters stand behind the numbers.
    lateral: &'static str,
    note: &'static str,
    /// Names along the second and third dimension.
    names: [&'static [&'static str]; 2],
    ending: &'static str,
}

const SIZES: [u32; 4] = [NX as u32, NY as u32, 0, 0];

impl Wave {
    const fn of(big_endian: bool, kind: u16) -> Self {
        let (unit, lateral, note, ending) = ("nm", "um", "", "");
        Self { big_endian, kind, sizes: SIZES, unit, lateral, note, names: [&[], &[]], ending }
    }

    /// Of a microscope.
    const fn asylum(names: &'static [&'static str]) -> Self {
        let mut wave = Self { unit: "m", lateral: "m", ending: "MFP3D", ..Self::of(false, 4) };
        wave.sizes[2] = names.len() as u32;
        wave.names[1] = names;
        wave
    }

    /// The file with these numbers, which are in its byte order.
    fn bytes(&self, numbers: &[u8]) -> Vec<u8> {
        let two = |value: u16| if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() };
        let four = |value: usize| {
            let value = value as u32;
            if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() }
        };
        let labels = |names: &[&str]| {
            let named = |name: &&str| [name.as_bytes(), &[0; 32]].concat()[..32].to_vec();
            let all = if names.is_empty() { vec![] } else { [&[""], names].concat() };
            all.iter().flat_map(named).collect::<Vec<_>>()
        };
        let long = |unit: &'static str| if unit.len() > 3 { unit } else { "" };
        let [columns, layers] = self.names.map(labels);
        let mut bytes = vec![0; 384];
        let mut put = |at: usize, value: &[u8]| bytes[at..at + value.len()].copy_from_slice(value);
        put(0, &two(5));
        put(4, &four(320 + numbers.len()));
        put(12, &four(self.note.len()));
        put(16, &four(long(self.unit).len()));
        for at in [20, 24] {
            put(at, &four(long(self.lateral).len()));
        }
        put(40, &four(columns.len()));
        put(44, &four(layers.len()));
        put(76, &four(self.sizes.iter().fold(1u32, |all, &size| all.wrapping_mul(size.max(1))) as usize));
        put(80, &two(self.kind));
        put(92, b"wave0");
        for (k, size) in self.sizes.into_iter().enumerate() {
            put(132 + 4 * k, &four(size as usize));
        }
        let metres = if self.lateral == "m" { 1.0 } else { 1e-6 };
        for (k, size) in PIXEL.into_iter().enumerate() {
            let step = size / metres;
            put(148 + 8 * k, &if self.big_endian { step.to_be_bytes() } else { step.to_le_bytes() });
        }
        if long(self.unit).is_empty() {
            put(212, self.unit.as_bytes());
        }
        if long(self.lateral).is_empty() {
            put(216, self.lateral.as_bytes());
            put(220, self.lateral.as_bytes());
        }
        let words = bytes.as_chunks::<2>().0.iter();
        let sum = words.fold(0u16, |sum, &word| {
            sum.wrapping_add(if self.big_endian {
                u16::from_be_bytes(word)
            } else {
                u16::from_le_bytes(word)
            })
        });
        bytes[2..4].copy_from_slice(&two(sum.wrapping_neg()));
        let lateral = long(self.lateral).as_bytes();
        let parts = [self.note.as_bytes(), long(self.unit).as_bytes(), lateral, lateral, &columns, &layers];
        [&bytes, numbers, &parts.concat(), self.ending.as_bytes()].concat()
    }
}

fn doubles(factor: f64) -> Vec<u8> {
    stored::<f64>(upwards().map(|[ix, iy]| z(ix, iy) * factor), false)
}

pub fn image() -> Vec<u8> {
    let phase = stored::<f64>(upwards().map(|[ix, iy]| z(ix, iy) + 100.0), false);
    let wave = Wave {
        note: "ScanSize: 1\rUserIn0Unit: pm\r",
        ..Wave::asylum(&["PhaseTrace", "HeightRetrace", "UserIn0TraceMod1"])
    };
    wave.bytes(&[phase, doubles(1e-9), doubles(1e3)].concat())
}

#[test]
fn ibw_of_every_number_type_and_byte_order() {
    macro_rules! check {
        ($($kind:ty, $code:literal;)*) => {$(
            // In units of a quarter nanometre, and 54 of them higher, so that unsigned integers hold it; a missing point is 0 in integers.
            let of = |ix, iy| 4.0 * z(ix, iy) + 54.0;
            let wanted = |ix, iy| 1e-9 * if of(ix, iy).is_nan() && $code > 4 { 0.0 } else { of(ix, iy) };
            for big_endian in [false, true] {
                let numbers = stored::<$kind>(upwards().map(|[ix, iy]| of(ix, iy)), big_endian);
                assert_heights(Wave::of(big_endian, $code).bytes(&numbers), None, PIXEL, wanted);
            }
        )*};
    }
    check! { f32, 2; f64, 4; i8, 8; i16, 16; i32, 32; i64, 128; u8, 72; u16, 80; u32, 96; u64, 192; }
}

#[test]
fn ibw_units_and_channels() {
    let none = ReadOptions::default();
    let long = Wave { unit: "nanometers", lateral: "micrometers", ..Wave::of(false, 4) };
    for wave in [Wave::of(false, 4), long] {
        let head = assert_map(wave.bytes(&doubles(1.0)), none, 1e-9, PIXEL);
        assert_eq!(head.channel.unwrap().name, "wave0");
    }
    let bare = Wave { unit: "", lateral: "", ..Wave::of(false, 4) };
    assert!(!assert_map(bare.bytes(&doubles(1.0)), IN_NM, 1e-9, PIXEL).has_unit);
    let channel = assert_map(image(), none, 1e-9, PIXEL).channel.unwrap();
    assert_eq!(channel.name, "HeightRetrace");
    assert_eq!(others(&channel), ["\"PhaseTrace\" (deg)", "\"UserIn0TraceMod1\""]);
    // The unit of the note.
    assert_channel(image(), Some("UserIn0TraceMod1"), none, 1e-9, PIXEL);
    let names = &["HeightRetrace", "DACHeight", "Current", "Frequency", "CapacitanceTrace", "Sound", ""];
    let wave = Wave::asylum(names);
    let (_folder, path) = file(wave.bytes(&doubles(1e-9).repeat(names.len())));
    let others = others(&metadata(&path).unwrap().channel.unwrap());
    let units = ["(A)", "(Hz)", "(F)", "(V)", "\"Layer 7\" (V)"];
    assert!(others[1..].iter().zip(units).all(|(other, unit)| other.ends_with(unit)), "{others:?}");
    damage::assert_no_panic(&image());
}

#[test]
fn bad_ibw_is_refused() {
    let numbers = doubles(1e-9);
    let good = Wave::of(false, 4);
    let sized = |sizes: [u32; 4]| Wave { sizes, ..good.clone() }.bytes(&numbers);
    let [nx, ny, ..] = SIZES;
    let columns = Wave { names: [&["Raw", "Defl"], &[]], ..good.clone() };
    assert_refused!(Unsupported, columns.bytes(&numbers));
    let force = Wave { ending: "Force", ..good.clone() };
    assert_refused!(Unsupported, force.bytes(&numbers));
    assert_refused!(Unsupported, sized([20, 0, 0, 0]));
    assert_refused!(Unsupported, sized([0; 4]));
    assert_refused!(Unsupported, sized([5, 2, 1, 2]));
    assert_refused!(Unsupported, sized([nx, ny, 1001, 0]));
    assert_refused!(Corrupt, sized([nx, ny, 2, 0]));
    assert_refused!(Corrupt, sized([u32::MAX, u32::MAX, 1000, 0]));
    let unit = Wave { unit: "V", ..good.clone() };
    assert_refused!(Unsupported, unit.bytes(&numbers));
    for kind in [0, 5, 3, 68] {
        assert_refused!(Unsupported, Wave { kind, ..good.clone() }.bytes(&numbers), kind);
    }
    let mut changed = good.bytes(&numbers);
    changed[300] += 1;
    assert_refused!(Mismatch, changed);
    let mut negative = Wave::of(false, 4);
    negative.lateral = "m";
    let mut negative = negative.bytes(&numbers);
    // The signs of both sizes are bits of words whose sum stays.
    negative[155] ^= 0x80;
    negative[163] ^= 0x80;
    assert_refused!(Corrupt, negative);
    // Older waves have one dimension.
    for version in [1u16, 2, 3] {
        for big_endian in [false, true] {
            let mut old = vec![0; 200];
            let words = [version, version.wrapping_neg()];
            let bytes = |word: u16| if big_endian { word.to_be_bytes() } else { word.to_le_bytes() };
            old[..4].copy_from_slice(&words.map(bytes).concat());
            assert_refused!(Unsupported, old, version);
        }
    }
}
