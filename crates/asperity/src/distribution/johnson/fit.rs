//! Fit of a curve to a given skewness and kurtosis.

use super::{Curve, Johnson, MAX_RATE};
use crate::distribution::Moments;
use crate::numeric::root::last_reaching;

/// 1/delta of (omega - 1)^.5.
pub(super) fn rate_of(excess: f64) -> f64 {
    (excess * excess).ln_1p().sqrt()
}

/// (omega - 1)^.5 of the lognormal heights of a skewness s >= 0: s^2 = (omega - 1)(omega + 2)^2, which
/// omega = 2 cosh(theta) - 1 turns into s = 2 sinh(1.5 theta).
pub(super) fn lognormal_excess(skewness: f64) -> f64 {
    2.0 * ((0.5 * skewness).asinh() / 3.0).sinh()
}

/// Skewness and kurtosis of SU for (omega - 1)^.5, omega = exp(1/delta^2), and t = p - q, which is
/// -tanh(gamma/delta): Johnson's moments (Elderton and Johnson 1969) divided by powers of
/// cosh(gamma/delta), so that t = 1 is the lognormal.
pub(super) fn unbounded_moments(excess: f64, t: f64) -> [f64; 2] {
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

/// (omega - 1)^.5 and t >= 0 of SU. At a given t the kurtosis increases with omega, from 3, and is at least that of t =
/// 0, which has a closed form; along the curve of the prescribed kurtosis the skewness increases with t. An end of a
/// bracket can miss its level by rounding only, and is then the solution.
pub(super) fn fit_unbounded(skewness: f64, kurtosis: f64) -> (f64, f64) {
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
pub(super) fn logistic(offset: f64) -> [f64; 2] {
    [1.0 / (1.0 + offset.exp()), 1.0 / (1.0 + (-offset).exp())]
}

/// 1/delta and gamma/delta >= 0 of SB, `flattest` being 1/delta of the lognormal heights of the same skewness. For a
/// given delta the skewness increases with gamma up to that of the lognormal; along the curve of the prescribed
/// skewness the kurtosis decreases with delta. `Err` holds the smallest kurtosis that can be fitted.
pub(super) fn fit_bounded(skewness: f64, kurtosis: f64, flattest: f64) -> Result<(f64, f64), f64> {
    let shape = |rate: f64, offset: f64| {
        let unit = Johnson {
            curve: Curve::Bounded,
            rate,
            weights: logistic(offset),
            mean: 0.0,
            sd: 1.0,
            requested: [skewness, kurtosis],
        };
        Moments::integrate(step(rate), |g| unit.map(g))
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
    let least = reached(MAX_RATE);
    if kurtosis < least {
        return Err(least);
    }
    let rate = last_reaching(reached, kurtosis, flattest, MAX_RATE).unwrap_or(flattest);
    Ok((rate, offset(rate)))
}

/// The step of the trapezoidal rule, whose error is exp(-2 pi d/step) with d the distance of the nearest pole from the
/// real axis, pi delta for SB.
pub(super) fn step(rate: f64) -> f64 {
    (0.4 / rate).min(0.25)
}
