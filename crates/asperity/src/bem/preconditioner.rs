//! An approximate inverse of the displacements: the part of 1/compliance that acts between neighbours.

use std::f64::consts::PI;

use super::compliance::ElasticPair;

/// Wave numbers along each axis at which the compliance is sampled.
const SAMPLES: usize = 128;

/// The least part of its value in the middle that a stencil leaves of a uniform field: above 0, or it is no inverse of a
/// positive operator.
const LEAST: f64 = 0.02;

/// Weights of a point's neighbours along x, along y and at the corners, relative to its own.
#[derive(Debug, Clone, Copy)]
pub struct Stencil {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// At the corners.
    pub corner: f64,
}

impl Stencil {
    /// The 3 x 3 middle of the inverse of `pair`'s compliance on a grid of `pixel` (m).
    pub fn new(pixel: [f64; 2], pair: &ElasticPair) -> Self {
        let angle = |k: usize| PI * (k as f64 + 0.5) / SAMPLES as f64;
        let mut sums = [0.0; 4];
        for i in 0..SAMPLES {
            for j in 0..SAMPLES {
                let (x, y) = (angle(i), angle(j));
                let inverse = pair.compliance((x / pixel[0]).hypot(y / pixel[1])).recip();
                for (sum, factor) in sums.iter_mut().zip([1.0, x.cos(), y.cos(), x.cos() * y.cos()]) {
                    *sum += inverse * factor;
                }
            }
        }
        let [x, y, corner] = [sums[1], sums[2], sums[3]].map(|sum| sum / sums[0]);
        let neighbours = -(2.0 * (x + y) + 4.0 * corner);
        let scale = if neighbours > 1.0 - LEAST { (1.0 - LEAST) / neighbours } else { 1.0 };
        Self { x: scale * x, y: scale * y, corner: scale * corner }
    }
}
