//! What weighs the micro-contacts over the indentation in the statistical integral.

use std::f64::consts::{PI, SQRT_2};

use libm::erfc;

use crate::distribution::{Gaussian, HeightDistribution, Heights};

/// A weight over the heights h + x above a separation h, in units of sigma, relative to its scale. The terms are those of
/// [`HeightDistribution`].
pub(super) trait Weight: Sync {
    fn decreasing_from(&self) -> f64;
    fn highest_separation(&self) -> f64;
    fn scale(&self, h: f64) -> f64;
    fn window(&self, h: f64) -> [f64; 2];
    fn panels(&self, h: f64, from: f64, to: f64) -> usize;
    fn breakpoints(&self, h: f64) -> Vec<f64>;
    fn variable(&self, h: f64, x: f64) -> f64;
    fn variable_is_indentation(&self) -> bool;
    fn relative_density(&self, h: f64, x: f64) -> f64;
    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]);
}

impl Weight for Heights {
    fn decreasing_from(&self) -> f64 {
        (**self).decreasing_from()
    }

    fn highest_separation(&self) -> f64 {
        (**self).highest_separation()
    }

    fn scale(&self, h: f64) -> f64 {
        (**self).scale(h)
    }

    fn window(&self, h: f64) -> [f64; 2] {
        (**self).window(h)
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        (**self).panels(h, from, to)
    }

    fn breakpoints(&self, h: f64) -> Vec<f64> {
        (**self).breakpoints(h)
    }

    fn variable(&self, h: f64, x: f64) -> f64 {
        (**self).variable(h, x)
    }

    fn variable_is_indentation(&self) -> bool {
        (**self).variable_is_indentation()
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        (**self).relative_density(h, x)
    }

    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        self.apply_density(h, nodes, weights);
    }
}

/// The survival function Q of standard normal heights, which falls as their density does.
pub(super) struct GaussianSurvival;

/// Q(t)/phi(t) for t >= 0: by the error function, and by Laplace's continued fraction where its exponential would lose digits.
fn mills_ratio(t: f64) -> f64 {
    const FROM: f64 = 4.0;
    /// The rest is below rounding from `FROM` on.
    const TERMS: u32 = 50;
    if t < FROM {
        return 0.5 * erfc(t / SQRT_2) * (2.0 * PI).sqrt() * (0.5 * t * t).exp();
    }
    let rest = (1..=TERMS).rev().fold(t, |rest, k| t + f64::from(k) / rest);
    rest.recip()
}

impl Weight for GaussianSurvival {
    fn decreasing_from(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn highest_separation(&self) -> f64 {
        Gaussian.highest_separation()
    }

    fn scale(&self, h: f64) -> f64 {
        Gaussian.scale(h)
    }

    /// Below zero it is not small anywhere.
    fn window(&self, h: f64) -> [f64; 2] {
        let [_, end] = Gaussian.window(h);
        [0.0, end]
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        Gaussian.panels(h, from, to)
    }

    fn breakpoints(&self, _h: f64) -> Vec<f64> {
        Vec::new()
    }

    fn variable(&self, _h: f64, x: f64) -> f64 {
        x
    }

    fn variable_is_indentation(&self) -> bool {
        true
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        let t = h + x;
        if h >= 0.0 {
            mills_ratio(t) * Gaussian.relative_density(h, x)
        } else {
            0.5 * erfc(t / SQRT_2) * (2.0 * PI).sqrt()
        }
    }

    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        for (&mut x, weight) in nodes.iter_mut().zip(weights) {
            *weight *= self.relative_density(h, x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mills_ratio_keeps_its_digits() {
        // mpmath.
        for (t, exact) in [
            (0.0, 1.253_314_137_315_500_3),
            (1.0, 0.655_679_542_418_798_5),
            (3.999, 0.236_705_784_929_564_83),
            (4.0, 0.236_652_382_913_560_67),
            (12.0, 0.082_766_286_501_369_18),
        ] {
            assert!((mills_ratio(t) / exact - 1.0).abs() < 4e-15, "{t}: {}", mills_ratio(t));
        }
    }
}
