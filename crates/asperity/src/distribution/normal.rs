//! The standard normal distribution: its quantiles, many at a time; its cumulative hazard -ln Phi(-g), which is the standard exponential
//! variable of equal probability; means over it.

use std::array::from_fn;
use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

use libm::erfc;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::numeric::Sum;
use crate::numeric::lanes::{MOST, Real, Work, run};

/// Distance from 0.5 of the probabilities that the rational function serves.
const CENTRAL: f64 = 0.425;

/// Coefficients in CENTRAL^2 - (p - 0.5)^2 of the rational function (Wichura 1988, Applied Statistics 37(3), 477-484, algorithm AS 241,
/// PPND16), highest powers first.
const NUMERATOR: [f64; 8] = [
    2_509.080_928_730_122_7,
    33_430.575_583_588_13,
    67_265.770_927_008_7,
    45_921.953_931_549_87,
    13_731.693_765_509_46,
    1_971.590_950_306_551_3,
    133.141_667_891_784_38,
    3.387_132_872_796_366_5,
];
const DENOMINATOR: [f64; 8] = [
    5_226.495_278_852_854,
    28_729.085_735_721_943,
    39_307.895_800_092_71,
    21_213.794_301_586_597,
    5_394.196_021_424_751,
    687.187_007_492_057_9,
    42.313_330_701_600_91,
    1.0,
];

/// Replaces probabilities in (0, 1) by the quantiles: within 1e-15 (relative) where they are at most 0.425 from 0.5, by statrs elsewhere.
pub(super) fn normal_quantiles(field: &mut [f64]) {
    run(Quantiles { field });
}

struct Quantiles<'a> {
    field: &'a mut [f64],
}

impl Work for Quantiles<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let (whole, rest) = self.field.as_chunks_mut::<MOST>();
        for probabilities in whole {
            let from_center = probabilities.map(|p| p - 0.5);
            if from_center.iter().all(|q| q.abs() <= CENTRAL) {
                for k in (0..MOST).step_by(N::LANES) {
                    central(zero.load(&from_center[k..])).store(&mut probabilities[k..]);
                }
            } else {
                probabilities.iter_mut().for_each(|p| *p = quantile(*p));
            }
        }
        rest.iter_mut().for_each(|p| *p = quantile(*p));
    }
}

fn quantile(p: f64) -> f64 {
    let from_center = p - 0.5;
    if from_center.abs() <= CENTRAL { central(from_center) } else { Normal::standard().inverse_cdf(p) }
}

#[inline(always)]
fn central<N: Real>(from_center: N) -> N {
    let r = -(from_center * from_center) + CENTRAL * CENTRAL;
    from_center * r.polynomial(&NUMERATOR) / r.polynomial(&DENOMINATOR)
}

/// -ln Phi(-g), computed from the smaller tail without cancellation. The error function is that of libm, to an ulp;
/// that of statrs 0.19 is off by up to 2e-9 in the tail.
fn hazard(g: f64) -> f64 {
    let tail = 0.5 * erfc(g.abs() / SQRT_2);
    if g < 0.0 { -(-tail).ln_1p() } else { -tail.ln() }
}

/// Half the number of panels, and the largest |g|.
const HALF: usize = 36;
const END: f64 = 9.0;

/// Terms of a panel.
const TERMS: usize = 10;

/// Coefficients of all panels.
pub(super) type Panels = [[f64; TERMS]; 2 * HALF];

/// Chebyshev coefficients of ln(-ln Phi(-g)) on panels over [-9, 9]. The nearest complex zeros of Phi
/// are 2.8 away, 22 times the half width of a panel, so ten terms reach rounding, four times faster than
/// an error function, a logarithm and a power.
pub(super) static PANELS: LazyLock<Panels> = LazyLock::new(|| {
    let angle = |node: usize| PI * (node as f64 + 0.5) / TERMS as f64;
    from_fn(|panel| {
        let at = |t: f64| hazard((panel as f64 + 0.5 + 0.5 * t) * (END / HALF as f64) - END).ln();
        // Relative to the value in the middle: rounding errors are then relative to the change across a panel.
        let middle = at(0.0);
        let values: [f64; TERMS] = from_fn(|node| at(angle(node).cos()) - middle);
        from_fn(|order| {
            let sum: f64 = (0..TERMS).map(|node| values[node] * (order as f64 * angle(node)).cos()).sum();
            if order == 0 { middle + sum / TERMS as f64 } else { 2.0 * sum / TERMS as f64 }
        })
    })
});

/// ln(-ln Phi(-g)), by the panels of [`PANELS`].
#[inline]
pub(super) fn log_hazard(panels: &Panels, g: f64) -> f64 {
    let place = (g + END) * (HALF as f64 / END);
    // A negative place or a NaN becomes a panel whose t is out of range.
    let panel = place as usize;
    let t = 2.0 * (place - panel as f64) - 1.0;
    match panels.get(panel) {
        // Clenshaw's sum.
        Some(terms) if t >= -1.0 => {
            let (mut next, mut after) = (0.0, 0.0);
            for &term in terms[1..].iter().rev() {
                (next, after) = (term + 2.0 * t * next - after, next);
            }
            terms[0] + t * next - after
        }
        _ => hazard(g).ln(),
    }
}

/// Mean, standard deviation, skewness and kurtosis of a distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Skewness.
    pub skewness: f64,
    /// Kurtosis (3 if normal).
    pub kurtosis: f64,
}

impl Moments {
    /// Moments of `map(g)` for standard normal g, by the trapezoidal rule with this step.
    pub(super) fn integrate(step: f64, map: impl Fn(f64) -> f64) -> Self {
        let values: Vec<[f64; 2]> = normal_nodes(step).map(|[g, weight]| [map(g), weight]).collect();
        let mean_of = |term: &dyn Fn(f64) -> f64| {
            values.iter().map(|&[value, weight]| weight * term(value)).collect::<Sum>().value()
        };
        let mean = mean_of(&|y| y);
        let sd = mean_of(&|y| (y - mean).powi(2)).sqrt();
        let skewness = mean_of(&|y| ((y - mean) / sd).powi(3));
        let kurtosis = mean_of(&|y| ((y - mean) / sd).powi(4));
        Self { mean, sd, skewness, kurtosis }
    }
}

/// The largest |g| of the trapezoidal rule: beyond it exp(4 u) times the normal density underflows for the largest
/// kurtosis, u = 1.22 g.
const LARGEST: f64 = 14.0;

/// Abscissae g and weights of a mean over a standard normal variable: the trapezoidal rule, which
/// converges exponentially for a smooth integrand on the whole line.
pub(crate) fn normal_nodes(step: f64) -> impl Iterator<Item = [f64; 2]> {
    let last = (LARGEST / step).ceil() as i64;
    let scale = step / (2.0 * PI).sqrt();
    (-last..=last).map(move |k| {
        let g = k as f64 * step;
        [g, scale * (-0.5 * g * g).exp()]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against values of 30 digits, and against the quantiles one by one.
    #[test]
    fn quantiles_many_at_a_time() {
        let mut known = [0.075, 0.25, 0.4, 0.5, 0.6, 0.75, 0.925, 0.4];
        normal_quantiles(&mut known);
        let (outer, quartile, inner) =
            (1.439_531_470_938_456, 0.674_489_750_196_081_7, 0.253_347_103_135_799_8);
        let wanted = [-outer, -quartile, -inner, 0.0, inner, quartile, outer, -inner];
        for (found, wanted) in known.into_iter().zip(wanted) {
            assert!((found - wanted).abs() <= 1e-15 * wanted.abs(), "{found} {wanted}");
        }
        let count = 10_007;
        let probability = |k: usize| (((k * 7919) % count) as f64 + 0.5) / count as f64;
        let mut field: Vec<f64> = (0..count).map(probability).collect();
        normal_quantiles(&mut field);
        for (k, found) in field.into_iter().enumerate() {
            let wanted = Normal::standard().inverse_cdf(probability(k));
            assert!((found - wanted).abs() <= 3e-15 * wanted.abs(), "{k}: {found} {wanted}");
        }
        let mut tails = [1e-300, 1e-9, 0.01, 1.0 - 1e-9];
        let wanted = tails.map(|p| Normal::standard().inverse_cdf(p));
        normal_quantiles(&mut tails);
        assert_eq!(tails, wanted);
    }

    #[test]
    fn both_tails_keep_their_digits() {
        // The shape 1 is the exponential: T + 1 = -ln Phi(-g); mpmath.
        for (g, exact) in [
            (-9.0, 1.1285884059538406e-19),
            (-3.0, 0.0013508099647481938),
            (0.0, std::f64::consts::LN_2),
            (3.0, 6.607726221510343),
            (9.0, 43.628149113332115),
        ] {
            assert!((hazard(g) / exact - 1.0).abs() < 4e-15, "{g}: {}", hazard(g));
        }
    }

    #[test]
    fn panels_are_the_function_to_rounding() {
        for k in -95_000..=95_000 {
            let g = f64::from(k) * 1e-4;
            let exact = hazard(g).ln();
            let gap = (log_hazard(&PANELS, g) - exact).abs();
            assert!(gap <= 4e-15 * exact.abs().max(1.0), "{g}: {gap:e} of {exact}");
        }
        assert!(log_hazard(&PANELS, f64::NAN).is_nan());
    }
}
