//! The reference plane of separations.

use crate::asperity::{Asperities, Population, Statistics, mean_and_sigma};

/// The plane from which separations are measured, and the unit in which they are reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferencePlane {
    /// The height of separation 0, m: the mean asperity height.
    pub mean: f64,
    /// Standard deviation of the asperity heights, m.
    pub sigma: f64,
}

impl From<&Statistics> for ReferencePlane {
    fn from(statistics: &Statistics) -> Self {
        Self { mean: statistics.mean_height, sigma: statistics.sigma }
    }
}

/// The same as of the [`Statistics`] of the asperities, without the rest of these.
impl From<Asperities<'_>> for ReferencePlane {
    fn from(asperities: Asperities<'_>) -> Self {
        let (mean, sigma) = mean_and_sigma(asperities.heights());
        Self { mean, sigma }
    }
}

/// The nominal mean height and sigma of a population.
impl From<&Population> for ReferencePlane {
    fn from(population: &Population) -> Self {
        Self { mean: 0.0, sigma: population.sigma }
    }
}
