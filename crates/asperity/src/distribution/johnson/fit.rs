//! Fit of a curve to a given skewness and kurtosis.

use super::{Curve, Johnson, MAX_RATE};
use crate::distribution::Moments;
use crate::numeric::root::{WIDTH, last_reaching, last_reaching_within};

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
    let fit = BoundedFit { skewness, kurtosis, flattest };
    fit.quickly().map_or_else(|| fit.surely(), Ok)
}

/// A skewness >= 0 and a kurtosis to be fitted by SB.
struct BoundedFit {
    skewness: f64,
    kurtosis: f64,
    flattest: f64,
}

impl BoundedFit {
    /// Moments for 1/delta = `rate` and gamma/delta = `offset`.
    fn moments(&self, rate: f64, offset: f64) -> Moments {
        self.moments_with(step(rate), rate, offset)
    }

    /// By the trapezoidal rule of a step.
    fn moments_with(&self, step: f64, rate: f64, offset: f64) -> Moments {
        let unit = Johnson {
            curve: Curve::Bounded,
            rate,
            weights: logistic(offset),
            mean: 0.0,
            sd: 1.0,
            requested: [self.skewness, self.kurtosis],
        };
        Moments::integrate(step, |g| unit.map(g))
    }

    /// gamma/delta at which the skewness is reached, to a relative width.
    fn offset(&self, rate: f64, width: f64) -> f64 {
        // The far end is the lognormal to rounding.
        let far = -45.0 - 10.0 * rate;
        if self.skewness == 0.0 {
            return 0.0;
        }
        let step = Self::step_within(width, rate);
        let skewness = |x: f64| self.moments_with(step, rate, -x).skewness;
        -last_reaching_within(skewness, self.skewness, far, 0.0, width).unwrap_or(far)
    }

    /// The kurtosis along the curve of the prescribed skewness.
    fn kurtosis_at(&self, rate: f64, width: f64) -> f64 {
        if rate == 0.0 {
            return 3.0;
        }
        self.moments_with(Self::step_within(width, rate), rate, self.offset(rate, width)).kurtosis
    }

    /// The step for moments that a search to a relative `width` needs: to a coarse one, of an error of 1e-5.
    fn step_within(width: f64, rate: f64) -> f64 {
        /// Steps of the exact moments.
        const COARSE: f64 = 4.0;
        if width >= 1e-3 { COARSE * step(rate) } else { step(rate) }
    }

    /// By Newton's method from a coarse search, some fifty times as fast as [`Self::surely`], the same to rounding; `None` where it
    /// does not converge.
    fn quickly(&self) -> Option<(f64, f64)> {
        /// Relative width at which the search ends.
        const COARSE: f64 = 1e-2;
        const STEPS: usize = 12;
        /// Relative change of both numbers by a step that ends the search, and the difference for slopes.
        const LAST: f64 = 1e-12;
        const DIFFERENCE: f64 = 1e-7;
        let reached = |rate: f64| self.kurtosis_at(rate, COARSE);
        let mut rate = last_reaching_within(reached, self.kurtosis, self.flattest, MAX_RATE, COARSE)?;
        let mut offset = self.offset(rate, COARSE);
        let gap = |rate: f64, offset: f64| {
            let Moments { skewness, kurtosis, .. } = self.moments(rate, offset);
            [skewness - self.skewness, kurtosis - self.kurtosis]
        };
        for _ in 0..STEPS {
            let [s, k] = gap(rate, offset);
            let steps = [rate, offset].map(|x| DIFFERENCE * x.abs().max(1.0));
            let [by_rate, by_offset] = [gap(rate + steps[0], offset), gap(rate, offset + steps[1])];
            let slopes = |value: [f64; 2], step: f64| [(value[0] - s) / step, (value[1] - k) / step];
            let ([sr, kr], [so, ko]) = (slopes(by_rate, steps[0]), slopes(by_offset, steps[1]));
            let determinant = sr * ko - so * kr;
            let change = [(so * k - ko * s) / determinant, (kr * s - sr * k) / determinant];
            (rate, offset) = (rate + change[0], offset + change[1]);
            if !(self.flattest < rate && rate < MAX_RATE && offset > 0.0) {
                return None;
            }
            if change[0].abs() <= LAST * rate && change[1].abs() <= LAST * offset {
                return Some((rate, offset));
            }
        }
        None
    }

    /// By nested searches; `Err` holds the smallest kurtosis that can be fitted.
    fn surely(&self) -> Result<(f64, f64), f64> {
        let reached = |rate: f64| self.kurtosis_at(rate, WIDTH);
        let least = reached(MAX_RATE);
        if self.kurtosis < least {
            return Err(least);
        }
        let rate = last_reaching(reached, self.kurtosis, self.flattest, MAX_RATE).unwrap_or(self.flattest);
        Ok((rate, self.offset(rate, WIDTH)))
    }
}

/// The step of the trapezoidal rule, whose error is exp(-2 pi d/step) with d the distance of the nearest pole from the
/// real axis, pi delta for SB.
pub(super) fn step(rate: f64) -> f64 {
    (0.4 / rate).min(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where Newton's method ends, it ends where the nested searches do; it mostly does.
    #[test]
    fn the_quick_fit_is_the_sure_one() {
        let (mut all, mut quick) = (0, 0);
        for skewness in [0.01, 0.2, 0.7, 1.3, 2.0, 3.5] {
            let line = unbounded_moments(lognormal_excess(skewness), 1.0)[1];
            let bound = skewness * skewness + 1.0;
            for share in [0.2, 0.5, 0.8, 0.95] {
                let fit = BoundedFit {
                    skewness,
                    kurtosis: bound + share * (line - bound),
                    flattest: rate_of(lognormal_excess(skewness)),
                };
                all += 1;
                if let Some((rate, offset)) = fit.quickly() {
                    quick += 1;
                    let (exact_rate, exact_offset) = fit.surely().unwrap();
                    let error = (rate / exact_rate - 1.0).abs().max((offset / exact_offset - 1.0).abs());
                    assert!(error < 1e-10, "{skewness}, {share}: {error:e}");
                }
            }
        }
        assert!(quick >= all - 2, "{quick} of {all}");
    }
}
