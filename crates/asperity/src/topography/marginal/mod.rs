//! Height distributions: monotone maps by which a Gaussian field gets non-Gaussian heights.
//!
//! | module | what lives there |
//! |---|---|
//! | [`johnson`] | heights of a given skewness and kurtosis |
//! | [`weibull`] | heights of a Weibull shape |
//! | [`distortion`] | what a map does to the autocorrelation |
//!
//! T takes a standard normal g to a height of zero mean and unit standard deviation, exactly so in the
//! ensemble. A map of finite size scatters about that, as a Gaussian one does.

pub mod distortion;
pub mod johnson;
pub mod weibull;

use std::f64::consts::PI;
use std::fmt;

use rayon::prelude::*;

use crate::numeric::Sum;
pub use distortion::{Distortion, Inverse};
pub use johnson::Johnson;
pub use weibull::Weibull;

/// How many heights one task maps.
const CHUNK: usize = 1 << 14;

/// The height distribution of a generated surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Marginal {
    /// Normal heights: T(g) = g.
    Gaussian,
    /// Johnson's system, by skewness and kurtosis.
    Johnson(Johnson),
    /// Weibull heights, by shape.
    Weibull(Weibull),
}

/// Why there is no map of the heights asked for.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoSuchHeights {
    /// Infinite or not a number.
    #[error("skewness {skewness}, kurtosis {kurtosis}: allowed are finite numbers")]
    NotFinite {
        /// Asked for.
        skewness: f64,
        /// Asked for.
        kurtosis: f64,
    },
    /// No distribution has these moments (Pearson's inequality).
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: no heights have them; \
         a kurtosis is at least skewness^2 + 1 = {bound}"
    )]
    Impossible {
        /// Asked for.
        skewness: f64,
        /// Asked for.
        kurtosis: f64,
        /// skewness^2 + 1.
        bound: f64,
    },
    /// Too close to the bound.
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: heights on all but two levels; \
         allowed at this skewness is a kurtosis from {least:.6} to {}", johnson::LARGEST[1]
    )]
    TwoLevels {
        /// Asked for.
        skewness: f64,
        /// Asked for.
        kurtosis: f64,
        /// The least kurtosis that is fitted.
        least: f64,
    },
    /// Too far out.
    #[error(
        "skewness {skewness}, kurtosis {kurtosis}: in heights too rare for any map; \
         allowed are a skewness from -{0} to {0} and a kurtosis up to {1}", johnson::LARGEST[0], johnson::LARGEST[1]
    )]
    Extreme {
        /// Asked for.
        skewness: f64,
        /// Asked for.
        kurtosis: f64,
    },
    /// The check of a fit failed.
    #[error(
        "the fit reaches mean {}, standard deviation {}, skewness {}, kurtosis {} instead of 0, 1, {}, {}",
        found.mean, found.sd, found.skewness, found.kurtosis, asked[0], asked[1]
    )]
    NotReached {
        /// Skewness and kurtosis asked for.
        asked: [f64; 2],
        /// Those of the map.
        found: Shape,
    },
    /// Outside the shapes of [`weibull::SHAPES`].
    #[error("Weibull shape {0}; allowed: {least} to {most}", least = weibull::SHAPES[0], most = weibull::SHAPES[1])]
    WeibullShape(f64),
}

impl Marginal {
    /// The height of the standard normal `g`, in standard deviations. Rises with `g`.
    #[inline]
    pub fn map(&self, g: f64) -> f64 {
        match self {
            Self::Gaussian => g,
            Self::Johnson(johnson) => johnson.map(g),
            Self::Weibull(weibull) => weibull.map(g),
        }
    }

    /// The slope dT/dg.
    pub fn derivative(&self, g: f64) -> f64 {
        match self {
            Self::Gaussian => 1.0,
            Self::Johnson(johnson) => johnson.derivative(g),
            Self::Weibull(weibull) => weibull.derivative(g),
        }
    }

    /// Replaces every standard normal of `field` by its height times `scale`.
    pub fn apply(&self, field: &mut [f64], scale: f64) {
        field.par_chunks_mut(CHUNK).for_each(|field| match self {
            Self::Gaussian => field.iter_mut().for_each(|z| *z *= scale),
            Self::Johnson(johnson) => johnson.apply(field, scale),
            Self::Weibull(weibull) => weibull.apply(field, scale),
        });
    }

    /// Skewness of the heights in the ensemble.
    pub const fn skewness(&self) -> f64 {
        match self {
            Self::Gaussian => 0.0,
            Self::Johnson(johnson) => johnson.skewness(),
            Self::Weibull(weibull) => weibull.skewness(),
        }
    }

    /// Kurtosis of the heights in the ensemble (3 if Gaussian).
    pub const fn kurtosis(&self) -> f64 {
        match self {
            Self::Gaussian => 3.0,
            Self::Johnson(johnson) => johnson.kurtosis(),
            Self::Weibull(weibull) => weibull.kurtosis(),
        }
    }
}

impl fmt::Display for Marginal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gaussian => f.write_str("Gaussian"),
            Self::Johnson(johnson) => johnson.fmt(f),
            Self::Weibull(weibull) => weibull.fmt(f),
        }
    }
}

/// Mean, standard deviation, skewness and kurtosis of a distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Skewness.
    pub skewness: f64,
    /// Kurtosis (3 if normal).
    pub kurtosis: f64,
}

impl Shape {
    /// Of `map(g)`, g standard normal, by the trapezoidal rule of this step.
    fn of(step: f64, map: impl Fn(f64) -> f64) -> Self {
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

/// Where the trapezoidal rule ends: exp(4 u) times the normal density has no f64 left there for the
/// largest kurtosis, u = 1.22 g.
const END: f64 = 14.0;

/// Abscissae g and weights of a mean over a standard normal variable: the trapezoidal rule, which
/// converges exponentially for a smooth integrand on the whole line.
fn normal_nodes(step: f64) -> impl Iterator<Item = [f64; 2]> {
    let last = (END / step).ceil() as i64;
    let scale = step / (2.0 * PI).sqrt();
    (-last..=last).map(move |k| {
        let g = k as f64 * step;
        [g, scale * (-0.5 * g * g).exp()]
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Mean, standard deviation, skewness and kurtosis of `map(g)`, by a plain sum.
    pub(crate) fn moments(map: impl Fn(f64) -> f64) -> [f64; 4] {
        let mean_of = |term: &dyn Fn(f64) -> f64| {
            let at = |k: i32| f64::from(k) * 1.4e-3;
            let weigh = |g: f64| (-0.5 * g * g).exp() / (2.0 * PI).sqrt() * 1.4e-3;
            (-10_000..=10_000).map(|k| term(map(at(k))) * weigh(at(k))).sum::<f64>()
        };
        let mean = mean_of(&|z| z);
        let sd = mean_of(&|z| (z - mean).powi(2)).sqrt();
        [mean, sd, mean_of(&|z| ((z - mean) / sd).powi(3)), mean_of(&|z| ((z - mean) / sd).powi(4))]
    }

    /// One of each kind and curve.
    pub(crate) fn kinds() -> Vec<Marginal> {
        let johnson =
            [(0.0, 3.0), (1e-5, 3.0), (1.0, 4.0), (-1.0, 4.5), (-2.0, 20.0), (0.0, 1.3), (0.0, 200.0)];
        let lognormal = Johnson::from_moments(2.0, 10.863_462_451_016_1).unwrap();
        std::iter::once(Marginal::Gaussian)
            .chain(johnson.map(|(s, k)| Marginal::Johnson(Johnson::from_moments(s, k).unwrap())))
            .chain([Marginal::Johnson(lognormal)])
            .chain([0.5, 1.0, 3.6, 20.0].map(|shape| Marginal::Weibull(Weibull::new(shape).unwrap())))
            .collect()
    }

    #[test]
    fn maps_rise_at_the_rate_of_their_slope() {
        for marginal in kinds() {
            for k in -90..=90 {
                let g = 0.1 * f64::from(k) + 0.05;
                let slope = marginal.derivative(g);
                assert!(slope > 0.0 && slope.is_finite());
                let rise = |step: f64| (marginal.map(g + step) - marginal.map(g - step)) / (2.0 * step);
                assert!(rise(0.05) >= 0.0, "{marginal}, g = {g}");
                // Five points; what rounds away against the height cannot be seen.
                let found = (4.0 * rise(5e-4) - rise(1e-3)) / 3.0;
                let blind = 1e-8 * slope + 1e-11 * marginal.map(g).abs().max(1.0);
                assert!((found - slope).abs() < blind, "{marginal}, g = {g}: {found} {slope}");
            }
            let steps = (-60..=60).map(|k| marginal.map(0.1 * f64::from(k)));
            assert!(steps.clone().zip(steps.skip(1)).all(|(low, high)| low <= high), "{marginal}");
        }
    }

    #[test]
    fn a_field_is_mapped_point_by_point() {
        let field: Vec<f64> = (0..40_001).map(|k| f64::from(k - 20_000) * 4.5e-4).collect();
        for marginal in kinds() {
            let mut mapped = field.clone();
            marginal.apply(&mut mapped, 1e-7);
            for (&g, &z) in field.iter().zip(&mapped) {
                assert_eq!(z, 1e-7 * marginal.map(g), "{marginal}, g = {g}");
            }
        }
    }

    #[test]
    fn names_in_words() {
        let names: Vec<String> = kinds().iter().map(ToString::to_string).collect();
        assert_eq!(names[0], "Gaussian");
        assert_eq!(names[1], "Johnson SN, skewness 0, kurtosis 3");
        assert!(names[4].starts_with("Johnson SB, skewness -1, kurtosis 4.5 (gamma = -"), "{}", names[4]);
        assert!(names[5].starts_with("Johnson SU, skewness -2, kurtosis 20 (gamma = "), "{}", names[5]);
        assert!(names[8].starts_with("Johnson SL, skewness 2, kurtosis 10.86"), "{}", names[8]);
        assert_eq!(names[10], "Weibull, shape 1, skewness 2.0000, kurtosis 9.0000");
    }
}
