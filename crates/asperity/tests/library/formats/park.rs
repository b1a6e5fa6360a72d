//! Park Systems TIFF.

use super::instrument::{assert_heights, stored};
use super::tiff::{Value, thumbnail, tiff};
use super::*;

#[derive(Clone)]
struct Park {
    version: u32,
    image: u32,
    kind: u32,
    points: [u32; 2],
    size: [f64; 2],
    swapped: bool,
    name: &'static str,
    unit: &'static str,
    scale: f64,
    length: usize,
    has_curves: bool,
}

impl Park {
    fn of(kind: u32) -> Self {
        let size = [NX as f64 * PIXEL[0] * 1e6, -(NY as f64) * PIXEL[1] * 1e6];
        let (version, points, swapped, length) = (0x0100_0002, [NX as u32, NY as u32], false, 580);
        Self {
            version,
            image: 0,
            kind,
            points,
            size,
            swapped,
            name: "Z Height",
            unit: "nm",
            scale: 0.5,
            length,
            has_curves: false,
        }
    }

    fn bytes(&self, numbers: &[u8]) -> Vec<u8> {
        let mut header = vec![0; self.length.max(580)];
        let mut put = |at: usize, value: &[u8]| header[at..at + value.len()].copy_from_slice(value);
        let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>();
        put(0, &self.image.to_le_bytes());
        put(4, &wide(self.name));
        put(100, &self.points[0].to_le_bytes());
        put(104, &self.points[1].to_le_bytes());
        put(136, &u32::from(self.swapped).to_le_bytes());
        put(140, &self.size[0].to_le_bytes());
        put(148, &self.size[1].to_le_bytes());
        put(220, &(-0.5f64).to_le_bytes());
        put(228, &self.scale.to_le_bytes());
        put(236, &3.0f64.to_le_bytes());
        put(244, &wide(self.unit));
        put(348, &self.kind.to_le_bytes());
        header.truncate(self.length);
        let mut own = vec![
            (50432, Value::Long(0x0e03_1301)),
            (50433, Value::Long(self.version)),
            (50434, Value::Bytes(numbers.to_vec())),
            (50435, Value::Bytes(header)),
        ];
        if self.has_curves {
            own.push((50438, Value::Bytes(vec![0; 8])));
        }
        tiff(false, &[[thumbnail(), own].concat()])
    }
}

/// Heights in lines from the bottom, in units of minus a quarter nanometre.
fn upwards() -> impl Iterator<Item = f64> {
    (0..NX * NY).map(|k| -4.0 * z(k % NX, NY - 1 - k / NX))
}

fn floats() -> Vec<u8> {
    upwards().flat_map(|z| (z as f32).to_le_bytes()).collect()
}

pub fn image() -> Vec<u8> {
    Park::of(2).bytes(&floats())
}

#[test]
fn park_of_every_version_and_number_type() {
    macro_rules! check {
        ($($kind:ty, $code:literal, $version:literal;)*) => {$(
            // Integers have no mark of a missing point, here 0.
            let wanted = |ix, iy| 1e-9 * if z(ix, iy).is_nan() && $code < 2 { 0.0 } else { z(ix, iy) } - 1.5e-9;
            let file = Park { version: $version, ..Park::of($code) };
            assert_heights(file.bytes(&stored::<$kind>(upwards(), false)), None, PIXEL, wanted);
        )*};
    }
    check! {
        i16, 0, 0x0100_0001; i16, 0, 0x0100_0002; i32, 1, 0x0100_0002; f32, 2, 0x0100_0002;
    }
    let none = ReadOptions::default();
    let head = assert_map(image(), none, 1e-9, PIXEL);
    assert_eq!(head.channel.unwrap().name, "Z Height");
    // Scanned along y: columns from the right, each from the bottom.
    let columns = (0..NX * NY).rev().map(|k| (-4.0 * z(k / NY, k % NY)) as f32);
    let turned = Park { points: [NY as u32, NX as u32], swapped: true, ..Park::of(2) };
    let turned = Park { size: [turned.size[1], turned.size[0]], ..turned };
    assert_map(turned.bytes(&columns.flat_map(f32::to_le_bytes).collect::<Vec<_>>()), none, 1e-9, PIXEL);
    // A scale of 0 is none, and a length without a unit is in micrometres.
    let old = Park { scale: 0.0, unit: "", name: "", ..Park::of(2) };
    let halves: Vec<u8> = upwards().flat_map(|z| (z as f32 / 2.0).to_le_bytes()).collect();
    let head = assert_map(old.bytes(&halves), none, 1e-6, PIXEL);
    assert_eq!(head.channel.unwrap().name, "Topography");
    damage::assert_no_panic(&image());
}

#[test]
fn bad_park_is_refused() {
    let (good, numbers) = (Park::of(2), floats());
    let version = Park { version: 0x0100_0003, ..good.clone() };
    assert_refused!(Unsupported, version.bytes(&numbers));
    let short = Park { length: 351, ..good.clone() };
    assert_refused!(Corrupt, short.bytes(&numbers));
    let profile = Park { image: 1, ..good.clone() };
    assert_refused!(Unsupported, profile.bytes(&numbers));
    // The picture of a file of force curves is where they were measured; some files say so by a tag alone.
    let curves = Park { image: 2, ..good.clone() };
    assert_refused!(Unsupported, curves.bytes(&numbers));
    let mut tagged = good.clone();
    tagged.has_curves = true;
    assert_refused!(Unsupported, tagged.bytes(&numbers));
    assert_refused!(Unsupported, Park::of(3).bytes(&numbers));
    assert_refused!(Corrupt, good.bytes(&numbers[..76]));
    let huge = Park { points: [u32::MAX; 2], ..good.clone() };
    assert_refused!(Corrupt, huge.bytes(&numbers));
    let current = Park { unit: "A", name: "Current", ..good.clone() };
    assert_refused!(Unsupported, current.bytes(&numbers));
    let flat = Park { size: [0.0; 2], ..good };
    assert_refused!(Corrupt, flat.bytes(&numbers));
}
