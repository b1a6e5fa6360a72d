//! The frame of separations.

use crate::asperity::{Population, Statistics};

/// Where separations are measured from, and in what unit they are reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferencePlane {
    /// The height that separation 0 means, m: the mean asperity height.
    pub mean: f64,
    /// Standard deviation of the asperity heights, m.
    pub sigma: f64,
}

impl From<&Statistics> for ReferencePlane {
    fn from(statistics: &Statistics) -> Self {
        Self { mean: statistics.mean_height, sigma: statistics.sigma }
    }
}

/// Separations from the nominal mean height, in the nominal sigma.
impl From<&Population> for ReferencePlane {
    fn from(population: &Population) -> Self {
        Self { mean: 0.0, sigma: population.sigma }
    }
}
