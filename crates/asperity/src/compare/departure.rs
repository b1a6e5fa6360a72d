//! Departures of a surface's asperities from the assumptions of the statistical model.

use crate::asperity::Statistics;

/// An assumption of the statistical model that a surface violates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Departure {
    /// Heights that are not Gaussian: skewness far from 0, or kurtosis far from 3.
    Heights {
        /// Skewness of the heights.
        skewness: f64,
        /// Kurtosis of the heights.
        kurtosis: f64,
    },
    /// Unequal radii: their standard deviation over their mean.
    Radii(f64),
    /// Correlated heights and radii: the correlation coefficient.
    Correlation(f64),
}

impl Departure {
    /// All departures of asperities with these statistics.
    pub fn of(statistics: &Statistics) -> Vec<Self> {
        /// Departures below these thresholds have little effect on loads and areas.
        const SKEWNESS: f64 = 0.1;
        const EXCESS_KURTOSIS: f64 = 0.2;
        const RADIUS_CV: f64 = 0.1;
        const CORRELATION: f64 = 0.1;
        let &Statistics { skewness, kurtosis, radius_cv, height_radius_correlation, .. } = statistics;
        let heights = skewness.zip(kurtosis).map(|(skewness, kurtosis)| Self::Heights { skewness, kurtosis });
        let [heights, radii, correlation] =
            [heights, Some(Self::Radii(radius_cv)), height_radius_correlation.map(Self::Correlation)];
        let is_notable = |departure: &Self| match *departure {
            Self::Heights { skewness, kurtosis } => {
                skewness.abs() > SKEWNESS || (kurtosis - 3.0).abs() > EXCESS_KURTOSIS
            }
            Self::Radii(cv) => cv > RADIUS_CV,
            Self::Correlation(correlation) => correlation.abs() > CORRELATION,
        };
        [heights, radii, correlation].into_iter().flatten().filter(is_notable).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_notable_departures_are_named() {
        let ideal = Statistics {
            mean_height: 0.0,
            sigma: 1e-8,
            skewness: Some(0.09),
            kurtosis: Some(2.9),
            mean_radius: 1e-5,
            radius_of_mean_curvature: 1e-5,
            radius_cv: 0.0,
            height_radius_correlation: None,
        };
        assert_eq!(Departure::of(&ideal), []);
        let real = Statistics {
            kurtosis: Some(3.5),
            radius_cv: 0.4,
            height_radius_correlation: Some(-0.3),
            ..ideal
        };
        let heights = Departure::Heights { skewness: 0.09, kurtosis: 3.5 };
        assert_eq!(Departure::of(&real), [heights, Departure::Radii(0.4), Departure::Correlation(-0.3)]);
    }
}
