//! Why the models differ at every point of the grid: everything that the report contains.

use asperity::Exceeded;
use asperity::compare::{Attribution, ComparedQuantity, Contributions};
use asperity_contact_framework::contact::ContactMetadata;
use asperity_contact_framework::metadata::Metadata;

/// The quantities whose differences are shown.
pub const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

/// Surfaces of several skewnesses and bandwidths.
#[derive(Debug)]
pub struct CausesResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// The law, as tables name it.
    pub law: String,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// What they are multiples of: E* times the gradient, Pa.
    pub unit: f64,
    /// Surfaces of each point.
    pub realisations: usize,
    /// Standard deviation of the surface heights, m.
    pub sigma: f64,
    /// Root mean square gradient asked for.
    pub gradient: f64,
    /// Hurst exponent.
    pub hurst: f64,
    /// Row by row of equal wavelengths, by skewness.
    pub points: Vec<GridPoint>,
}

/// The surfaces of one skewness and bandwidth.
#[derive(Debug)]
pub struct GridPoint {
    /// Skewness asked for.
    pub skewness: f64,
    /// Kurtosis asked for.
    pub kurtosis: f64,
    /// Longest over shortest wavelength.
    pub wavelengths: f64,
    /// m.
    pub pixel: f64,
    /// Points along a side.
    pub points: usize,
    /// Means over the surfaces.
    pub reached: Reached,
    /// Load by load.
    pub at: Vec<AtLoad>,
}

/// What a surface is found to be, or the mean of several.
#[derive(Debug, Clone, Copy)]
pub struct Reached {
    /// Number of asperities.
    pub asperities: f64,
    /// Of the surface heights.
    pub skewness: f64,
    /// Of the surface heights.
    pub kurtosis: f64,
    /// Nayak's bandwidth parameter.
    pub alpha: f64,
    /// Root mean square.
    pub gradient: f64,
    /// Skewness of the asperity heights.
    pub asperity_skewness: f64,
    /// Standard deviation of the radii over their mean.
    pub radius_cv: f64,
    /// Correlation of heights and radii.
    pub height_radius_correlation: f64,
    /// Greenwood and Williamson's; 0 where nothing yields.
    pub plasticity_index: f64,
}

/// One load.
#[derive(Debug)]
pub struct AtLoad {
    /// Nominal pressure, Pa.
    pub load: f64,
    /// The limits of the valid range that are exceeded on some of the surfaces.
    pub exceeded: Exceeded,
    /// The mean over the surfaces, with the interval of their scatter; `None` where the load is beyond the valid range of one.
    pub attribution: Option<Attribution>,
}

impl GridPoint {
    /// The parts of the difference in a quantity at the load of index `load`.
    pub fn parts(&self, load: usize, quantity: ComparedQuantity) -> Option<&Contributions> {
        self.at[load].attribution.as_ref()?.contributions(quantity)
    }
}
