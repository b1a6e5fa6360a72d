//! Johnson's system: heights of any possible skewness and kurtosis.
//!
//! Johnson (1949) takes g = gamma + delta f((z - xi)/lambda) as standard normal, with f the inverse
//! hyperbolic sine (SU, unbounded heights), the logarithm (SL) or the logit (SB, bounded heights).
//! With u = g/delta and two weights p + q = 1 the standardised heights are T = (y - E y)/sd y,
//!
//! | curve | y(u) | weights |
//! |---|---|---|
//! | SU | p expm1(u) - q expm1(-u) | q/p = exp(2 gamma/delta) |
//! | SL | SU with p = 1, or q = 1 for a negative skewness | |
//! | SB | expm1(u)/(1 + p expm1(u)) | q/p = exp(gamma/delta) |
//!
//! In this form y = u + O(u^2) without cancellation for any delta, swapping the weights mirrors the heights, and the
//! three curves join smoothly with each other and with the normal.

mod fit;

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt;

use libm::erfc;

use super::normal::normal_quantiles;
use super::{Entry, Gaussian, HeightDistribution, Heights, Moments};
use crate::literature::{JOHNSON_1949, Paper};
use fit::{fit_bounded, fit_unbounded, logistic, lognormal_excess, rate_of, step, unbounded_moments};

pub(super) const ENTRY: Entry = Entry {
    name: "johnson",
    parameters: &[("skewness", -1.0), ("kurtosis", 4.5)],
    make: |values| Ok(Heights::new(Johnson::from_moments(values[0], values[1])?)),
};

/// Tolerance of a fitted skewness or kurtosis, relative above 1. Pairs within it of the lognormal line or of the normal
/// count as on it.
const TOLERANCE: f64 = 1e-9;

/// The largest skewness and kurtosis that are fitted. At a kurtosis of 200 half of the fourth moment comes from |g| >
/// 4.85, which one point in 800 000 exceeds: no map resolves larger ones.
pub const LARGEST: [f64; 2] = [10.0, 200.0];

/// The largest 1/delta of SB: the heights are then nearly two levels.
const MAX_RATE: f64 = 20.0;

/// The largest |u|: an SB height is at its bound to rounding there, an SU height beyond |g| = 240, and
/// squares do not overflow.
const SATURATED: f64 = 300.0;

/// Standard normal variable below which the density is negligible: exp(-g^2/2) = exp(-40).
const LOWEST: f64 = -8.944_271_909_999_16;

/// The load of a contact grows by at most this power of the indentation.
const GROWTH: f64 = 2.0;

/// Growth of the indentation, in e-foldings, that a panel resolves to full accuracy: its nearest singularity in the complex
/// plane is pi away.
const GROWTH_PER_PANEL: f64 = 3.0;

/// A curve of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Curve {
    Normal,
    Lognormal,
    Unbounded,
    Bounded,
}

/// No curve of the system has the requested skewness and kurtosis.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum MomentsError {
    /// Infinite or not a number.
    #[error("skewness {skewness}, kurtosis {kurtosis}: allowed are finite numbers")]
    NotFinite { skewness: f64, kurtosis: f64 },
    /// No distribution has these moments (Pearson's inequality).
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: no heights have them; \
         a kurtosis is at least skewness^2 + 1 = {bound}"
    )]
    Impossible { skewness: f64, kurtosis: f64, bound: f64 },
    /// Too close to the bound.
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: the heights are nearly on two levels; \
         allowed at this skewness is a kurtosis from {least:.6} to {}", LARGEST[1]
    )]
    TwoLevels { skewness: f64, kurtosis: f64, least: f64 },
    /// Beyond [`LARGEST`].
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: beyond the supported range; \
         allowed are a skewness from -{0} to {0} and a kurtosis up to {1}", LARGEST[0], LARGEST[1]
    )]
    Extreme { skewness: f64, kurtosis: f64 },
    /// The check of a fit failed.
    #[error(
        "the fit reaches mean {}, standard deviation {}, skewness {}, kurtosis {} instead of 0, 1, {}, {}",
        found.mean, found.sd, found.skewness, found.kurtosis, requested[0], requested[1]
    )]
    NotReached { requested: [f64; 2], found: Moments },
}

/// Heights of Johnson's system, of zero mean and unit standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Johnson {
    curve: Curve,
    /// 1/delta.
    rate: f64,
    /// p and q.
    weights: [f64; 2],
    mean: f64,
    sd: f64,
    requested: [f64; 2],
}

impl Johnson {
    /// The curve of this skewness and kurtosis (3 if normal): SU above the lognormal line, SB below.
    /// The moments of the map itself are checked by quadrature, to 1e-9.
    ///
    /// # Errors
    /// Numbers that are not finite; kurtosis < skewness^2 + 1, which is impossible; pairs so close to that bound that
    /// the heights are two levels; pairs beyond [`LARGEST`]; a failed check.
    pub fn from_moments(skewness: f64, kurtosis: f64) -> Result<Self, MomentsError> {
        if !(skewness.is_finite() && kurtosis.is_finite()) {
            return Err(MomentsError::NotFinite { skewness, kurtosis });
        }
        let bound = skewness * skewness + 1.0;
        if kurtosis < bound {
            return Err(MomentsError::Impossible { skewness, kurtosis, bound });
        }
        if skewness.abs() > LARGEST[0] || kurtosis > LARGEST[1] {
            return Err(MomentsError::Extreme { skewness, kurtosis });
        }
        let size = skewness.abs();
        let excess = lognormal_excess(size);
        let line = unbounded_moments(excess, 1.0)[1];
        let (curve, rate, weights) = if size <= TOLERANCE && (kurtosis - 3.0).abs() <= TOLERANCE {
            (Curve::Normal, 0.0, [0.5, 0.5])
        } else if (kurtosis / line - 1.0).abs() <= TOLERANCE {
            (Curve::Lognormal, rate_of(excess), [1.0, 0.0])
        } else if kurtosis > line {
            let (excess, asymmetry) = fit_unbounded(size, kurtosis);
            (Curve::Unbounded, rate_of(excess), [0.5 * (1.0 + asymmetry), 0.5 * (1.0 - asymmetry)])
        } else {
            let (rate, offset) = fit_bounded(size, kurtosis, rate_of(excess))
                .map_err(|least| MomentsError::TwoLevels { skewness, kurtosis, least })?;
            (Curve::Bounded, rate, logistic(offset))
        };
        let [p, q] = weights;
        let weights = if skewness < 0.0 { [q, p] } else { [p, q] };
        Self::new(curve, rate, weights, [skewness, kurtosis]).checked()
    }

    fn new(curve: Curve, rate: f64, weights: [f64; 2], requested: [f64; 2]) -> Self {
        let unit = Self { curve, rate, weights, mean: 0.0, sd: 1.0, requested };
        let (mean, sd) = match curve {
            Curve::Normal => (0.0, 1.0),
            Curve::Lognormal | Curve::Unbounded => {
                let [p, q] = weights;
                let excess = (rate * rate).exp_m1();
                let spread = 2.0 + excess * (1.0 + (p - q) * (p - q));
                ((p - q) * (0.5 * rate * rate).exp_m1(), (0.5 * excess * spread).sqrt())
            }
            Curve::Bounded => {
                let shape = Moments::integrate(step(rate), |g| unit.map(g));
                (shape.mean, shape.sd)
            }
        };
        Self { mean, sd, ..unit }
    }

    /// Rejects the map if its moments are not the requested ones.
    fn checked(self) -> Result<Self, MomentsError> {
        // Half the step of the fit: an error of the quadrature shows as well.
        let found = Moments::integrate(0.5 * step(self.rate), |g| self.map(g));
        let close = |found: f64, requested: f64| {
            (found - requested).abs() <= 2.0 * TOLERANCE * requested.abs().max(1.0)
        };
        let [skewness, kurtosis] = self.requested;
        let good = close(found.mean, 0.0)
            && close(found.sd, 1.0)
            && close(found.skewness, skewness)
            && close(found.kurtosis, kurtosis);
        if good { Ok(self) } else { Err(MomentsError::NotReached { requested: self.requested, found }) }
    }

    #[inline]
    fn map(&self, g: f64) -> f64 {
        match self.curve {
            Curve::Normal => g,
            Curve::Lognormal | Curve::Unbounded => self.unbounded(g),
            Curve::Bounded => self.bounded(g),
        }
    }

    #[inline]
    fn unbounded(&self, g: f64) -> f64 {
        let growth = exp_m1((self.rate * g).abs());
        let [along, against] = self.weights_at(g);
        self.standard((along * growth + against * (growth / (1.0 + growth))).copysign(g))
    }

    #[inline]
    fn bounded(&self, g: f64) -> f64 {
        let growth = exp_m1((self.rate * g).abs());
        let [along, _] = self.weights_at(g);
        self.standard((growth / (1.0 + along * growth)).copysign(g))
    }

    #[inline]
    fn weights_at(&self, g: f64) -> [f64; 2] {
        let [p, q] = self.weights;
        if g < 0.0 { [q, p] } else { [p, q] }
    }

    #[inline]
    fn standard(&self, y: f64) -> f64 {
        (y - self.mean) / self.sd
    }

    /// The slope dT/dg.
    fn derivative(&self, g: f64) -> f64 {
        let [along, against] = self.weights_at(g);
        let u = (self.rate * g).abs();
        let slope = match self.curve {
            Curve::Normal => return 1.0,
            Curve::Lognormal | Curve::Unbounded => along * u.exp() + against * (-u).exp(),
            Curve::Bounded => {
                let growth = exp_m1(u);
                (1.0 + growth) / (1.0 + along * growth).powi(2)
            }
        };
        self.rate / self.sd * slope
    }

    /// The standard normal variable of the height `z`; infinite outside the support.
    fn normal_at_height(&self, z: f64) -> f64 {
        let y = z.mul_add(self.sd, self.mean);
        let [p, q] = self.weights;
        let [along, against] = if y < 0.0 { [q, p] } else { [p, q] };
        let growth = match self.curve {
            Curve::Normal => return z,
            Curve::Lognormal | Curve::Unbounded => growth_of([along, against], y.abs()),
            Curve::Bounded if along * y.abs() < 1.0 => y.abs() / (1.0 - along * y.abs()),
            Curve::Bounded => f64::INFINITY,
        };
        (growth.ln_1p() / self.rate).copysign(y)
    }

    fn start(&self, h: f64) -> Start {
        let g = self.normal_at_height(h);
        let (g, x) = if g < LOWEST { (LOWEST, self.map(LOWEST) - h) } else { (g, 0.0) };
        Start { g, x, growth: (self.rate * g).exp() }
    }
}

/// The integral runs over v = g minus its value at the separation: the density in v is Gaussian for every curve, and
/// the indentation is smooth up to the ends.
impl HeightDistribution for Johnson {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn label(&self) -> &'static str {
        "Johnson"
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![("skewness", self.requested[0]), ("kurtosis", self.requested[1])]
    }

    fn papers(&self) -> &'static [Paper] {
        &[JOHNSON_1949]
    }

    fn skewness(&self) -> f64 {
        self.requested[0]
    }

    fn kurtosis(&self) -> f64 {
        self.requested[1]
    }

    fn support(&self) -> [f64; 2] {
        let [p, q] = self.weights;
        let [low, high] = match self.curve {
            Curve::Lognormal => {
                [if q == 0.0 { -1.0 } else { f64::NEG_INFINITY }, if p == 0.0 { 1.0 } else { f64::INFINITY }]
            }
            Curve::Bounded => [-q.recip(), p.recip()],
            Curve::Normal | Curve::Unbounded => return Gaussian.support(),
        };
        [self.standard(low), self.standard(high)]
    }

    fn density(&self, z: f64) -> f64 {
        let g = self.normal_at_height(z);
        if g.is_finite() { Gaussian.density(g) / self.derivative(g) } else { 0.0 }
    }

    fn survival(&self, z: f64) -> f64 {
        0.5 * erfc(self.normal_at_height(z) * FRAC_1_SQRT_2)
    }

    fn map_probabilities(&self, field: &mut [f64], scale: f64) {
        normal_quantiles(field);
        self.map_normals(field, scale);
    }

    fn height_at_normal(&self, g: f64) -> f64 {
        self.map(g)
    }

    fn map_normals(&self, field: &mut [f64], scale: f64) {
        match self.curve {
            Curve::Normal => field.iter_mut().for_each(|z| *z *= scale),
            Curve::Lognormal | Curve::Unbounded => {
                field.iter_mut().for_each(|z| *z = scale * self.unbounded(*z));
            }
            Curve::Bounded => field.iter_mut().for_each(|z| *z = scale * self.bounded(*z)),
        }
    }

    /// d ln f/dg = -g - d(ln dT/dg)/dg, the last at most 1/delta in magnitude.
    fn decreasing_from(&self) -> f64 {
        self.map(self.rate)
    }

    fn highest_separation(&self) -> f64 {
        self.map(Gaussian.highest_separation())
    }

    fn scale(&self, h: f64) -> f64 {
        let g = self.normal_at_height(h);
        if g < Gaussian.highest_separation() { Gaussian.scale(g) } else { 0.0 }
    }

    fn window(&self, h: f64) -> [f64; 2] {
        let growth = if self.curve == Curve::Bounded { 0.0 } else { GROWTH * self.rate };
        [0.0, Gaussian.window(self.start(h).g - growth)[1]]
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        let of_density = Gaussian.fractional_panels(self.start(h).g, from, to);
        (of_density + self.rate * (to - from) / GROWTH_PER_PANEL).ceil().max(1.0) as usize
    }

    fn variable(&self, h: f64, x: f64) -> f64 {
        let start = self.start(h);
        let y = (x - start.x) * self.sd;
        match self.curve {
            Curve::Normal => y,
            _ if y <= 0.0 => 0.0,
            Curve::Lognormal | Curve::Unbounded => {
                let [p, q] = self.weights;
                growth_of([p * start.growth, q / start.growth], y).ln_1p() / self.rate
            }
            Curve::Bounded => {
                let [p, q] = self.weights;
                let from = q + p * start.growth;
                let y = y * from;
                if y * p < 1.0 {
                    (y * (from / start.growth) / (1.0 - y * p)).ln_1p() / self.rate
                } else {
                    f64::INFINITY
                }
            }
        }
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        let (start, v) = (self.start(h), self.variable(h, x));
        if v.is_finite() {
            (-Gaussian.exponent(start.g, v)).exp() / self.derivative(start.g + v)
        } else {
            0.0
        }
    }

    fn apply_density(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        let start = self.start(h);
        Gaussian.apply_density(start.g, nodes, weights);
        let [p, q] = self.weights;
        match self.curve {
            Curve::Normal => nodes.iter_mut().for_each(|x| *x += start.x),
            Curve::Lognormal | Curve::Unbounded => {
                let [along, against] = [p * start.growth, q / start.growth];
                for x in nodes {
                    let growth = exp_m1(self.rate * *x);
                    *x = start.x + (along * growth + against * (growth / (1.0 + growth))) / self.sd;
                }
            }
            Curve::Bounded => {
                let against = q / start.growth;
                let from = (against + p) * self.sd * start.growth;
                for x in nodes {
                    let growth = exp_m1(self.rate * *x);
                    *x = start.x + growth / ((against + p * (1.0 + growth)) * from);
                }
            }
        }
    }
}

/// The lower end of an integral.
struct Start {
    /// The standard normal variable of the separation, at least [`LOWEST`].
    g: f64,
    /// The indentation there.
    x: f64,
    /// exp(g/delta).
    growth: f64,
}

impl fmt::Display for Johnson {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let curve = match self.curve {
            Curve::Normal => "SN",
            Curve::Lognormal => "SL",
            Curve::Unbounded => "SU",
            Curve::Bounded => "SB",
        };
        let ([skewness, kurtosis], [p, q]) = (self.requested, self.weights);
        write!(f, "Johnson {curve}, skewness {skewness}, kurtosis {kurtosis}")?;
        let delta = self.rate.recip();
        match self.curve {
            Curve::Normal => Ok(()),
            Curve::Lognormal => write!(f, " (delta = {delta:.6})"),
            Curve::Unbounded => {
                write!(f, " (gamma = {:.6}, delta = {delta:.6})", 0.5 * delta * (q / p).ln())
            }
            Curve::Bounded => write!(f, " (gamma = {:.6}, delta = {delta:.6})", delta * (q / p).ln()),
        }
    }
}

/// The growth x = exp(u) - 1 for which a x + b x/(1 + x) is `y` >= 0; infinite where there is none.
fn growth_of([a, b]: [f64; 2], y: f64) -> f64 {
    let c = a + b - y;
    let root = (c * c + 4.0 * a * y).sqrt();
    if c > 0.0 {
        2.0 * y / (c + root)
    } else if a > 0.0 {
        (root - c) / (2.0 * a)
    } else {
        f64::INFINITY
    }
}

/// 1/n! from n = 1.
const INVERSE_FACTORIALS: [f64; 14] = {
    let mut terms = [1.0; 14];
    let mut n = 1;
    while n < terms.len() {
        terms[n] = terms[n - 1] / (n + 1) as f64;
        n += 1;
    }
    terms
};

/// exp(u) - 1 for u >= 0, cut off at [`SATURATED`], to a few ulp, without a branch or a call, so that
/// loops over it are vectorised: 2^k exp(r) - 1 with |r| <= ln(2)/2 and the Taylor series of expm1(r).
#[inline]
fn exp_m1(u: f64) -> f64 {
    // Adding 1.5 2^52 rounds to an integer and leaves it in the low bits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    // ln 2 in two parts, the first with trailing zeros so that its multiples are exact.
    const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
    // Not f64::min, which would drop a NaN.
    let u = if u > SATURATED { SATURATED } else { u };
    let shifted = u * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (u - k * LN_2[0]) - k * LN_2[1];
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52));
    let series = INVERSE_FACTORIALS.iter().rev().fold(0.0, |series, term| series * r + term);
    power * (r * series) + (power - 1.0)
}

#[cfg(test)]
mod tests;
