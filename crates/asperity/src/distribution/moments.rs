//! Means over a standard normal variable.

use std::f64::consts::PI;

use crate::numeric::Sum;

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
const END: f64 = 14.0;

/// Abscissae g and weights of a mean over a standard normal variable: the trapezoidal rule, which
/// converges exponentially for a smooth integrand on the whole line.
pub(crate) fn normal_nodes(step: f64) -> impl Iterator<Item = [f64; 2]> {
    let last = (END / step).ceil() as i64;
    let scale = step / (2.0 * PI).sqrt();
    (-last..=last).map(move |k| {
        let g = k as f64 * step;
        [g, scale * (-0.5 * g * g).exp()]
    })
}
