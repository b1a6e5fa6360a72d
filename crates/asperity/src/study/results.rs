//! Results of both models: of a realisation of a surface, and of a case on it.

use super::statistical::StatisticalModel;
use crate::compare::{
    AgainstReference, Attribution, Comparison, Difference, Gaps, NotModelled, Pair, Pairing, ReferenceCurve,
    ReferencePoint,
};
use crate::topography::RoughnessParameters;
use crate::{Population, Statistics};

/// One realisation of a surface.
#[derive(Debug)]
pub struct RealisationFacts {
    /// Number of asperities.
    pub asperities: usize,
    /// Nominal area, m^2.
    pub nominal_area: f64,
    /// Statistics of the asperities.
    pub statistics: Statistics,
    /// What d is measured in, m.
    pub sigma: f64,
    /// Of the map that they were found on.
    pub roughness: Option<RoughnessParameters>,
    /// Input of the statistical model.
    pub population: Population,
    /// The statistical model.
    pub model: StatisticalModel,
}

/// Results on one realisation of a surface.
#[derive(Debug)]
pub struct RealisationResults {
    /// Its asperities and the model of them.
    pub facts: RealisationFacts,
    /// Law by law, thickness by thickness.
    pub cases: Vec<CaseResults>,
}

/// One case on one realisation.
#[derive(Debug)]
pub struct CaseResults {
    /// The law, as tables name it.
    pub law: String,
    /// Whether contacts yield under it.
    pub yields: bool,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Results of both models.
    pub comparison: Comparison,
    /// The largest gaps between them.
    pub gaps: Gaps,
    /// The differences at equal load, in the order of the pairs, with their sampling uncertainty.
    pub differences: Vec<Difference>,
    /// Why there is no model-based interval on a small map; `None` where there is one, and on other surfaces.
    pub not_modelled: Option<NotModelled>,
    /// The differences divided among their causes, in the order of the pairs at equal load; empty where none is asked for.
    pub attribution: Vec<Attribution>,
    /// The reference; `None` where none is asked for.
    pub reference: Option<ReferenceCurve>,
    /// How far both models are from it, in the order of the pairs.
    pub against_reference: AgainstReference,
}

impl CaseResults {
    /// The gap of a pair at equal load divided among its causes; `None` for other pairs, and where it is not divided.
    pub fn attribution_of(&self, pair: &Pair) -> Option<&Attribution> {
        self.attribution.iter().filter(|_| pair.pairing == Pairing::Load).find(|at| at.load == pair.target)
    }

    /// The reference at the load of a pair of both models; `None` where it did not run.
    pub fn reference_of(&self, pair: &Pair) -> Option<&ReferencePoint> {
        self.reference.as_ref().filter(|_| pair.pairing == Pairing::Load)?.at_load(pair.target)
    }
}
