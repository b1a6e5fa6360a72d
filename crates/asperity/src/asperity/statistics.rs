//! Statistics of a set of asperities.

use super::AsperitySet;
use crate::numeric::lanes::Real;
use crate::numeric::sum::{Term, sum_of, sum_over};

/// Mean values and central moments of a set, with divisor n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// Mean height, m, in the frame of the set's heights.
    pub mean_height: f64,
    /// Standard deviation of the heights, m.
    pub sigma: f64,
    /// Skewness of the heights; `None` if all are equal.
    pub skewness: Option<f64>,
    /// Kurtosis of the heights (3 if Gaussian); `None` if all are equal.
    pub kurtosis: Option<f64>,
    /// Arithmetic mean of the radii, m (Pasaribu and Schipper 2005, Table 1).
    pub mean_radius: f64,
    /// 1/(mean curvature), m.
    pub radius_of_mean_curvature: f64,
    /// Standard deviation of the radii over their mean.
    pub radius_cv: f64,
    /// Pearson correlation of heights and radii; `None` if all heights or all radii are equal.
    pub height_radius_correlation: Option<f64>,
}

impl Statistics {
    /// Statistics of `set`, the same to the bit on any number of threads.
    pub fn new(set: &AsperitySet) -> Self {
        let (heights, radii) = (set.heights(), set.radii());
        let count = set.count();
        let mean_of = |term: &(dyn Fn(usize) -> f64 + Sync)| sum_of(count, term) / count as f64;

        let (height, radius) = (Mean::new(heights), Mean::new(radii));
        let mean_radius = radius.value();
        let sigma = height.sigma(heights);
        let standardised = |power: i32| {
            (sigma > 0.0).then(|| mean_of(&|i| (height.deviation(heights[i]) / sigma).powi(power)))
        };
        let radius_sigma = mean_of(&|i| radius.deviation(radii[i]).powi(2)).sqrt();
        let covariance = mean_of(&|i| height.deviation(heights[i]) * radius.deviation(radii[i]));
        Self {
            mean_height: height.value(),
            sigma,
            skewness: standardised(3),
            kurtosis: standardised(4),
            mean_radius,
            radius_of_mean_curvature: mean_of(&|i| radii[i].recip()).recip(),
            radius_cv: radius_sigma / mean_radius,
            height_radius_correlation: (sigma > 0.0 && radius_sigma > 0.0)
                .then(|| covariance / (sigma * radius_sigma)),
        }
    }
}

/// Mean height and standard deviation of the heights (m), as in [`Statistics`], of at least one height.
pub(crate) fn mean_and_sigma(heights: &[f64]) -> (f64, f64) {
    let mean = Mean::new(heights);
    (mean.value(), mean.sigma(heights))
}

/// A mean in two parts, so that deviations from it keep their digits under a large offset: the first value, and the mean
/// relative to it.
struct Mean {
    origin: f64,
    relative: f64,
}

impl Mean {
    /// Exact for equal values.
    fn new(values: &[f64]) -> Self {
        let origin = values[0];
        let relative = sum_over(values, Relative(origin)) / values.len() as f64;
        Self { origin, relative }
    }

    fn value(&self) -> f64 {
        self.origin + self.relative
    }

    /// The standard deviation of the values whose mean this is.
    fn sigma(&self, values: &[f64]) -> f64 {
        (sum_over(values, SquaredDeviation(self)) / values.len() as f64).sqrt()
    }

    fn deviation(&self, value: f64) -> f64 {
        (value - self.origin) - self.relative
    }
}

/// A value relative to another.
#[derive(Clone, Copy)]
struct Relative(f64);

impl Term for Relative {
    #[inline(always)]
    fn of<N: Real>(self, values: N) -> N {
        values - self.0
    }
}

/// The square of [`Mean::deviation`].
#[derive(Clone, Copy)]
struct SquaredDeviation<'a>(&'a Mean);

impl Term for SquaredDeviation<'_> {
    #[inline(always)]
    fn of<N: Real>(self, values: N) -> N {
        let deviation = (values - self.0.origin) - self.0.relative;
        deviation * deviation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statistics(heights: &[f64], radii: &[f64]) -> Statistics {
        Statistics::new(&AsperitySet::new(heights.to_vec(), radii.to_vec(), 1.0).unwrap())
    }

    #[test]
    fn of_four_asperities() {
        let s = statistics(&[1.0, 2.0, 3.0, 6.0], &[1.0, 1.0, 2.0, 4.0]);
        assert_eq!(s.mean_height, 3.0);
        assert!((s.sigma - 3.5f64.sqrt()).abs() < 1e-15);
        assert!((s.skewness.unwrap() - 4.5 / 3.5f64.powf(1.5)).abs() < 1e-15);
        assert!((s.kurtosis.unwrap() - 24.5 / 12.25).abs() < 1e-15);
        assert_eq!(s.mean_radius, 2.0);
        assert_eq!(s.radius_of_mean_curvature, 4.0 / 2.75);
        assert!((s.radius_cv - 1.5f64.sqrt() / 2.0).abs() < 1e-15);
        assert!((s.height_radius_correlation.unwrap() - 2.25 / (3.5f64 * 1.5).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn equal_heights_have_no_shape() {
        let s = statistics(&[0.1; 7], &[0.3; 7]);
        assert_eq!((s.mean_height, s.sigma, s.mean_radius), (0.1, 0.0, 0.3));
        assert_eq!((s.skewness, s.kurtosis, s.height_radius_correlation), (None, None, None));
    }

    /// 10 nm at a height of 1 m, against the same stored heights near zero.
    #[test]
    fn an_offset_costs_no_digits() {
        let near: Vec<f64> = (0..1000).map(|i| f64::EPSILON * f64::from((i * i * 7) % 1009 * 4096)).collect();
        let far: Vec<f64> = near.iter().map(|z| 1.0 + z).collect();
        let radii: Vec<f64> = (0..1000).map(|i| 1e-5 * f64::from(1 + i % 7)).collect();
        let set = |heights: &[f64]| AsperitySet::new(heights.to_vec(), radii.clone(), 1.0).unwrap();
        let wanted = Statistics::new(&set(&near));
        let (relative, origin) = set(&far).near_zero();
        assert_eq!(origin, 1.0);
        assert_eq!(relative, set(&near));
        assert_eq!(set(&near).near_zero(), (set(&near), 0.0));
        let found = Statistics::new(&set(&far));
        let close = |found: f64, wanted: f64| assert!((found - wanted).abs() <= 2e-15 * wanted.abs());
        close(found.sigma, wanted.sigma);
        close(found.kurtosis.unwrap(), wanted.kurtosis.unwrap());
        assert!((found.skewness.unwrap() - wanted.skewness.unwrap()).abs() < 2e-15);
        assert!(
            (found.height_radius_correlation.unwrap() - wanted.height_radius_correlation.unwrap()).abs()
                < 2e-15
        );
    }
}
