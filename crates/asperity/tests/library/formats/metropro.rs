//! Zygo MetroPro files.

use super::instrument::{Bytes, assert_heights, read, stored};
use super::refused::Good;
use super::{NX, NY, in_lines, z};
use asperity::topography::read::{LengthUnits, ReadOptions};

/// A phase that marks a missing point.
const MISSING: f64 = 2_147_483_640.0;
const SIDE: f32 = 2e-6;
const WAVELENGTH: f32 = 632.8e-9;

struct Dat {
    magic: u8,
    header: u32,
    /// Of the camera: width, height, pictures.
    intensities: [u16; 3],
    resolution: u16,
    sign: i16,
    side: f32,
}

const DAT: Dat = Dat { magic: 0x6f, header: 834, intensities: [7, 3, 2], resolution: 0, sign: 0, side: SIDE };

impl Dat {
    fn bytes(&self) -> Vec<u8> {
        let mut header = Bytes::new(self.header as usize, true);
        header.text(0, [0x88, 0x1b, 0x03, self.magic, 0, 1]);
        header.put(6, self.header);
        for k in 0..3 {
            header.put(52 + 2 * k, self.intensities[k]);
        }
        header.put(68, NX as u16);
        header.put(70, NY as u16);
        header.put(164, 0.5f32);
        header.put(168, WAVELENGTH);
        header.put(176, 0.25f32);
        header.put(184, self.side);
        header.put(218, self.resolution);
        header.put(232, self.sign);
        let pictures = self.intensities.iter().map(|&count| usize::from(count)).product::<usize>();
        let phases = in_lines().map(|z| if z.is_nan() { MISSING } else { 4.0 * z });
        [header.bytes, vec![0xaa; 2 * pictures], stored::<i32>(phases, true)].concat()
    }
}

pub fn good() -> Vec<Good> {
    let whole = DAT.bytes();
    vec![Good { truncated: 4..whole.len(), ..Good::whole("metropro", whole) }]
}

/// Of a wavelength: the scale, the obliquity, and steps of a quarter in the encoder.
fn wanted(steps: f64, sign: f64) -> impl Fn(usize, usize) -> f64 {
    move |ix, iy| sign * z(ix, iy) * 4.0 * 0.5 * 0.25 * f64::from(WAVELENGTH) / steps
}

#[test]
fn metropro_heights_of_every_version() {
    let pixel = [f64::from(SIDE); 2];
    for (magic, header) in [(0x6f, 834), (0x70, 834), (0x71, 4096)] {
        for (resolution, steps) in [(0, 4096.0), (1, 32_768.0), (2, 131_072.0)] {
            for (sign, direction) in [(0, 1.0), (1, -1.0)] {
                let bytes = Dat { magic, header, resolution, sign, ..DAT }.bytes();
                let head = assert_heights(&bytes, None, pixel, wanted(steps, direction));
                assert_eq!((head.has_unit, head.channel.unwrap().name), (true, "Phase".to_owned()));
            }
        }
    }
    let bare = Dat { intensities: [0; 3], ..DAT }.bytes();
    assert_heights(&bare, None, pixel, wanted(4096.0, 1.0));
    // Without a lateral resolution the pixel is given.
    let given = ReadOptions { pixel: Some([1e-6; 2]), unit: None };
    let (head, map) = read(Dat { side: 0.0, ..DAT }.bytes(), None, given);
    assert_eq!((head.pixel, map.pixel()), (None, [1e-6; 2]));
    let given = ReadOptions { pixel: None, unit: Some(LengthUnits::same(1e-9)) };
    let (head, map) = read(DAT.bytes(), None, given);
    assert_eq!(head.replaced_units(&given), Some(LengthUnits::same(1.0)));
    assert!((map.pixel()[0] / head.pixel.unwrap()[0] / 1e-9 - 1.0).abs() < 1e-12);
}
