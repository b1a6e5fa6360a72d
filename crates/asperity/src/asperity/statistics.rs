//! Statistics of a set of asperities.

use super::AsperitySet;
use crate::numeric::lanes::Real;
use crate::numeric::sum::{Terms, sums_over};

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
    /// Statistics of `set`, the same to the bit on any number of threads; NaN or `None` of no asperities.
    pub fn new(set: &AsperitySet) -> Self {
        let columns = [set.heights(), set.radii()];
        let count = set.count() as f64;
        let origins = columns.map(|column| column.first().copied().unwrap_or(f64::NAN));
        let [height, radius, curvature] = sums_over(columns, Relative(origins)).map(|sum| sum / count);
        let means = Means { origins, relative: [height, radius] };
        let [sigma, radius_sigma] = sums_over(columns, Squares(means)).map(|sum| (sum / count).sqrt());
        let [mean_height, mean_radius] = means.values();
        let units = [sigma, radius_sigma].map(|sd| if sd > 0.0 { sd } else { 1.0 });
        let [third, fourth, product] =
            sums_over(columns, Standardised { means, per: units.map(f64::recip) }).map(|sum| sum / count);
        let has_shape = sigma > 0.0;
        Self {
            mean_height,
            sigma,
            skewness: has_shape.then_some(third),
            kurtosis: has_shape.then_some(fourth),
            mean_radius,
            radius_of_mean_curvature: curvature.recip(),
            radius_cv: radius_sigma / mean_radius,
            height_radius_correlation: (has_shape && radius_sigma > 0.0).then_some(product),
        }
    }

    /// Statistics of `rest`, which a set of these statistics is without `part`: from the sums over the part, where it leaves digits.
    pub(crate) fn without(&self, part: &AsperitySet, rest: &AsperitySet) -> Self {
        /// The least share of the rest, and the least of its variances over those of all.
        const LEAST: f64 = 0.1;
        let [all, count] = [rest.count() + part.count(), rest.count()].map(|n| n as f64);
        let has_equal_radii = self.radius_cv == 0.0;
        let correlation = self.height_radius_correlation.or(has_equal_radii.then_some(0.0));
        let known = (self.skewness, self.kurtosis, correlation);
        let (Some(skewness), Some(kurtosis), Some(correlation)) = known else { return Self::new(rest) };
        if count < LEAST * all {
            return Self::new(rest);
        }
        // Standardised by the mean values and deviations of all.
        let units = [self.sigma, if has_equal_radii { 1.0 } else { self.radius_cv } * self.mean_radius];
        let means = Means { origins: [self.mean_height, self.mean_radius], relative: [0.0; 2] };
        let powers = Powers(Standardised { means, per: units.map(f64::recip) });
        let of_all =
            [0.0, 1.0, skewness, kurtosis, 0.0, 1.0, correlation, self.radius_of_mean_curvature.recip()];
        let sums = sums_over([part.heights(), part.radii()], powers);
        let mean_of = |k: usize| (all * of_all[k] - sums[k]) / count;
        let [u, u2, u3, u4, r, r2, ur, curvature] = std::array::from_fn(mean_of);
        let (variance, radius_variance) = (u2 - u * u, r2 - r * r);
        if variance < LEAST || (radius_variance < LEAST && !has_equal_radii) {
            return Self::new(rest);
        }
        let correlation = (ur - u * r) / (variance * radius_variance).sqrt();
        let third = u3 - 3.0 * u * u2 + 2.0 * u.powi(3);
        let fourth = u4 - 4.0 * u * u3 + 6.0 * u * u * u2 - 3.0 * u.powi(4);
        let mean_radius = self.mean_radius + units[1] * r;
        Self {
            mean_height: self.mean_height + units[0] * u,
            sigma: units[0] * variance.sqrt(),
            skewness: Some(third / variance.powf(1.5)),
            kurtosis: Some(fourth / variance.powi(2)),
            mean_radius,
            radius_of_mean_curvature: curvature.recip(),
            radius_cv: if has_equal_radii { 0.0 } else { units[1] * radius_variance.sqrt() / mean_radius },
            height_radius_correlation: Some(correlation).filter(|_| !has_equal_radii),
        }
    }
}

/// Mean height and standard deviation of the heights (m), as in [`Statistics`], of at least one height.
pub(crate) fn mean_and_sigma(heights: &[f64]) -> (f64, f64) {
    let (origins, count) = ([heights[0]], heights.len() as f64);
    let means = Means { origins, relative: sums_over([heights], Relative(origins)).map(|sum| sum / count) };
    let [variance] = sums_over([heights], Squares(means)).map(|sum| sum / count);
    let [mean] = means.values();
    (mean, variance.sqrt())
}

/// Mean values of columns in two parts, so that deviations from them keep their digits under a large offset: the first values, and the
/// means relative to them. Exact for equal values.
#[derive(Clone, Copy)]
struct Means<const C: usize> {
    origins: [f64; C],
    relative: [f64; C],
}

impl<const C: usize> Means<C> {
    fn values(&self) -> [f64; C] {
        std::array::from_fn(|column| self.origins[column] + self.relative[column])
    }

    #[inline(always)]
    fn deviations<N: Real>(&self, values: [N; C]) -> [N; C] {
        std::array::from_fn(|column| (values[column] - self.origins[column]) - self.relative[column])
    }
}

/// Values relative to others, of heights and radii the curvature, too.
#[derive(Clone, Copy)]
struct Relative<const C: usize>([f64; C]);

impl Terms<1, 1> for Relative<1> {
    #[inline(always)]
    fn of<N: Real>(self, [height]: [N; 1]) -> [N; 1] {
        [height - self.0[0]]
    }
}

impl Terms<2, 3> for Relative<2> {
    #[inline(always)]
    fn of<N: Real>(self, [height, radius]: [N; 2]) -> [N; 3] {
        [height - self.0[0], radius - self.0[1], radius.splat(1.0) / radius]
    }
}

/// Squares of deviations.
#[derive(Clone, Copy)]
struct Squares<const C: usize>(Means<C>);

impl<const C: usize> Terms<C, C> for Squares<C> {
    #[inline(always)]
    fn of<N: Real>(self, values: [N; C]) -> [N; C] {
        let deviations = self.0.deviations(values);
        std::array::from_fn(|column| deviations[column] * deviations[column])
    }
}

/// Of deviations over standard deviations the third and fourth power of heights, and the product with radii.
#[derive(Clone, Copy)]
struct Standardised {
    means: Means<2>,
    /// One over the standard deviations.
    per: [f64; 2],
}

impl Standardised {
    #[inline(always)]
    fn values<N: Real>(self, values: [N; 2]) -> [N; 2] {
        let [height, radius] = self.means.deviations(values);
        [height * self.per[0], radius * self.per[1]]
    }
}

impl Terms<2, 3> for Standardised {
    #[inline(always)]
    fn of<N: Real>(self, values: [N; 2]) -> [N; 3] {
        let [height, radius] = self.values(values);
        let square = height * height;
        [square * height, square * square, height * radius]
    }
}

/// Of deviations over standard deviations the powers of heights up to the fourth, those of radii up to the second, and their product;
/// and the curvature.
#[derive(Clone, Copy)]
struct Powers(Standardised);

impl Terms<2, 8> for Powers {
    #[inline(always)]
    fn of<N: Real>(self, values: [N; 2]) -> [N; 8] {
        let [u, r] = self.0.values(values);
        let square = u * u;
        let curvature = values[1].splat(1.0) / values[1];
        [u, square, square * u, square * square, r, r * r, u * r, curvature]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asperity::Places;

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

    #[test]
    fn without_a_part_they_are_those_of_the_rest() {
        let value = |k: usize, m: usize| ((k * m) % 10_007) as f64 / 1e4;
        let heights: Vec<f64> =
            (0..5000).map(|k| 1e-7 * (3.0 + value(k, 7919) - value(k, 13).powi(3))).collect();
        let unequal = (0..5000).map(|k| 1e-5 * (1.0 + value(k, 31) + 0.3 * value(k, 7919))).collect();
        let sets =
            [unequal, vec![1.7e-5; 5000]].map(|radii| AsperitySet::new(heights.clone(), radii, 1.0).unwrap());
        let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let cases: [&dyn Fn(usize) -> bool; 4] =
            [&|k| k % 16 == 3, &|k| heights[k] > 3.5e-7, &|k| k > 20, &|k| heights[k] > lowest + 1e-9];
        for (case, (all, is_in_part)) in sets.iter().flat_map(|all| cases.map(|case| (all, case))).enumerate()
        {
            let indices: Vec<usize> = (0..5000).filter(|&k| is_in_part(k)).collect();
            let part = all.selected(&indices, 1.0).unwrap();
            let left_out = Places { part: 0..indices.len(), list: indices.into() };
            let rest = all.excluding(left_out, 1.0).unwrap();
            let numbers = |s: Statistics| {
                let Statistics {
                    mean_height, sigma, mean_radius, radius_of_mean_curvature, radius_cv, ..
                } = s;
                let of_heights = [mean_height, sigma, s.skewness.unwrap(), s.kurtosis.unwrap()];
                let of_radii = [
                    mean_radius,
                    radius_of_mean_curvature,
                    radius_cv,
                    s.height_radius_correlation.unwrap_or(0.0),
                ];
                [of_heights, of_radii].concat()
            };
            let found = Statistics::new(all).without(&part, &rest);
            assert_eq!(
                (found.radius_cv == 0.0, found.height_radius_correlation.is_none()),
                (case > 3, case > 3)
            );
            for (found, wanted) in numbers(found).into_iter().zip(numbers(Statistics::new(&rest))) {
                assert!((found - wanted).abs() <= 1e-13 * wanted.abs(), "{case}: {found} {wanted}");
            }
        }
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
