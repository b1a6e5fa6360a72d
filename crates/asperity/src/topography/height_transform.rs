//! Transform of a Gaussian field to another height distribution: a monotone map, its effect on the autocorrelation, and
//! the correction of the Gaussian field for that effect.
//!
//! The map takes a standard normal g to a height T(g) of zero mean and unit standard deviation. These are exact for the
//! ensemble; a finite field scatters about them, as a Gaussian one does.

use crate::distribution::{HeightDistribution, normal_nodes};
use crate::numeric::parallel::for_each_row;
use crate::numeric::root::last_reaching;
use crate::progress::Progress;

/// Heights mapped per task.
const CHUNK: usize = 1 << 14;

/// The part of the variance that the truncated series may omit.
const TRUNCATION: f64 = 1e-7;

/// The largest number of terms. The steepest map needs about 2200, common ones 5 to 100.
const MOST: usize = 4000;

/// Step of the quadrature in g: half the step that the steepest map needs, and a tenth of the shortest wavelength of
/// the highest Hermite polynomial.
const STEP: f64 = 0.01;

/// Replaces each standard normal value g of `field` by `scale` T(g): one unit of work.
pub fn map_normals(heights: &dyn HeightDistribution, field: &mut [f64], scale: f64, progress: &dyn Progress) {
    let value = (field.len() as f64).recip();
    for_each_row(field, CHUNK, &|_, field| {
        progress.advance(value * field.len() as f64);
        heights.map_normals(field, scale);
    });
}

/// The correlation of two heights T(g1), T(g2) as a function of that of g1 and g2.
///
/// With the Hermite coefficients c_n = E[T(g) He_n(g)]/(n!)^.5 it is the sum over n >= 1 of c_n^2 rho^n (Mehler's
/// formula). Since the c_n^2 add up to the variance, 1, the truncation error is known: terms are added until it is
/// below 1e-7, then normalised to a sum of 1. The error of the correlation is at most 2e-7.
#[derive(Debug, Clone, PartialEq)]
pub struct Distortion {
    /// c_n^2 from n = 1.
    squares: Vec<f64>,
}

impl Distortion {
    /// The distortion by the map to `distribution`.
    pub fn new(distribution: &dyn HeightDistribution) -> Self {
        Self::by(|g| distribution.height_at_normal(g))
    }

    /// The distortion by an increasing map from g to a height of zero mean and unit standard deviation.
    pub(super) fn by(height_at_normal: impl Fn(f64) -> f64) -> Self {
        let nodes: Vec<[f64; 2]> = normal_nodes(STEP).collect();
        let heights: Vec<f64> = nodes.iter().map(|&[g, weight]| weight * height_at_normal(g)).collect();
        // Orthonormal polynomials h_n = He_n/(n!)^.5: (n+1)^.5 h_(n+1) = g h_n - n^.5 h_(n-1).
        let mut before = vec![0.0; nodes.len()];
        let mut latest = vec![1.0; nodes.len()];
        let mut squares = Vec::new();
        let mut sum = 0.0;
        while sum < 1.0 - TRUNCATION && squares.len() < MOST {
            let order = squares.len() as f64;
            let (root, next_root) = (order.sqrt(), (order + 1.0).sqrt());
            let mut coefficient = 0.0;
            for (k, &[g, _]) in nodes.iter().enumerate() {
                let next = (g * latest[k] - root * before[k]) / next_root;
                (before[k], latest[k]) = (latest[k], next);
                coefficient += heights[k] * next;
            }
            squares.push(coefficient * coefficient);
            sum += coefficient * coefficient;
        }
        squares.iter_mut().for_each(|square| *square /= sum);
        Self { squares }
    }

    /// The correlation of heights for a correlation `rho` of the normal variables, from -1 to 1.
    pub fn of(&self, rho: f64) -> f64 {
        rho * self.squares.iter().rev().fold(0.0, |sum, square| sum * rho + square)
    }

    /// The lowest possible correlation of heights, which is above -1 for an asymmetric distribution.
    pub fn least(&self) -> f64 {
        self.of(-1.0)
    }

    /// The correlation of the normal variables for a correlation `wanted` of heights; `None` below the lowest possible
    /// one and above 1. It increases with `wanted`, since T is increasing (Price's theorem).
    pub fn before(&self, wanted: f64) -> Option<f64> {
        if !(self.least()..=1.0).contains(&wanted) {
            return None;
        }
        // Shifted and mirrored to be positive and decreasing, as the search requires.
        let found = last_reaching(|x| 2.0 + self.of(-x), 2.0 + wanted, -1.0, 1.0)?;
        Some(-found)
    }

    /// [`Self::before`] by cubic interpolation, with an error of 1e-9 unless the map is steep.
    pub fn inverse(&self) -> Inverse {
        const INTERVALS: usize = 4096;
        let least = self.least();
        let step = (self.of(1.0) - least) / INTERVALS as f64;
        let slope = |rho: f64| {
            let terms = self.squares.iter().enumerate().rev();
            terms.fold(0.0, |sum, (k, square)| sum * rho + (k + 1) as f64 * square)
        };
        let node = |k: usize| {
            let rho = match k {
                0 => -1.0,
                INTERVALS => 1.0,
                _ => self.before(least + step * k as f64).unwrap_or(1.0),
            };
            [rho, step / slope(rho)]
        };
        Inverse { least, step, nodes: (0..=INTERVALS).map(node).collect() }
    }
}

/// The tabulated inverse of a [`Distortion`].
#[derive(Debug, Clone)]
pub struct Inverse {
    least: f64,
    step: f64,
    /// The correlation of the normal variables, and its derivative times the step, at equal steps of that of heights.
    nodes: Vec<[f64; 2]>,
}

impl Inverse {
    /// The correlation of the normal variables for a correlation `wanted` of heights, or for the nearest possible one.
    pub fn of(&self, wanted: f64) -> f64 {
        let last = self.nodes.len() - 2;
        let place = ((wanted - self.least) / self.step).clamp(0.0, (last + 1) as f64);
        let k = (place as usize).min(last);
        let (t, [[a, da], [b, db]]) = (place - k as f64, [self.nodes[k], self.nodes[k + 1]]);
        let s = 1.0 - t;
        // The Hermite cubic about the nearer end, to avoid cancellation there.
        s * s * (a * (1.0 + 2.0 * t) + da * t) + t * t * (b * (1.0 + 2.0 * s) - db * s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::tests::all;
    use crate::distribution::{Gaussian, Heights, Johnson, Weibull};
    use crate::progress::Silent;

    fn johnson(skewness: f64, kurtosis: f64) -> Heights {
        Heights::new(Johnson::from_moments(skewness, kurtosis).unwrap())
    }

    /// E[T(g1) T(g2)] as a double integral.
    fn direct(heights: &Heights, rho: f64) -> f64 {
        let other = (1.0 - rho * rho).sqrt();
        let nodes: Vec<[f64; 2]> = normal_nodes(0.07).collect();
        let inner = |g: f64| -> f64 {
            nodes.iter().map(|&[h, w]| w * heights.height_at_normal(rho * g + other * h)).sum()
        };
        nodes.iter().map(|&[g, w]| w * heights.height_at_normal(g) * inner(g)).sum()
    }

    #[test]
    fn the_series_is_the_double_integral() {
        for heights in [
            Heights::GAUSSIAN,
            johnson(1.0, 6.0),
            johnson(-1.0, 2.6),
            johnson(0.0, 200.0),
            johnson(0.0, 1.4),
            Heights::new(Weibull::new(0.5).unwrap()),
            Heights::new(Weibull::new(5.0).unwrap()),
        ] {
            let distortion = Distortion::new(&*heights);
            for rho in [-0.9, -0.5, 0.0, 0.2, 0.7, 0.95] {
                let gap = (distortion.of(rho) - direct(&heights, rho)).abs();
                assert!(gap < 2e-7, "{heights}, {rho}: {gap}");
            }
        }
    }

    #[test]
    fn a_field_is_mapped_point_by_point() {
        let field: Vec<f64> = (0..40_001).map(|k| f64::from(k - 20_000) * 4.5e-4).collect();
        for heights in all() {
            let mut mapped = field.clone();
            map_normals(&*heights, &mut mapped, 1e-7, &Silent);
            for (&g, &z) in field.iter().zip(&mapped) {
                assert_eq!(z, 1e-7 * heights.height_at_normal(g), "{heights}, g = {g}");
            }
        }
    }

    #[test]
    fn closed_forms() {
        let gaussian = Distortion::new(&Gaussian);
        assert_eq!((gaussian.squares.len(), gaussian.of(0.3), gaussian.least()), (1, 0.3, -1.0));
        // Lognormal: expm1(rho/delta^2)/expm1(1/delta^2), here with omega = 1.5.
        let omega = 1.5f64;
        let kurtosis = omega.powi(4) + 2.0 * omega.powi(3) + 3.0 * omega * omega - 3.0;
        let lognormal = Distortion::new(&*johnson(3.5 * 0.5f64.sqrt(), kurtosis));
        for rho in [-1.0, -0.4, 0.1, 0.9] {
            let exact = (rho * omega.ln()).exp_m1() / 0.5;
            assert!((lognormal.of(rho) - exact).abs() < 2e-7, "{rho}");
        }
        // Two levels with slopes between: SB of gamma = 0, delta = 0.072252, a logistic curve that is
        // close to Phi(g/s), s = 1.702 delta, for which the correlation is an arcsine.
        let levels = Distortion::new(&*johnson(0.0, 1.081));
        let widened = 1.0 + (1.702f64 * 0.072252).powi(2);
        for rho in [-0.8f64, 0.1, 0.5, 0.95] {
            let gap = (levels.of(rho) - (rho / widened).asin() / widened.recip().asin()).abs();
            assert!(gap < 2e-3, "{rho}: {gap}");
        }
    }

    #[test]
    fn the_inverse_is_before() {
        for heights in [johnson(-1.0, 4.5), johnson(1.0, 6.0), Heights::new(Weibull::new(1.5).unwrap())] {
            let distortion = Distortion::new(&*heights);
            let inverse = distortion.inverse();
            for k in 0..=777 {
                let wanted = distortion.least() + (1.0 - distortion.least()) * f64::from(k) / 777.0;
                let before = distortion.before(wanted.min(distortion.of(1.0))).unwrap();
                assert!((inverse.of(wanted) - before).abs() < 1e-9, "{heights}: {wanted}");
            }
            assert_eq!((inverse.of(-1.0), inverse.of(1.1)), (-1.0, 1.0));
        }
    }

    #[test]
    fn what_is_undone_beforehand_comes_out() {
        for heights in all() {
            let distortion = Distortion::new(&*heights);
            let least = distortion.least();
            assert_eq!((distortion.of(0.0), distortion.of(1.0).round()), (0.0, 1.0));
            assert!((distortion.of(1.0) - 1.0).abs() < 1e-13);
            for k in 0..=20 {
                let wanted = (least + (1.0 - least) * f64::from(k) / 20.0).min(distortion.of(1.0)).min(1.0);
                let rho = distortion.before(wanted).unwrap_or_else(|| panic!("{heights}: {wanted}"));
                assert!((distortion.of(rho) - wanted).abs() < 1e-14, "{heights}: {wanted}");
            }
            for beyond in [least - 1e-12, 1.0 + 1e-12, f64::NAN] {
                assert_eq!(distortion.before(beyond), None);
            }
        }
    }
}
