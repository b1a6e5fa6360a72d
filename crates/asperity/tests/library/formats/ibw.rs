//! Igor binary waves.

use super::instrument::{Bytes, Number, assert_heights, stored, upwards};
use super::refused::Good;
use super::*;

/// Bytes of the headers, the words of which add up to zero.
const HEADERS: usize = 384;

struct Wave {
    big_endian: bool,
    kind: u16,
    unit: &'static str,
    /// Units of x and y; those of more than three letters stand behind the numbers.
    lateral: &'static str,
    note: &'static str,
    /// Names along the third dimension.
    layers: &'static [&'static str],
    ending: &'static str,
}

impl Wave {
    const fn of(big_endian: bool, kind: u16) -> Self {
        Self { big_endian, kind, unit: "nm", lateral: "um", note: "", layers: &[], ending: "" }
    }

    /// Of a microscope.
    const fn asylum(layers: &'static [&'static str]) -> Self {
        Self { unit: "m", lateral: "m", layers, ending: "MFP3D", ..Self::of(false, 4) }
    }

    /// The file with these numbers, which are in its byte order.
    fn bytes(&self, numbers: &[u8]) -> Vec<u8> {
        let [unit, lateral] =
            [self.unit, self.lateral].map(|unit| if unit.len() > 3 { unit } else { "" }.as_bytes());
        let label = |name: &&str| [name.as_bytes(), &[0; 32]].concat()[..32].to_vec();
        let names = if self.layers.is_empty() { vec![] } else { [&[""], self.layers].concat() };
        let labels: Vec<u8> = names.iter().flat_map(label).collect();
        let tail = [self.note.as_bytes(), unit, lateral, lateral];
        let mut header = Bytes::new(HEADERS, self.big_endian);
        header.put(0, 5u16);
        header.put(4, 320 + numbers.len() as u32);
        for (k, part) in tail.iter().enumerate() {
            header.put(12 + 4 * k, part.len() as u32);
        }
        header.put(44, labels.len() as u32);
        header.put(76, (NX * NY * self.layers.len().max(1)) as u32);
        header.put(80, self.kind);
        header.text(92, "wave0");
        for (k, size) in [NX, NY, self.layers.len()].into_iter().enumerate() {
            header.put(132 + 4 * k, size as u32);
        }
        for (k, size) in PIXEL.into_iter().enumerate() {
            header.put(148 + 8 * k, size / if self.lateral == "m" { 1.0 } else { 1e-6 });
        }
        for (at, unit) in [(212, self.unit), (216, self.lateral), (220, self.lateral)] {
            header.text(at, if unit.len() > 3 { "" } else { unit });
        }
        let header = summed(header.bytes, self.big_endian);
        [&header, numbers, &tail.concat(), &labels, self.ending.as_bytes()].concat()
    }
}

/// A file with the right sum of its words.
fn summed(mut bytes: Vec<u8>, big_endian: bool) -> Vec<u8> {
    bytes[2..4].fill(0);
    let word = |&pair| if big_endian { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) };
    let sum = bytes[..HEADERS].as_chunks().0.iter().map(word).fold(0, u16::wrapping_add);
    bytes.splice(2..4, sum.wrapping_neg().bytes(big_endian));
    bytes
}

pub fn good() -> Vec<Good> {
    let file = |bytes| summed(bytes, false);
    let whole = Wave::of(false, 4).bytes(&doubles(1.0));
    let microscope = Wave::asylum(&["HeightTrace"]).bytes(&doubles(1e-9));
    vec![
        Good { file, ..Good::whole("ibw", &*whole) },
        Good { file, ..Good::whole("ibw of a microscope", microscope) },
        Good::whole("ibw and its sum", whole),
        Good::whole("ibw of an old version", [0; 200]),
    ]
}

fn doubles(factor: f64) -> Vec<u8> {
    stored::<f64>(upwards().map(|[ix, iy]| z(ix, iy) * factor), false)
}

fn image() -> Vec<u8> {
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
    let long = Wave { unit: "nanometers", lateral: "micrometers", ..Wave::of(false, 4) };
    for wave in [Wave::of(false, 4), long] {
        let head = assert_map(wave.bytes(&doubles(1.0)), AS_IT_IS, 1e-9, PIXEL);
        assert_eq!(head.channel.unwrap().name, "wave0");
    }
    let bare = Wave { unit: "", lateral: "", ..Wave::of(false, 4) };
    assert!(!assert_map(bare.bytes(&doubles(1.0)), IN_NM, 1e-9, PIXEL).has_unit);
    assert_map(image(), AS_IT_IS, 1e-9, PIXEL);
    assert_eq!(channels(image()), ["HeightRetrace", "\"PhaseTrace\" (deg)", "\"UserIn0TraceMod1\""]);
    // The unit of the note.
    assert_heights(image(), Some("UserIn0TraceMod1"), PIXEL, |ix, iy| 1e-9 * z(ix, iy));
    let names = &["HeightRetrace", "DACHeight", "Current", "Frequency", "CapacitanceTrace", "Sound", ""];
    let wave = Wave::asylum(names);
    let channels = channels(wave.bytes(&doubles(1e-9).repeat(names.len())));
    let units = ["(A)", "(Hz)", "(F)", "(V)", "\"Layer 7\" (V)"];
    assert!(channels[2..].iter().zip(units).all(|(other, unit)| other.ends_with(unit)), "{channels:?}");
}
