//! Sensofar files.

use super::instrument::{Bytes, assert_heights, filled, read, stored};
use super::refused::Good;
use super::{AS_IT_IS, NX, NY, PIXEL, channels, in_lines, z};

/// A height that marks a missing point.
const MISSING: f64 = 1_000_001.0;
const TOPOGRAPHY: u32 = 3;

/// A file that states this number of layers.
fn plu(count: u8, layers: &[Vec<u8>]) -> Vec<u8> {
    let mut header = Bytes::new(500, false);
    header.text(0, "Fri Mar 10 16:35:59 2023");
    header.text(132, "a comment");
    for axis in 0..2 {
        header.put(388 + 4 * axis, [NY, NX][axis] as u32);
        header.put(404 + 4 * axis, (1e6 * PIXEL[axis]) as f32);
    }
    header.put(428, TOPOGRAPHY);
    header.put(489, count);
    [header.bytes, layers.concat()].concat()
}

fn layer(heights: impl Iterator<Item = f64>) -> Vec<u8> {
    let numbers = stored::<f32>(heights.map(|z| if z.is_nan() { MISSING } else { z }), false);
    let size = [NY as u32, NX as u32].map(u32::to_le_bytes).concat();
    [size, numbers, [-13.5f32, 11.0].map(f32::to_le_bytes).concat()].concat()
}

pub fn good() -> Vec<Good> {
    let whole = plu(1, &[layer(in_lines())]);
    // The least and the greatest height are not needed.
    vec![Good { truncated: 432..whole.len() - 8, ..Good::whole("plu", whole) }]
}

#[test]
fn plu_heights_of_every_layer() {
    // A file without a number of layers holds one.
    for count in [0, 1] {
        let bytes = plu(count, &[layer(in_lines())]);
        let head = assert_heights(bytes, None, PIXEL, |ix, iy| 1e-6 * z(ix, iy));
        assert_eq!(head.channel.unwrap().name, "Layer 1");
    }
    let second = layer((0..NX * NY).map(|k| filled(k % NX, k / NX)));
    let bytes = plu(2, &[layer(in_lines()), second]);
    assert_eq!(channels(&bytes), ["Layer 1", "\"Layer 2\""]);
    let (_, map) = read(&bytes, None, AS_IT_IS);
    assert!(map.heights()[3 * NY + 1].is_nan());
    assert_heights(&bytes, Some("layer 2"), PIXEL, |ix, iy| 1e-6 * filled(ix, iy));
}
