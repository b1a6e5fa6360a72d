//! Gwyddion Simple Field.

use super::instrument::{assert_heights, stored};
use super::refused::Good;
use super::{AS_IT_IS, NX, NY, PIXEL, in_lines, read_head, z};
use asperity::topography::read::{LengthUnits, ReadOptions};

/// A header of these lines behind the size, filled with zeros to a multiple of four bytes, then the numbers.
fn of(lines: &str) -> Vec<u8> {
    let mut bytes = format!("Gwyddion Simple Field 1.0\nXRes = {NX}\nYRes={NY}\n{lines}").into_bytes();
    bytes.resize((bytes.len() / 4 + 1) * 4, 0);
    bytes.extend(stored::<f32>(in_lines().map(|z| 1e-9 * z), false));
    bytes
}

fn titled(padding: usize) -> Vec<u8> {
    let [x, y] = [PIXEL[0] * NX as f64, PIXEL[1] * NY as f64];
    let title = "x".repeat(padding);
    of(&format!("Neaspec_Angle=45\nXReal={x:e}\nYReal={y:e}\nXYUnits=m\nZUnits=m\nTitle={title}\n"))
}

pub fn good() -> Vec<Good> {
    let whole = titled(1);
    vec![Good { truncated: whole.len() - 4 * NX * NY..whole.len(), ..Good::whole("gsf", whole) }]
}

#[test]
fn gsf_heights_after_headers_of_every_length() {
    for padding in 1..6 {
        let head =
            assert_heights(titled(padding), None, PIXEL, |ix, iy| f64::from((1e-9 * z(ix, iy)) as f32));
        assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "x".repeat(padding)));
    }
}

/// As Neaspec writes a phase: a pixel, and no unit of the numbers.
#[test]
fn gsf_without_units_asks_for_them() {
    let head = read_head(of("XReal=1E-05\nYReal=5E-05\nXYUnits=m\nZUnits=\n"));
    assert!(head.units(&AS_IT_IS).is_err() && !head.has_unit);
    let given = ReadOptions { unit: Some(LengthUnits::same(1e-9)), pixel: None };
    assert_eq!(head.pixel(&given), Ok([1e-5 / NX as f64, 5e-5 / NY as f64]));
    assert_eq!(read_head(of("")).pixel, None);
}
