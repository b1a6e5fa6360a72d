//! How much of a layered flat an asperity feels: the functions of xi = t/a behind Eqs. 17 and 18.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};
use std::sync::LazyLock;

/// The parts of the weights I1 (Eq. 17) and I0 (Eq. 18) that no material enters.
///
/// With q = min(xi, 1/xi), nothing in them or in what is made of them cancels, from xi = 1e-300 to 1e300.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    /// Whether the layer weighs more: xi >= 1. The weights below are then those of the substrate.
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
        let whole = (1.0 + small).recip();
        let [angle, log] = TABLE.at(inverse).unwrap_or_else(|| exact(inverse));
        Self {
            in_layer,
            angle,
            log,
            pole: FRAC_1_PI * q * whole,
            part: if in_layer { small * whole } else { whole },
        }
    }

    /// Weight of the body that weighs less in nu_eff: I1 of the layer, 1 - I1 of the substrate (Eqs. 14, 17).
    #[inline]
    pub(super) fn of_poisson(&self) -> f64 {
        self.angle + self.signed(self.log)
    }

    /// Weight of the body that weighs less in E_eff: I0 of the layer, 1 - I0 of the substrate (Eqs. 15, 18),
    /// given nu_eff.
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
pub(super) const LOG_PEAK: f64 = 1.980_291_300_432_212_9;
pub(super) const POLE_PEAK: f64 = 1.0;
pub(super) const SWELL_PEAK: f64 = 0.681_250_038_633_213_3;

/// (2/pi) arctan q and (xi/pi) ln(1 + 1/xi^2), from the definitions.
fn exact(inverse: f64) -> [f64; 2] {
    if inverse <= 1.0 {
        // For 1/xi below 1e-154 the square vanishes, and the logarithm is 1/xi^2 to all digits.
        let log = if inverse > 1e-100 { (inverse * inverse).ln_1p() / inverse } else { inverse };
        [FRAC_2_PI * inverse.atan(), FRAC_1_PI * log]
    } else {
        let xi = inverse.recip();
        [FRAC_2_PI * xi.atan(), FRAC_1_PI * xi * ((xi * xi).ln_1p() + 2.0 * inverse.ln())]
    }
}

const INTERVALS: usize = 32;
const TERMS: usize = 8;
/// The table covers 1/xi from 2^-OCTAVES to 2^OCTAVES.
const OCTAVES: i32 = 24;
const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// Both functions as polynomials, one pair for each 32nd of an octave of 1/xi. Each is analytic but at 0 and
/// +-i, so that on so short an interval eight terms leave 132^-8 of it: below rounding. About a third of the time
/// of `atan` and `ln_1p`.
struct Table(Vec<Piece>);

struct Piece {
    middle: f64,
    /// Of the half width.
    inverse: f64,
    coefficients: [[f64; 2]; TERMS],
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let octave = |power: i32| (0..INTERVALS).map(move |k| (power, k));
    let piece = |(power, k): (i32, usize)| {
        let width = 2f64.powi(power) / INTERVALS as f64;
        Piece::through(2f64.powi(power) + (k as f64 + 0.5) * width, 0.5 * width)
    };
    Table((-OCTAVES..OCTAVES).flat_map(octave).map(piece).collect())
});

impl Table {
    #[inline]
    fn at(&self, x: f64) -> Option<[f64; 2]> {
        let place = x.to_bits() >> (MANTISSA_BITS - INTERVALS.ilog2());
        let first = ((1023 - OCTAVES) as u64) << INTERVALS.ilog2();
        let piece = self.0.get(usize::try_from(place.wrapping_sub(first)).ok()?)?;
        let r = (x - piece.middle) * piece.inverse;
        let mut value = piece.coefficients[TERMS - 1];
        for k in (0..TERMS - 1).rev() {
            for (value, term) in value.iter_mut().zip(piece.coefficients[k]) {
                *value = *value * r + term;
            }
        }
        Some(value)
    }
}

impl Piece {
    /// Interpolates at the Chebyshev points of middle +- half.
    fn through(middle: f64, half: f64) -> Self {
        use std::f64::consts::PI;
        let angle = |j: usize| PI * (j as f64 + 0.5) / TERMS as f64;
        // Away from the middle they differ by a 64th: sums of differences round that much less.
        let centre = exact(middle);
        let values: [[f64; 2]; TERMS] = std::array::from_fn(|j| {
            let value = exact(middle + half * angle(j).cos());
            [value[0] - centre[0], value[1] - centre[1]]
        });
        let mut coefficients = [[0.0; 2]; TERMS];
        // T_0 and T_1 as powers of r; each next one is 2 r T_k - T_(k-1).
        let (mut before, mut chebyshev) = ([0.0; TERMS], [0.0; TERMS]);
        chebyshev[0] = 1.0;
        for k in 0..TERMS {
            let share = if k == 0 { 1.0 } else { 2.0 } / TERMS as f64;
            for f in 0..2 {
                let sum: f64 = (0..TERMS).map(|j| values[j][f] * (k as f64 * angle(j)).cos()).sum();
                for (total, power) in coefficients.iter_mut().zip(chebyshev) {
                    total[f] += share * sum * power;
                }
            }
            let mut next = before.map(|c| -c);
            let double = if k == 0 { 1.0 } else { 2.0 };
            for j in 0..TERMS - 1 {
                next[j + 1] += double * chebyshev[j];
            }
            (before, chebyshev) = (chebyshev, next);
        }
        coefficients[0] = [coefficients[0][0] + centre[0], coefficients[0][1] + centre[1]];
        Self { middle, inverse: half.recip(), coefficients }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_definition() {
        let mut worst: f64 = 0.0;
        for k in -400_000..400_000 {
            let x = (f64::from(k) * 4.15e-5).exp();
            let Some(found) = TABLE.at(x) else { panic!("{x:e} is in the table") };
            for (found, exact) in found.into_iter().zip(exact(x)) {
                worst = worst.max((found / exact - 1.0).abs());
            }
        }
        assert!(worst < 2e-15, "{worst:e}");
        for outside in [0.0, 1e-300, 1e-8, 1e8, 1e300, f64::INFINITY, f64::NAN] {
            assert!(TABLE.at(outside).is_none());
        }
    }

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
        let peaks: [(f64, fn(&Weights) -> f64); 3] =
            [(LOG_PEAK, |w| w.log), (POLE_PEAK, |w| w.pole), (SWELL_PEAK, Weights::swell)];
        for (peak, value) in peaks {
            let at = |x: f64| value(&Weights::at(x));
            assert!(at(peak) > at(peak * 1.000_01) && at(peak) > at(peak / 1.000_01));
        }
    }
}
