//! Quantiles of the standard normal distribution, many at a time.

use statrs::distribution::{ContinuousCDF, Normal};

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
}
