//! The weight of the layer in the effective properties: the functions of xi = t/a behind Eqs. 17 and 18.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// The parts of the weights I1 (Eq. 17) and I0 (Eq. 18) that do not depend on materials.
///
/// With q = min(xi, 1/xi), they are computed without cancellation from xi = 1e-300 to 1e300.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    /// Whether the layer has the larger weight: xi >= 1. The weights below are then those of the substrate.
    pub(super) in_layer: bool,
    /// (2/pi) arctan q.
    angle: f64,
    /// (xi/pi) ln(1 + 1/xi^2).
    pub(super) log: f64,
    /// (1/pi) xi/(1 + xi^2).
    pub(super) pole: f64,
    /// 1/(1 + xi^2).
    part: f64,
}

impl Weights {
    /// The weights at `inverse` = 1/xi = a/t.
    #[inline]
    pub(super) fn at(inverse: f64) -> Self {
        let in_layer = inverse <= 1.0;
        let q = if in_layer { inverse } else { inverse.recip() };
        let small = q * q;
        let reciprocal = (1.0 + small).recip();
        let [angle, log] = transcendental(inverse);
        Self {
            in_layer,
            angle,
            log,
            pole: FRAC_1_PI * q * reciprocal,
            part: if in_layer { small * reciprocal } else { reciprocal },
        }
    }

    /// The smaller weight in nu_eff: I1 of the layer, 1 - I1 of the substrate (Eqs. 14, 17).
    #[inline]
    pub(super) fn of_poisson(&self) -> f64 {
        self.angle + self.signed(self.log)
    }

    /// The smaller weight in E_eff: I0 of the layer, 1 - I0 of the substrate (Eqs. 15, 18), given nu_eff.
    #[inline]
    pub(super) fn of_modulus(&self, poisson: f64) -> f64 {
        self.angle + self.signed((1.0 - 2.0 * poisson) * self.log - self.pole) / (2.0 * (1.0 - poisson))
    }

    /// d I0/d ln xi at a fixed nu_eff; positive.
    #[inline]
    pub(super) fn slope_of_modulus(&self, poisson: f64) -> f64 {
        (self.swell() + (1.0 - 2.0 * poisson) * self.log) / (2.0 * (1.0 - poisson))
    }

    /// (xi/pi) (1 + 3 xi^2)/(1 + xi^2)^2.
    #[inline]
    pub(super) fn swell(&self) -> f64 {
        self.pole * (3.0 - 2.0 * self.part)
    }

    #[inline]
    fn signed(&self, value: f64) -> f64 {
        if self.in_layer { -value } else { value }
    }
}

/// Where (xi/pi) ln(1 + 1/xi^2), xi/(1 + xi^2) and xi (1 + 3 xi^2)/(1 + xi^2)^2 are largest, as 1/xi.
pub(super) const LOG_PEAK: f64 = 1.980_291_300_432_213;
pub(super) const POLE_PEAK: f64 = 1.0;
pub(super) const SWELL_PEAK: f64 = 0.681_250_038_633_213_3;

/// (2/pi) arctan q and (xi/pi) ln(1 + 1/xi^2).
fn transcendental(inverse: f64) -> [f64; 2] {
    if inverse <= 1.0 {
        // For 1/xi below 1e-154 the square vanishes, and the logarithm is 1/xi^2 to all digits.
        let log = if inverse > 1e-100 { (inverse * inverse).ln_1p() / inverse } else { inverse };
        [FRAC_2_PI * inverse.atan(), FRAC_1_PI * log]
    } else {
        let xi = inverse.recip();
        [FRAC_2_PI * xi.atan(), FRAC_1_PI * xi * ((xi * xi).ln_1p() + 2.0 * inverse.ln())]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both weights of the body that weighs less, next to their limits (PHYSICS of xi -> 0 and xi -> inf).
    #[test]
    fn limits_keep_all_digits() {
        for exponent in [-300, -200, -100, -50, -12, 12, 50, 100, 200, 300] {
            let xi = 10f64.powi(exponent);
            let weights = Weights::at(xi.recip());
            for nu in [0.0, 0.3, 0.499] {
                let (i1, i0) = if exponent < 0 {
                    let log = xi.ln();
                    (
                        FRAC_2_PI * xi * (1.0 - log),
                        xi * (3.0 - 4.0 * nu - 2.0 * (1.0 - 2.0 * nu) * log) * FRAC_1_PI / (2.0 * (1.0 - nu)),
                    )
                } else {
                    (FRAC_1_PI / xi, (2.0 - nu) / (1.0 - nu) * FRAC_1_PI / xi)
                };
                assert!((weights.of_poisson() / i1 - 1.0).abs() < 2e-15, "I1 at {xi:e}");
                assert!((weights.of_modulus(nu) / i0 - 1.0).abs() < 4e-15, "I0 at {xi:e}, nu = {nu}");
            }
        }
    }

    #[test]
    fn slopes_are_those_of_the_weights() {
        for k in -40..=40 {
            let inverse = (0.3 * f64::from(k)).exp();
            let (low, high) = (Weights::at(inverse * 1.0001), Weights::at(inverse / 1.0001));
            if low.in_layer != high.in_layer {
                continue;
            }
            let sign = if low.in_layer { -1.0 } else { 1.0 };
            let step = 2.0 * 1.0001f64.ln();
            let slope = |f: &dyn Fn(&Weights) -> f64| sign * (f(&high) - f(&low)) / step;
            let weights = Weights::at(inverse);
            let poisson = slope(&|w: &Weights| w.of_poisson());
            assert!((poisson / weights.log - 1.0).abs() < 1e-7);
            let modulus = slope(&|w: &Weights| w.of_modulus(0.2));
            assert!((modulus / weights.slope_of_modulus(0.2) - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn peaks_are_where_they_are_said_to_be() {
        fn is_highest(value: impl Fn(&Weights) -> f64, peak: f64) -> bool {
            let at = |x: f64| value(&Weights::at(x));
            at(peak) > at(peak * 1.000_01) && at(peak) > at(peak / 1.000_01)
        }
        assert!(is_highest(|weights| weights.log, LOG_PEAK));
        assert!(is_highest(|weights| weights.pole, POLE_PEAK));
        assert!(is_highest(Weights::swell, SWELL_PEAK));
    }
}
