//! A circular spot on a body with a layer.

use std::f64::consts::PI;
use std::sync::Arc;

use gauss_quad::GaussLegendre;

use super::ConductionError;
use crate::numeric::parallel;

/// Ratios of the resistivities of layer and substrate that are covered.
pub const LAYER_RATIOS: [f64; 2] = [1e-3, 1e3];

/// Thicknesses over the radius of the spot that are tabulated. Below them the effect of the layer is proportional to its thickness, above
/// them it is that of a thick layer to the first order.
const THICKNESSES: [f64; 2] = [1e-2, 1e2];

/// Step of the table in ln(thickness).
const STEP: f64 = 0.2;

/// Nodes over the inverse of the thickness, and their bounds.
const NODES_PER_THICKNESS: f64 = 4.0;
const FEWEST_NODES: usize = 24;
const MOST_NODES: usize = 400;

/// The resistance of a circular spot of constant potential on a half-space with a layer, over that on the bare half-space.
///
/// A wave of current of wave number k raises the potential of the surface by r (1 + r T)/(r + T), T = tanh(k t), times that of the bare
/// half-space, r being the ratio of the resistivities. With r = (1 - g)/(1 + g) this is r (1 + 2 sum g^n exp(-2 n k t)), n from 1: images of the
/// spot. The current follows from the integral equation phi(x) + int_0^1 K(x, y) phi(y) dy = 1 (radius 1) with
///
/// ```text
/// K(x, y) = [S(|x - y|/t) + S((x + y)/t)]/(pi t),   S(v) = sum g^n 4 n/(4 n^2 + v^2)
/// ```
///
/// and the factor is r over the integral of phi. Its relative error is below 1e-4; limits are exact: r under a thick layer, 1 under none.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerFactor {
    ratio: f64,
    /// ln of the factor over its limit r, over ln(thickness).
    table: Arc<[f64]>,
}

impl LayerFactor {
    /// Of a layer whose resistivity is `ratio` times that of its substrate.
    ///
    /// # Errors
    /// A ratio out of [`LAYER_RATIOS`].
    pub fn new(ratio: f64) -> Result<Self, ConductionError> {
        if !(LAYER_RATIOS[0]..=LAYER_RATIOS[1]).contains(&ratio) {
            return Err(ConductionError::LayerRatio(ratio));
        }
        let images = Images::new((1.0 - ratio) / (1.0 + ratio));
        let count = ((THICKNESSES[1] / THICKNESSES[0]).ln() / STEP).round() as usize + 1;
        // Cubics need a row beyond each end.
        let table = parallel::map(count + 2, |k| {
            let thickness = THICKNESSES[0] * (STEP * (k as f64 - 1.0)).exp();
            -images.conductance(thickness).ln()
        });
        Ok(Self { ratio, table: table.into() })
    }

    /// The factor at a thickness over the radius of the spot: 0 to infinity.
    pub fn at(&self, thickness: f64) -> f64 {
        let [thinnest, thickest] = THICKNESSES;
        if thickness < thinnest {
            return 1.0 + (self.tabulated(thinnest) - 1.0) * thickness / thinnest;
        }
        if thickness > thickest {
            return self.ratio + (self.tabulated(thickest) - self.ratio) * thickest / thickness;
        }
        self.tabulated(thickness)
    }

    fn tabulated(&self, thickness: f64) -> f64 {
        let place = (thickness / THICKNESSES[0]).ln() / STEP + 1.0;
        let cell = (place.max(1.0) as usize).min(self.table.len() - 3);
        let t = place - cell as f64;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let rows = &self.table[cell - 1..cell + 3];
        self.ratio * rows.iter().zip(weights).map(|(row, weight)| row * weight).sum::<f64>().exp()
    }
}

/// S(v), tabulated over asinh(v/2), its scale.
struct Images {
    rows: Vec<f64>,
}

impl Images {
    /// Rows per unit of asinh(v/2).
    const PER_UNIT: f64 = 64.0;

    fn new(g: f64) -> Self {
        /// Images weaker than this are left out.
        const LEAST: f64 = 1e-13;
        let images = if g == 0.0 { 0 } else { (LEAST.ln() / g.abs().ln()).ceil() as usize };
        let sum = |v: f64| {
            let mut power = 1.0;
            let term = |n: usize| {
                power *= g;
                let n = n as f64;
                power * 4.0 * n / (4.0 * n * n + v * v)
            };
            (1..=images).map(term).sum::<f64>()
        };
        let farthest = (1.0 / (THICKNESSES[0] * (-STEP).exp())).asinh();
        let count = (farthest * Self::PER_UNIT).ceil() as usize + 3;
        let rows = parallel::map(count, |k| sum(2.0 * (k as f64 / Self::PER_UNIT).sinh()));
        Self { rows }
    }

    fn at(&self, v: f64) -> f64 {
        let place = (0.5 * v.abs()).asinh() * Self::PER_UNIT;
        let cell = (place as usize).min(self.rows.len() - 3);
        let t = place - cell as f64;
        // Even in v.
        let row = |k: usize| self.rows[(cell + k).abs_diff(1)];
        -t * (t - 1.0) * (t - 2.0) / 6.0 * row(0) + (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * row(1)
            - (t + 1.0) * t * (t - 2.0) / 2.0 * row(2)
            + (t + 1.0) * t * (t - 1.0) / 6.0 * row(3)
    }

    /// The integral of phi for a layer of a thickness over the radius: by conjugate gradients on Gauss nodes.
    fn conductance(&self, thickness: f64) -> f64 {
        /// Relative error of the integral, which is of second order in that of phi.
        const ERROR: f64 = 1e-12;
        const MOST_STEPS: usize = 500;
        let count = ((NODES_PER_THICKNESS / thickness) as usize).clamp(FEWEST_NODES, MOST_NODES);
        let rule = GaussLegendre::new(count.try_into().unwrap_or(std::num::NonZeroUsize::MIN));
        // On [0, 1], with the roots of the weights, which make the operator symmetric.
        let nodes: Vec<[f64; 2]> =
            rule.as_node_weight_pairs().iter().map(|(x, w)| [0.5 * (1.0 + x), (0.5 * w).sqrt()]).collect();
        let kernel = |a: &[f64; 2], b: &[f64; 2]| {
            let both = self.at((a[0] - b[0]) / thickness) + self.at((a[0] + b[0]) / thickness);
            a[1] * b[1] * both / (PI * thickness)
        };
        let matrix: Vec<Vec<f64>> =
            nodes.iter().map(|a| nodes.iter().map(|b| kernel(a, b)).collect()).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let apply =
            |p: &[f64]| -> Vec<f64> { matrix.iter().zip(p).map(|(row, own)| own + dot(row, p)).collect() };
        // The right side is 1, times the roots of the weights.
        let mut residual: Vec<f64> = nodes.iter().map(|node| node[1]).collect();
        let mut direction = residual.clone();
        let (mut product, mut integral) = (dot(&residual, &residual), 0.0);
        for _ in 0..MOST_STEPS {
            let response = apply(&direction);
            let step = product / dot(&direction, &response);
            // The integral is b phi, and grows by step (r r).
            let gain = step * product;
            integral += gain;
            residual.iter_mut().zip(&response).for_each(|(r, response)| *r -= step * response);
            let next = dot(&residual, &residual);
            if gain <= ERROR * integral || next == 0.0 {
                break;
            }
            let beta = next / product;
            direction.iter_mut().zip(&residual).for_each(|(p, r)| *p = r + beta * *p);
            product = next;
        }
        integral
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 without a layer, r under a thick one, where the images give 1 - 2/(pi t) ln(1 - g) times it.
    #[test]
    fn limits() {
        for ratio in [1e-3, 0.1, 4.0, 1e3] {
            let factor = LayerFactor::new(ratio).unwrap();
            assert_eq!(factor.at(0.0), 1.0);
            assert!((factor.at(f64::INFINITY) / ratio - 1.0).abs() < 1e-15);
            let g: f64 = (1.0 - ratio) / (1.0 + ratio);
            let expected = ratio * (1.0 - 2.0 / PI * (1.0 - g).ln() / 50.0);
            assert!((factor.at(50.0) / expected - 1.0).abs() < 1e-4, "{ratio}");
        }
        let none = LayerFactor::new(1.0).unwrap();
        for t in [0.003, 0.3, 3.0, 300.0] {
            assert!((none.at(t) - 1.0).abs() < 1e-9, "{t}: {}", none.at(t));
        }
        assert!(LayerFactor::new(1e4).is_err() && LayerFactor::new(f64::NAN).is_err());
    }

    /// Between its limits it changes one way with the thickness, and between its rows as between finer ones.
    #[test]
    fn it_lies_between_its_limits() {
        for ratio in [1e-3, 0.3, 20.0, 1e3] {
            let factor = LayerFactor::new(ratio).unwrap();
            let each: Vec<f64> = (0..400)
                .map(|k| factor.at(1e-4 * (0.05 * f64::from(k)).exp()) * (1.0 - ratio).signum())
                .collect();
            assert!(each.iter().rev().is_sorted(), "{ratio}");
        }
        let images = Images::new((1.0 - 20.0) / 21.0);
        let factor = LayerFactor::new(20.0).unwrap();
        for thickness in [0.011, 0.057, 0.31, 2.3, 71.0] {
            let exact = 20.0 / images.conductance(thickness);
            assert!((factor.at(thickness) / exact - 1.0).abs() < 1e-4, "{thickness}");
        }
    }
}
