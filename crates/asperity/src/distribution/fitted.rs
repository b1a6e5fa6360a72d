//! Height distributions of the statistical model that follow from the heights of a set.

use std::fmt;

use super::{EqualHeights, Heights, HeightsError, Johnson, Smoothed, Weibull};

/// What the statistical model takes the heights of a set for.
#[derive(Debug, Clone, PartialEq)]
pub enum HeightModel {
    /// A distribution that does not depend on the set.
    Given(Heights),
    /// The Weibull distribution of the set's skewness.
    FittedWeibull,
    /// The Johnson distribution of the set's skewness and kurtosis.
    FittedJohnson,
    /// The set's own heights, smoothed by a Gaussian kernel.
    Own,
}

impl HeightModel {
    /// Those that follow from the set.
    pub const FITTED: [Self; 3] = [Self::FittedWeibull, Self::FittedJohnson, Self::Own];

    /// The name in specs and tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Given(heights) => heights.name(),
            Self::FittedWeibull => "fitted-weibull",
            Self::FittedJohnson => "fitted-johnson",
            Self::Own => "own",
        }
    }

    /// The distribution for a set of `heights` (m) of this skewness and kurtosis, which are `None` where all heights are equal.
    ///
    /// # Errors
    /// Moments that the family does not have; heights that are all equal.
    pub fn fit(&self, heights: &[f64], moments: Option<[f64; 2]>) -> Result<Heights, HeightsError> {
        self.fit_by(|| Smoothed::new(heights).map(Heights::new), moments)
    }

    /// The same with the smoothed heights, which are made where they are needed.
    pub(crate) fn fit_by(
        &self,
        smoothed: impl FnOnce() -> Result<Heights, EqualHeights>,
        moments: Option<[f64; 2]>,
    ) -> Result<Heights, HeightsError> {
        let equal = || HeightsError::from("heights that are all equal have no shape");
        match self {
            Self::Given(given) => Ok(given.clone()),
            Self::FittedWeibull => {
                let [skewness, _] = moments.ok_or_else(equal)?;
                Ok(Heights::new(Weibull::with_skewness(skewness)?))
            }
            Self::FittedJohnson => {
                let [skewness, kurtosis] = moments.ok_or_else(equal)?;
                Ok(Heights::new(Johnson::from_moments(skewness, kurtosis)?))
            }
            Self::Own => Ok(smoothed()?),
        }
    }
}

impl fmt::Display for HeightModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fitted_distributions_have_the_moments_of_the_set() {
        let heights: Vec<f64> = (0..2000).map(|k| (f64::from(k) / 300.0).exp()).collect();
        let of = |model: &HeightModel, moments| model.fit(&heights, moments);
        let johnson = of(&HeightModel::FittedJohnson, Some([-1.0, 4.5])).unwrap();
        assert!((johnson.skewness() + 1.0).abs() < 1e-9 && (johnson.kurtosis() - 4.5).abs() < 1e-9);
        let weibull = of(&HeightModel::FittedWeibull, Some([0.631, 3.0])).unwrap();
        assert!((weibull.skewness() - 0.631).abs() < 1e-9);
        assert_eq!(of(&HeightModel::Given(Heights::EXPONENTIAL), None).unwrap(), Heights::EXPONENTIAL);
        assert!(of(&HeightModel::Own, None).unwrap().skewness() > 0.5);
        assert!(of(&HeightModel::FittedJohnson, None).is_err());
        let error = of(&HeightModel::FittedWeibull, Some([-2.0, 9.0])).unwrap_err().to_string();
        assert!(error.contains("Weibull heights have"), "{error}");
    }
}
