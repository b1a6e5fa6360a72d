//! Both models at every point of the grid: everything that the report contains.

use asperity::Exceeded;
use asperity::compare::{
    Attribution, ComparedQuantity, Contributions, Estimate, ModelKind, NearerStretch, Verdict,
};
use asperity_contact_framework::contact::ContactMetadata;
use asperity_contact_framework::metadata::Metadata;

use super::plan::Axis;

/// The quantities whose differences are shown.
pub const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

#[derive(Debug)]
pub struct CausesResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The laws, as tables name them.
    pub laws: Vec<String>,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// What they are multiples of: E* times the gradient, Pa; `None` of given pressures.
    pub unit: Option<f64>,
    /// Surfaces of each point.
    pub realisations: usize,
    /// What all surfaces have in common, in words.
    pub common: String,
    /// What the rows of the grid differ in.
    pub axis: Axis,
    pub has_reference: bool,
    /// Row by row of the second axis, by skewness.
    pub points: Vec<GridPoint>,
}

impl CausesResults {
    /// Every law at every load: their indices.
    pub fn conditions(&self) -> impl Iterator<Item = [usize; 2]> {
        let loads = self.loads.len();
        (0..self.laws.len()).flat_map(move |law| (0..loads).map(move |load| [law, load]))
    }
}

/// The surfaces of one point of the grid.
#[derive(Debug)]
pub struct GridPoint {
    pub skewness: f64,
    pub kurtosis: f64,
    /// Longest over shortest wavelength; `None` where it follows from the summits.
    pub wavelengths: Option<f64>,
    /// The surfaces, or why there are none.
    pub surfaces: Result<GridSurfaces, String>,
}

/// Both models on the surfaces of a point.
#[derive(Debug)]
pub struct GridSurfaces {
    pub reached: Reached,
    /// Law by law, load by load.
    pub at: Vec<Vec<AtLoad>>,
}

/// What a surface is found to be, or the mean of several.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reached {
    /// m.
    pub pixel: f64,
    pub asperities: f64,
    pub skewness: f64,
    pub kurtosis: f64,
    /// Nayak's bandwidth parameter.
    pub alpha: f64,
    /// Root mean square.
    pub gradient: f64,
    pub asperity_skewness: f64,
    /// Standard deviation of the radii over their mean.
    pub radius_cv: f64,
    pub height_radius_correlation: f64,
    /// Greenwood and Williamson's; 0 where nothing yields.
    pub plasticity_index: f64,
}

#[derive(Debug)]
pub struct AtLoad {
    /// The limits of admissible loads that are exceeded on some of the surfaces.
    pub exceeded: Exceeded,
    /// The mean over the surfaces, with the interval of their scatter; `None` where the load is not admissible on one.
    pub attribution: Option<Attribution>,
    /// In the order of [`QUANTITIES`].
    pub quantities: [QuantityAtLoad; 2],
}

/// How far the models are apart in one quantity, and from the reference, means over the surfaces.
#[derive(Debug, Clone, Default)]
pub struct QuantityAtLoad {
    /// The difference between the models; its verdict where the load is admissible on all surfaces.
    pub difference: Option<(Estimate, Option<Verdict>)>,
    /// Statistical and deterministic model less the reference, and the difference of their magnitudes.
    pub against: Option<[Estimate; 3]>,
    /// Where the reference was run: which model is nearer, as far as it can be told.
    pub nearer: Option<NearerStretch>,
}

impl QuantityAtLoad {
    /// Whether the models are known to agree within what is accepted.
    pub fn is_within(&self) -> bool {
        self.difference.is_some_and(|(_, verdict)| verdict == Some(Verdict::Within))
    }

    /// The nearer model, where it can be told.
    pub fn nearer_model(&self) -> Option<ModelKind> {
        self.nearer.as_ref()?.nearer
    }
}

impl GridPoint {
    /// Both models under a law at a load, by their indices; `None` without surfaces.
    pub fn at(&self, [law, load]: [usize; 2]) -> Option<&AtLoad> {
        Some(&self.surfaces.as_ref().ok()?.at[law][load])
    }

    /// The parts of the difference in a quantity.
    pub fn parts(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&Contributions> {
        self.at(condition)?.attribution.as_ref()?.contributions(quantity)
    }

    /// The parts of the difference in a quantity, unless it is known to be within what is accepted: such a difference needs no cause.
    pub fn unaccepted(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&Contributions> {
        let is_within = self.quantity(condition, quantity)?.is_within();
        self.parts(condition, quantity).filter(|_| !is_within)
    }

    /// How far the models are apart in a quantity.
    pub fn quantity(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&QuantityAtLoad> {
        let place = QUANTITIES.iter().position(|one| *one == quantity)?;
        Some(&self.at(condition)?.quantities[place])
    }
}
