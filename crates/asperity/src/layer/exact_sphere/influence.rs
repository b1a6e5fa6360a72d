//! The influence function of a layered surface: displacement from pressure, in Abel's coordinates.

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::kernel::Kernel;
use crate::numeric::quadrature::{NODES, Variable, panels};

/// Above it kappa - 1 < 4 x^2 exp(-2 x) is below 1e-17.
const CUTOFF: f64 = 24.0;

/// Coefficients of a piece.
const TERMS: usize = 20;

/// m(y) = int_0^inf (kappa(x) - 1) cos(x y) dx for 0 <= y <= reach; lengths in layer thicknesses.
///
/// Its nearest singularities lie at y = +-2i, so that Chebyshev series on [0, 1], [1, 2] and from there on pieces half
/// as long as their distance from 0 meet rounding, 1e-15 of the largest |m|. A piece is computed when it is first
/// needed.
#[derive(Debug, Clone)]
pub struct Influence {
    kernel: Kernel,
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    from: f64,
    to: f64,
    coefficients: OnceLock<[f64; TERMS]>,
}

impl Influence {
    /// The influence function of a kernel, up to the distance `reach`.
    pub fn new(kernel: Kernel, reach: f64) -> Self {
        let mut ends = vec![0.0, 1.0, 2.0];
        while ends[ends.len() - 1] < reach {
            ends.push(1.5 * ends[ends.len() - 1]);
        }
        let piece = |ends: &[f64]| Piece { from: ends[0], to: ends[1], coefficients: OnceLock::new() };
        Self { kernel, pieces: ends.windows(2).map(piece).collect() }
    }

    /// m(y), 0 <= y <= reach.
    pub fn at(&self, y: f64) -> f64 {
        let piece = &self.pieces[self.pieces.partition_point(|piece| piece.to < y)];
        let coefficients = piece.coefficients.get_or_init(|| chebyshev(&self.kernel, piece.from, piece.to));
        let z = (2.0 * y - piece.from - piece.to) / (piece.to - piece.from);
        // Clenshaw's recurrence.
        let (mut next, mut second) = (0.0, 0.0);
        for &c in coefficients[1..].iter().rev() {
            (next, second) = (c + 2.0 * z * next - second, next);
        }
        coefficients[0] + z * next - second
    }
}

/// The Chebyshev series of m on [from, to].
fn chebyshev(kernel: &Kernel, from: f64, to: f64) -> [f64; TERMS] {
    let angle = |k: usize| (k as f64 + 0.5) * PI / TERMS as f64;
    let y: [f64; TERMS] = std::array::from_fn(|k| 0.5 * (from + to) + 0.5 * (to - from) * angle(k).cos());
    let mut values = [0.0; TERMS];
    integrate(kernel, to, |x, weight| {
        for (value, y) in values.iter_mut().zip(&y) {
            *value += weight * (x * y).cos();
        }
    });
    std::array::from_fn(|n| {
        let sum: f64 = (0..TERMS).map(|k| values[k] * (n as f64 * angle(k)).cos()).sum();
        sum * if n == 0 { 1.0 } else { 2.0 } / TERMS as f64
    })
}

/// Calls `node` with each abscissa and its weight times kappa - 1, of a quadrature for cosines up to x y.
///
/// Octaves extend down to where the kernel is smooth, below its feature from the stretching of a stiff layer at x ~
/// 1/alpha; each is divided so that a panel of 24 nodes covers at most 24 radians.
fn integrate(kernel: &Kernel, y: f64, mut node: impl FnMut(f64, f64)) {
    let least = 1.0 / (16.0 * (1.0 + kernel.shear_ratio()));
    let mut to = CUTOFF;
    while to > 0.0 {
        let from = if to > least { 0.5 * to } else { 0.0 };
        let count = ((to - from) * y / NODES as f64).ceil().max(1.0) as usize;
        for panel in panels(from, to, Variable::Linear, count) {
            for (x, weight) in panel.points.into_iter().zip(panel.weights) {
                node(x, weight * (kernel.kappa(x) - 1.0));
            }
        }
        to = from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;

    #[test]
    fn the_series_is_the_integral() {
        let body = |young, poisson| Material::new(young, poisson, None, None).unwrap();
        for ratio in [1e-3, 0.1, 2.0, 10.0, 1e3] {
            let kernel = Kernel::new(&body(ratio, 0.35), &body(1.0, 0.2));
            let influence = Influence::new(kernel, 500.0);
            // A rule with four times the nodes.
            let direct = |y: f64| {
                let mut sum = 0.0;
                integrate(&kernel, 4.0 * y + 100.0, |x, weight| sum += weight * (x * y).cos());
                sum
            };
            for y in [0.0, 1e-9, 0.1, 0.5, 0.99, 1.0, 1.3, 2.2, 3.0, 7.7, 30.0, 123.0, 499.9] {
                let error = (influence.at(y) - direct(y)).abs() / direct(0.0).abs();
                assert!(error < 1e-14, "{error:e} at {y} for {ratio}");
            }
        }
    }
}
