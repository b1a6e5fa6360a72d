//! Sums over parts of a set that is larger than memory, from which its statistics follow.

use super::{AsperitySet, Statistics};
use crate::numeric::Sum;

/// Sums over a part of the asperities of a set. Parts are added with [`AsperitySums::merge`], in an order that the caller
/// fixes; with the feature `serde` they pass between machines.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AsperitySums {
    origin: [f64; 2],
    count: usize,
    nominal_area: Sum,
    terms: [Sum; TERMS],
}

/// The powers 1 to 4 of the height, 1 and 2 of the radius, their product, and the curvature.
const TERMS: usize = 8;

/// Terms added without compensation: at most 15 rounding errors.
const PLAIN: usize = 16;

impl AsperitySums {
    /// Sums over nothing. Heights and radii are taken relative to a height and a radius (m), the same for all parts: their mean
    /// values to within a few standard deviations, so that the statistics keep their digits.
    pub fn about(height: f64, radius: f64) -> Self {
        let none = Sum::default();
        Self { origin: [height, radius], count: 0, nominal_area: none, terms: [none; TERMS] }
    }

    /// Adds a nominal area (m^2) without asperities.
    pub fn add_area(&mut self, nominal_area: f64) {
        self.nominal_area += nominal_area;
    }

    /// Adds the asperities of `set` and their nominal area.
    pub fn add(&mut self, set: &AsperitySet) {
        self.add_area(set.nominal_area());
        self.count += set.count();
        for (heights, radii) in set.heights().chunks(PLAIN).zip(set.radii().chunks(PLAIN)) {
            let mut terms = [0.0; TERMS];
            for (height, &radius) in heights.iter().zip(radii) {
                let (z, r) = (height - self.origin[0], radius - self.origin[1]);
                let squared = z * z;
                let of_one = [z, squared, squared * z, squared * squared, r, r * r, z * r, radius.recip()];
                terms.iter_mut().zip(of_one).for_each(|(sum, term)| *sum += term);
            }
            self.terms.iter_mut().zip(terms).for_each(|(sum, terms)| *sum += terms);
        }
    }

    /// Adds the sums over another part.
    pub fn merge(&mut self, part: &Self) {
        self.count += part.count;
        self.nominal_area += part.nominal_area;
        self.terms.iter_mut().zip(part.terms).for_each(|(sum, part)| *sum += part);
    }

    /// Number of asperities.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Nominal area, m^2.
    pub fn nominal_area(&self) -> f64 {
        self.nominal_area.value()
    }

    /// The statistics of all that was added; `None` of nothing.
    pub fn statistics(&self) -> Option<Statistics> {
        if self.count == 0 {
            return None;
        }
        let count = self.count as f64;
        let [z, z2, z3, z4, r, r2, product, curvature] = self.terms.map(|sum| sum.value() / count);
        let variance = (z2 - z * z).max(0.0);
        let sigma = variance.sqrt();
        let third = z3 - 3.0 * z * z2 + 2.0 * z.powi(3);
        let fourth = z4 - 4.0 * z * z3 + 6.0 * z * z * z2 - 3.0 * z.powi(4);
        let radius_sigma = (r2 - r * r).max(0.0).sqrt();
        let mean_radius = self.origin[1] + r;
        let has_height = sigma > 0.0;
        Some(Statistics {
            mean_height: self.origin[0] + z,
            sigma,
            skewness: has_height.then(|| third / (variance * sigma)),
            kurtosis: has_height.then(|| fourth / (variance * variance)),
            mean_radius,
            radius_of_mean_curvature: curvature.recip(),
            radius_cv: radius_sigma / mean_radius,
            height_radius_correlation: (has_height && radius_sigma > 0.0)
                .then(|| (product - z * r) / (sigma * radius_sigma)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set() -> AsperitySet {
        let heights = (0..10_007).map(|i| 0.25 + 1e-8 * f64::from((i * i * 7) % 1009)).collect();
        let radii = (0..10_007).map(|i| 1e-5 * f64::from(1 + (i * i) % 7)).collect();
        AsperitySet::new(heights, radii, 2.0).unwrap()
    }

    /// In parts, far from zero.
    #[test]
    fn statistics_of_parts_are_those_of_the_set() {
        let set = set();
        let mut sums = AsperitySums::about(set.heights()[0], set.radii()[0]);
        for k in 0..3 {
            let part = set.selected(&(k..set.count()).step_by(3).collect::<Vec<_>>(), 2.0 / 3.0).unwrap();
            let mut of_part = AsperitySums::about(set.heights()[0], set.radii()[0]);
            of_part.add(&part);
            sums.merge(&of_part);
        }
        assert_eq!((sums.count(), sums.nominal_area()), (10_007, 2.0));
        let (found, wanted) = (sums.statistics().unwrap(), Statistics::new(&set));
        let pairs = [
            (found.mean_height, wanted.mean_height),
            (found.sigma, wanted.sigma),
            (found.kurtosis.unwrap(), wanted.kurtosis.unwrap()),
            (found.mean_radius, wanted.mean_radius),
            (found.radius_of_mean_curvature, wanted.radius_of_mean_curvature),
            (found.radius_cv, wanted.radius_cv),
        ];
        for (found, wanted) in pairs {
            assert!((found / wanted - 1.0).abs() < 1e-13, "{found} for {wanted}");
        }
        assert!((found.skewness.unwrap() - wanted.skewness.unwrap()).abs() < 1e-13);
        let correlations = [found, wanted].map(|statistics| statistics.height_radius_correlation.unwrap());
        assert!((correlations[0] - correlations[1]).abs() < 1e-14);
    }

    #[test]
    fn equal_asperities_have_no_scatter_and_none_have_no_statistics() {
        let mut sums = AsperitySums::about(0.1, 0.3);
        assert_eq!(sums.statistics(), None);
        sums.add(&AsperitySet::new(vec![0.1; 70], vec![0.3; 70], 1.0).unwrap());
        let found = sums.statistics().unwrap();
        assert_eq!((found.mean_height, found.sigma, found.mean_radius), (0.1, 0.0, 0.3));
        assert_eq!((found.skewness, found.radius_cv, found.height_radius_correlation), (None, 0.0, None));
    }
}
