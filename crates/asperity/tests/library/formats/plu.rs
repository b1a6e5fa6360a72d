//! Sensofar files.

use super::damage::assert_no_panic;
use super::instrument::{Bytes, assert_heights, filled, read, stored};
use super::{NX, NY, PIXEL, assert_truncated, in_lines, z};
use asperity::topography::read::ReadOptions;

/// A height that marks a missing point.
const MISSING: f64 = 1_000_001.0;
const PIXEL_UM: [f32; 2] = [2.0, 3.0];

struct Plu {
    date: &'static str,
    kind: u32,
    size: [u32; 2],
    pixel: [f32; 2],
    layers: u8,
}

const PLU: Plu = Plu {
    date: "Fri Mar 10 16:35:59 2023",
    kind: 3,
    size: [NX as u32, NY as u32],
    pixel: PIXEL_UM,
    layers: 1,
};

impl Plu {
    fn with(&self, layers: &[Vec<u8>]) -> Vec<u8> {
        let mut header = Bytes::new(500, false);
        header.text(0, self.date);
        header.text(132, "a comment");
        for axis in 0..2 {
            header.put(388 + 4 * axis, self.size[1 - axis]);
            header.put(404 + 4 * axis, self.pixel[axis]);
        }
        header.put(428, self.kind);
        header.put(489, self.layers);
        [header.bytes, layers.concat()].concat()
    }

    /// A file of one layer.
    fn bytes(&self) -> Vec<u8> {
        self.with(&[layer(in_lines())])
    }
}

fn layer(heights: impl Iterator<Item = f64>) -> Vec<u8> {
    let numbers = stored::<f32>(heights.map(|z| if z.is_nan() { MISSING } else { z }), false);
    let size = [NY as u32, NX as u32].map(u32::to_le_bytes).concat();
    [size, numbers, [-13.5f32, 11.0].map(f32::to_le_bytes).concat()].concat()
}

#[test]
fn plu_heights_of_every_layer() {
    // A file without a number of layers holds one.
    for layers in [0, 1] {
        let bytes = Plu { layers, ..PLU }.bytes();
        let head = assert_heights(bytes, None, PIXEL, |ix, iy| 1e-6 * z(ix, iy));
        assert_eq!(head.channel.unwrap().name, "Layer 1");
    }
    let second = layer((0..NX * NY).map(|k| filled(k % NX, k / NX)));
    let bytes = Plu { layers: 2, ..PLU }.with(&[layer(in_lines()), second]);
    let (head, map) = read(&bytes, None, ReadOptions::default());
    assert_eq!(super::others(&head.channel.unwrap()), ["\"Layer 2\""]);
    assert!(map.heights()[3 * NY + 1].is_nan());
    assert_heights(&bytes, Some("layer 2"), PIXEL, |ix, iy| 1e-6 * filled(ix, iy));
    assert_no_panic(&bytes);
}

#[test]
fn bad_plu_is_refused() {
    for kind in [0, 1, 2, 4, 5, 6] {
        assert_refused!(Unsupported, Plu { kind, ..PLU }.bytes(), kind);
    }
    // It is known by its date and a kind of measurement.
    for plu in [
        Plu { kind: 7, ..PLU },
        Plu { date: "Foo Mar 10 16:35:59 2023", ..PLU },
        Plu { date: "Fri Mar 10 16.35.59 2023", ..PLU },
        Plu { date: "Fri Mar 10 16:35:59", ..PLU },
        Plu { date: "Fr\u{e9} Mar 10 16:35:59 202", ..PLU },
    ] {
        let error = super::refused(plu.bytes());
        assert!(!error.to_string().contains("a topography"), "{error}");
    }
    assert_refused!(Corrupt, Plu { size: [4, 5], ..PLU }.bytes());
    assert_refused!(Corrupt, Plu { pixel: [0.0, 3.0], ..PLU }.bytes());
    assert_refused!(Corrupt, Plu { pixel: [f32::NAN, 3.0], ..PLU }.bytes());
    assert_refused!(Corrupt, Plu { layers: 2, ..PLU }.bytes());
    let huge = Plu { size: [u32::MAX; 2], ..PLU }.with(&[vec![255; 200]]);
    assert_refused!(Corrupt, huge);
    let whole = PLU.bytes();
    // The least and the greatest height are not needed.
    assert_truncated(&whole, 432..whole.len() - 8);
}
