//! Park Systems TIFF.

use super::instrument::{Bytes, assert_heights, stored};
use super::refused::Good;
use super::tiff::{Value, thumbnail, tiff};
use super::*;

const NEWEST: u32 = 0x0100_0002;

/// The header of an image.
struct Park {
    kind: u32,
    points: [u32; 2],
    size: [f64; 2],
    swapped: bool,
    name: &'static str,
    unit: &'static str,
    scale: f64,
}

impl Park {
    fn of(kind: u32) -> Self {
        let size = [NX as f64 * PIXEL[0] * 1e6, -(NY as f64) * PIXEL[1] * 1e6];
        let points = [NX as u32, NY as u32];
        Self { kind, points, size, swapped: false, name: "Z Height", unit: "nm", scale: 0.5 }
    }

    fn header(&self) -> Vec<u8> {
        let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>();
        let mut header = Bytes::new(580, false);
        header.text(4, wide(self.name));
        for axis in 0..2 {
            header.put(100 + 4 * axis, self.points[axis]);
            header.put(140 + 8 * axis, self.size[axis]);
        }
        header.put(136, u32::from(self.swapped));
        header.put(220, -0.5f64);
        header.put(228, self.scale);
        header.put(236, 3.0f64);
        header.text(244, wide(self.unit));
        header.put(348, self.kind);
        header.bytes
    }

    fn bytes(&self, numbers: Vec<u8>) -> Vec<u8> {
        whole(NEWEST, self.header(), numbers, vec![])
    }
}

/// A file of this version, with more tags.
fn whole(version: u32, header: Vec<u8>, numbers: Vec<u8>, more: Vec<(u16, Value)>) -> Vec<u8> {
    let own = vec![
        (50432, Value::Long(0x0e03_1301)),
        (50433, Value::Long(version)),
        (50434, Value::Bytes(numbers)),
        (50435, Value::Bytes(header)),
    ];
    tiff(false, &[[thumbnail(), own, more].concat()])
}

/// Heights in lines from the bottom, in units of minus a quarter nanometre.
fn upwards() -> impl Iterator<Item = f64> {
    (0..NX * NY).map(|k| -4.0 * z(k % NX, NY - 1 - k / NX))
}

fn floats() -> Vec<u8> {
    stored::<f32>(upwards(), false)
}

pub fn good() -> Vec<Good> {
    let header = Park::of(2).header();
    let curves = vec![(50438, Value::Bytes(vec![0; 8]))];
    vec![
        Good::whole("park", Park::of(2).bytes(floats())),
        Good::whole("park with curves", whole(NEWEST, header.clone(), floats(), curves)),
        Good {
            file: |header| whole(NEWEST, header, floats(), vec![]),
            ..Good::whole("header of park", header)
        },
    ]
}

#[test]
fn park_of_every_version_and_number_type() {
    macro_rules! check {
        ($($kind:ty, $code:literal, $version:literal;)*) => {$(
            // Integers have no mark of a missing point, here 0.
            let wanted = |ix, iy| 1e-9 * if z(ix, iy).is_nan() && $code < 2 { 0.0 } else { z(ix, iy) } - 1.5e-9;
            let numbers = stored::<$kind>(upwards(), false);
            assert_heights(whole($version, Park::of($code).header(), numbers, vec![]), None, PIXEL, wanted);
        )*};
    }
    check! {
        i16, 0, 0x0100_0001; i16, 0, 0x0100_0002; i32, 1, 0x0100_0002; f32, 2, 0x0100_0002;
    }
    let head = assert_map(Park::of(2).bytes(floats()), AS_IT_IS, 1e-9, PIXEL);
    assert_eq!(head.channel.unwrap().name, "Z Height");
    // Scanned along y: columns from the right, each from the bottom.
    let columns = stored::<f32>((0..NX * NY).rev().map(|k| -4.0 * z(k / NY, k % NY)), false);
    let turned = Park { points: [NY as u32, NX as u32], swapped: true, ..Park::of(2) };
    let turned = Park { size: [turned.size[1], turned.size[0]], ..turned };
    assert_map(turned.bytes(columns), AS_IT_IS, 1e-9, PIXEL);
    // A scale of 0 is none, and a length without a unit is in micrometres.
    let old = Park { scale: 0.0, unit: "", name: "", ..Park::of(2) };
    let head = assert_map(old.bytes(stored::<f32>(upwards().map(|z| z / 2.0), false)), AS_IT_IS, 1e-6, PIXEL);
    assert_eq!(head.channel.unwrap().name, "Topography");
}
