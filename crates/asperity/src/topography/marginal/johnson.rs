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
//! Written so, y = u + O(u^2) without cancellation however large delta is, swapping the weights
//! mirrors the heights, and the three curves pass smoothly into each other and into the normal.

use std::fmt;

use super::{NoSuchHeights, Shape};
use crate::numeric::root::last_reaching;

/// How far a fitted skewness or kurtosis may be from the one asked for, relative above 1. Pairs
/// closer than that to the lognormal line or to the normal count as on it.
const TOLERANCE: f64 = 1e-9;

/// The largest skewness and kurtosis that are fitted. At a kurtosis of 200 half of the fourth
/// moment comes from |g| > 4.85, which one point in 800 000 exceeds: beyond, no map shows it.
pub const LARGEST: [f64; 2] = [10.0, 200.0];

/// The largest 1/delta of SB: its heights are all but two levels then.
const STEEPEST: f64 = 20.0;

/// The largest |u|: an SB height is at its bound to rounding there, an SU height beyond |g| = 240, and
/// squares do not overflow.
const SATURATED: f64 = 300.0;

/// A curve of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Curve {
    Normal,
    Lognormal,
    Unbounded,
    Bounded,
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
    asked: [f64; 2],
}

impl Johnson {
    /// The curve of this skewness and kurtosis (3 if normal): SU above the lognormal line, SB below.
    /// The moments of the map itself are checked by quadrature, to 1e-9.
    ///
    /// # Errors
    /// Numbers that are not finite; kurtosis < skewness^2 + 1, which nothing has; pairs so close to
    /// that bound that the heights are two levels; pairs beyond [`LARGEST`]; a failed check.
    pub fn from_moments(skewness: f64, kurtosis: f64) -> Result<Self, NoSuchHeights> {
        if !(skewness.is_finite() && kurtosis.is_finite()) {
            return Err(NoSuchHeights::NotFinite { skewness, kurtosis });
        }
        let bound = skewness * skewness + 1.0;
        if kurtosis < bound {
            return Err(NoSuchHeights::Impossible { skewness, kurtosis, bound });
        }
        if skewness.abs() > LARGEST[0] || kurtosis > LARGEST[1] {
            return Err(NoSuchHeights::Extreme { skewness, kurtosis });
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
                .map_err(|least| NoSuchHeights::TwoLevels { skewness, kurtosis, least })?;
            (Curve::Bounded, rate, logistic(offset))
        };
        let [p, q] = weights;
        let weights = if skewness < 0.0 { [q, p] } else { [p, q] };
        Self::new(curve, rate, weights, [skewness, kurtosis]).checked()
    }

    fn new(curve: Curve, rate: f64, weights: [f64; 2], asked: [f64; 2]) -> Self {
        let unit = Self { curve, rate, weights, mean: 0.0, sd: 1.0, asked };
        let (mean, sd) = match curve {
            Curve::Normal => (0.0, 1.0),
            Curve::Lognormal | Curve::Unbounded => {
                let [p, q] = weights;
                let excess = (rate * rate).exp_m1();
                let spread = 2.0 + excess * (1.0 + (p - q) * (p - q));
                ((p - q) * (0.5 * rate * rate).exp_m1(), (0.5 * excess * spread).sqrt())
            }
            Curve::Bounded => {
                let shape = Shape::of(step(rate), |g| unit.map(g));
                (shape.mean, shape.sd)
            }
        };
        Self { mean, sd, ..unit }
    }

    /// Refuses the map if its own moments are not those asked for.
    fn checked(self) -> Result<Self, NoSuchHeights> {
        // Half the step of the fit: an error of the quadrature shows as well.
        let found = Shape::of(0.5 * step(self.rate), |g| self.map(g));
        let close = |found: f64, asked: f64| (found - asked).abs() <= 2.0 * TOLERANCE * asked.abs().max(1.0);
        let [skewness, kurtosis] = self.asked;
        let good = close(found.mean, 0.0)
            && close(found.sd, 1.0)
            && close(found.skewness, skewness)
            && close(found.kurtosis, kurtosis);
        if good { Ok(self) } else { Err(NoSuchHeights::NotReached { asked: self.asked, found }) }
    }

    /// The height of the standard normal `g`.
    #[inline]
    pub fn map(&self, g: f64) -> f64 {
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
    pub fn derivative(&self, g: f64) -> f64 {
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

    /// Replaces every standard normal by `scale` times its height.
    pub(super) fn apply(&self, field: &mut [f64], scale: f64) {
        match self.curve {
            Curve::Normal => field.iter_mut().for_each(|z| *z *= scale),
            Curve::Lognormal | Curve::Unbounded => {
                field.iter_mut().for_each(|z| *z = scale * self.unbounded(*z));
            }
            Curve::Bounded => field.iter_mut().for_each(|z| *z = scale * self.bounded(*z)),
        }
    }

    /// Skewness of the heights.
    pub const fn skewness(&self) -> f64 {
        self.asked[0]
    }

    /// Kurtosis of the heights (3 if normal).
    pub const fn kurtosis(&self) -> f64 {
        self.asked[1]
    }
}

impl fmt::Display for Johnson {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let curve = match self.curve {
            Curve::Normal => "SN",
            Curve::Lognormal => "SL",
            Curve::Unbounded => "SU",
            Curve::Bounded => "SB",
        };
        let ([skewness, kurtosis], [p, q]) = (self.asked, self.weights);
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

/// 1/delta of (omega - 1)^.5.
fn rate_of(excess: f64) -> f64 {
    (excess * excess).ln_1p().sqrt()
}

/// (omega - 1)^.5 of the lognormal heights of a skewness s >= 0: s^2 = (omega - 1)(omega + 2)^2, which
/// omega = 2 cosh(theta) - 1 turns into s = 2 sinh(1.5 theta).
fn lognormal_excess(skewness: f64) -> f64 {
    2.0 * ((0.5 * skewness).asinh() / 3.0).sinh()
}

/// Skewness and kurtosis of SU for (omega - 1)^.5, omega = exp(1/delta^2), and t = p - q, which is
/// -tanh(gamma/delta): Johnson's moments (Elderton and Johnson 1969) divided by powers of
/// cosh(gamma/delta), so that t = 1 is the lognormal.
fn unbounded_moments(excess: f64, t: f64) -> [f64; 2] {
    let (e, t2) = (excess * excess, t * t);
    let omega = 1.0 + e;
    let square = omega * omega;
    let spread = 2.0 + e * (1.0 + t2);
    let third = omega * (omega + 2.0) * (3.0 + t2) + 3.0 * (1.0 - t2);
    let skewness = t * excess * third * (0.5 * omega / spread).sqrt() / spread;
    let fourth = square * (square * (square + 2.0 * omega + 3.0) - 3.0) * (1.0 + t2 * (6.0 + t2))
        + 4.0 * square * (omega + 2.0) * (1.0 - t2 * t2)
        + 3.0 * (2.0 * omega + 1.0) * (1.0 - t2).powi(2);
    [skewness, 0.5 * fourth / (spread * spread)]
}

/// (omega - 1)^.5 and t >= 0 of SU. At a given t the kurtosis rises with omega, from 3, and is at
/// least that of t = 0, which has a closed form; along the curve of the right kurtosis the skewness
/// rises with t. An end of a bracket can miss its level by rounding only, and is the answer then.
fn fit_unbounded(skewness: f64, kurtosis: f64) -> (f64, f64) {
    let root = (2.0 * kurtosis - 2.0).sqrt();
    let above = 2.0 * (kurtosis - 3.0) / (root + 2.0);
    let widest = (above / ((root - 1.0).sqrt() + 1.0)).sqrt();
    let excess =
        |t: f64| -last_reaching(|x| unbounded_moments(x, t)[1], kurtosis, -widest, 0.0).unwrap_or(-widest);
    if skewness == 0.0 {
        return (widest, 0.0);
    }
    let t = -last_reaching(|x| unbounded_moments(excess(x), -x)[0], skewness, -1.0, 0.0).unwrap_or(-1.0);
    (excess(t), t)
}

/// p and q for ln(q/p).
fn logistic(offset: f64) -> [f64; 2] {
    [1.0 / (1.0 + offset.exp()), 1.0 / (1.0 + (-offset).exp())]
}

/// 1/delta and gamma/delta >= 0 of SB, `flattest` being 1/delta of the lognormal heights of the same
/// skewness. For a given delta the skewness rises with gamma up to that of the lognormal; along the
/// curve of the right skewness the kurtosis falls as delta does. `Err` holds the least kurtosis that is fitted.
fn fit_bounded(skewness: f64, kurtosis: f64, flattest: f64) -> Result<(f64, f64), f64> {
    let shape = |rate: f64, offset: f64| {
        let unit = Johnson {
            curve: Curve::Bounded,
            rate,
            weights: logistic(offset),
            mean: 0.0,
            sd: 1.0,
            asked: [skewness, kurtosis],
        };
        Shape::of(step(rate), |g| unit.map(g))
    };
    let offset = |rate: f64| {
        // The far end is the lognormal to rounding.
        let far = -45.0 - 10.0 * rate;
        if skewness == 0.0 {
            0.0
        } else {
            -last_reaching(|x| shape(rate, -x).skewness, skewness, far, 0.0).unwrap_or(far)
        }
    };
    let reached = |rate: f64| if rate == 0.0 { 3.0 } else { shape(rate, offset(rate)).kurtosis };
    let least = reached(STEEPEST);
    if kurtosis < least {
        return Err(least);
    }
    let rate = last_reaching(reached, kurtosis, flattest, STEEPEST).unwrap_or(flattest);
    Ok((rate, offset(rate)))
}

/// The trapezoidal rule errs by exp(-2 pi d/step), d the distance of the nearest pole from the real
/// axis; that of SB is pi delta.
fn step(rate: f64) -> f64 {
    (0.4 / rate).min(0.25)
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
    // Not f64::min, which would make a number of a NaN.
    let u = if u > SATURATED { SATURATED } else { u };
    let shifted = u * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (u - k * LN_2[0]) - k * LN_2[1];
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52));
    let series = INVERSE_FACTORIALS.iter().rev().fold(0.0, |series, term| series * r + term);
    power * (r * series) + (power - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::marginal::tests::moments;

    fn fit(skewness: f64, kurtosis: f64) -> Johnson {
        Johnson::from_moments(skewness, kurtosis).unwrap()
    }

    fn line(skewness: f64) -> f64 {
        unbounded_moments(lognormal_excess(skewness.abs()), 1.0)[1]
    }

    #[test]
    fn every_pair_is_fitted_or_refused_with_the_reason() {
        for i in -16..=16 {
            let skewness = 0.25 * f64::from(i);
            let bound = skewness * skewness + 1.0;
            for above in [0.11, 0.3, 0.8, 1.4, 1.9, 1.999, 2.001, 2.2, 3.0, 5.0, 9.0, 24.0, 90.0, 183.0] {
                let kurtosis = bound + above;
                match Johnson::from_moments(skewness, kurtosis) {
                    Ok(johnson) => {
                        let found = moments(|g| johnson.map(g));
                        let wanted = [0.0, 1.0, skewness, kurtosis];
                        for (found, wanted) in found.into_iter().zip(wanted) {
                            assert!((found - wanted).abs() < 1e-11 * kurtosis, "{johnson}: {found}");
                        }
                    }
                    Err(NoSuchHeights::TwoLevels { least, .. }) => {
                        assert!(kurtosis < least && least < bound + 0.09 + 0.02 * skewness * skewness);
                        let least = fit(skewness, least * (1.0 + 1e-12));
                        assert!((least.rate - STEEPEST).abs() < 1e-8, "{least}");
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }

    #[test]
    fn pairs_close_to_the_normal_and_to_the_lognormal_line() {
        for skewness in [0.0, 1e-12, 1e-7, 1e-4, 0.01, 0.3, 3.0, 6.0, 10.0] {
            for off in [1e-12, 1e-10, 1.1e-9, 1e-8, 1e-6, 1e-4] {
                for kurtosis in [line(skewness) * (1.0 + off), line(skewness) * (1.0 - off)] {
                    if kurtosis > LARGEST[1] {
                        continue;
                    }
                    let johnson = Johnson::from_moments(skewness, kurtosis);
                    let johnson = johnson.unwrap_or_else(|e| panic!("{e}"));
                    let lognormal = Johnson::from_moments(skewness, line(skewness)).unwrap();
                    for g in [-9.0, -4.0, -1.0, 0.0, 1e-9, 0.5, 2.0, 4.0] {
                        let change = (johnson.map(g) - lognormal.map(g)).abs();
                        assert!(change < 1e4 * (off + 1e-9), "{johnson}, g = {g}: {change}");
                    }
                }
            }
        }
        assert_eq!(fit(0.0, 3.0).curve, Curve::Normal);
        assert_eq!(fit(2.0, line(2.0)).curve, Curve::Lognormal);
        assert_eq!(fit(2.0, line(2.0) * (1.0 + 1e-8)).curve, Curve::Unbounded);
        assert_eq!(fit(2.0, line(2.0) * (1.0 - 1e-8)).curve, Curve::Bounded);
    }

    #[test]
    fn curves_that_are_known() {
        // omega = e^.25: skewness (omega + 2)(omega - 1)^.5, and delta = 2.
        let omega = 0.25f64.exp();
        let lognormal = fit((omega + 2.0) * (omega - 1.0).sqrt(), line((omega + 2.0) * (omega - 1.0).sqrt()));
        for g in [-9.0f64, -1.0, 0.0, 2.0, 9.0] {
            let exact = ((0.5 * g).exp() - omega.sqrt()) / (omega * (omega - 1.0)).sqrt();
            assert!((lognormal.map(g) / exact - 1.0).abs() < 1e-12, "{g}: {} {exact}", lognormal.map(g));
        }
        // gamma = 0: kurtosis (omega^4 + 2 omega^2 + 3)/2.
        let unbounded = fit(0.0, 0.5 * (omega.powi(4) + 2.0 * omega * omega + 3.0));
        assert!((unbounded.rate - 0.5).abs() < 1e-14);
        assert!(
            (unbounded.map(3.0) / (1.5f64.sinh() / (0.5 * (omega * omega - 1.0)).sqrt()) - 1.0).abs() < 1e-13
        );
        // The logit-normal of delta = 1, gamma = 1, straight from its definition.
        let [_, _, skewness, kurtosis] = moments(|g| 1.0 / (1.0 + (1.0 - g).exp()));
        let bounded = fit(skewness, kurtosis);
        assert_eq!(bounded.curve, Curve::Bounded);
        assert!((bounded.rate - 1.0).abs() < 1e-12 && (bounded.weights[0] - logistic(1.0)[0]).abs() < 1e-12);
        assert_eq!(
            bounded.to_string(),
            format!(
                "Johnson SB, skewness {skewness}, kurtosis {kurtosis} (gamma = 1.000000, delta = 1.000000)"
            )
        );
    }

    #[test]
    fn the_quick_exponential_is_the_library_one() {
        for k in 0..300_000 {
            let u = f64::from(k) * 1e-3;
            for u in [u, u * 1e-2, u * 1e-9] {
                let exact = u.exp_m1();
                assert!((exp_m1(u) - exact).abs() <= 4.0 * f64::EPSILON * exact, "{u}");
            }
        }
        assert_eq!(exp_m1(1e9), exp_m1(SATURATED));
        assert!(fit(0.0, 2.0).map(f64::NAN).is_nan() && fit(0.0, 4.0).map(f64::NAN).is_nan());
    }

    #[test]
    fn a_negative_skewness_mirrors_the_heights() {
        for (skewness, kurtosis) in [(0.7, 3.2), (1.0, 4.5), (1.5, line(1.5)), (2.0, 12.0)] {
            let (up, down) = (fit(skewness, kurtosis), fit(-skewness, kurtosis));
            for k in -90..=90 {
                let g = 0.1 * f64::from(k);
                assert_eq!(down.map(g), -up.map(-g));
                assert_eq!(down.derivative(g), up.derivative(-g));
            }
        }
    }

    #[test]
    fn what_nothing_has_is_refused_and_said() {
        let say = |skewness, kurtosis| Johnson::from_moments(skewness, kurtosis).unwrap_err().to_string();
        assert!(say(1.0, 1.5).ends_with("a kurtosis is at least skewness^2 + 1 = 2"));
        assert!(say(1.0, 2.0).contains("two levels; allowed at this skewness is a kurtosis from 2.0"));
        assert!(say(0.0, 201.0).ends_with("allowed are a skewness from -10 to 10 and a kurtosis up to 200"));
        assert!(say(-10.5, 150.0).contains("a skewness from -10 to 10"));
        for (skewness, kurtosis) in [(f64::NAN, 3.0), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 3.0)] {
            assert!(say(skewness, kurtosis).ends_with("allowed are finite numbers"));
        }
        let wrong = Johnson::new(Curve::Unbounded, 0.5, [0.5, 0.5], [0.0, 3.5]);
        assert!(
            matches!(wrong.checked(), Err(NoSuchHeights::NotReached { found, .. }) if found.kurtosis > 4.0)
        );
    }
}
