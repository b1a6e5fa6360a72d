//! What a comparison found: everything that its report may say.

use asperity::asperity::{Population, Statistics};
use asperity::compare::{Comparison, Gaps, Kind, Tolerances};
use asperity::sphere::Fall;
use asperity::topography::Moments;
use asperity_framework::contact::ContactMetadata;
use asperity_framework::metadata::Metadata;

use crate::layer::rule_warning;
use crate::surface::{Surface, warnings};

/// Both models on given surfaces.
#[derive(Debug)]
pub struct CompareResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// How far the curves over d/sigma may be off.
    pub tolerances: Tolerances,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
}

impl CompareResults {
    /// What makes the answers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = warnings(self.surfaces.iter().map(|found| &found.surface));
        lines.extend(self.contact.caveats.iter().cloned());
        lines.extend(
            self.contact
                .layer
                .as_ref()
                .and_then(|layer| rule_warning(layer.check.as_ref()?, &layer.name, layer.rule)),
        );
        lines
    }
}

/// One surface, all its realisations, and what they answered.
#[derive(Debug)]
pub struct SurfaceResults {
    /// The first realisation, with its asperities.
    pub surface: Surface,
    /// What the first answered.
    pub first: RealisationResults,
    /// The others: their asperities are not kept.
    pub others: Vec<RealisationResults>,
    /// Up to which thickness the first takes no notice of the layer, law by law, load by load, model by model.
    pub thresholds: Vec<Threshold>,
    /// Where the sharpest, a mean and the bluntest asperity of the first carry less, or touch on less, as they are
    /// pressed deeper.
    pub falls: Vec<FallResults>,
}

impl SurfaceResults {
    /// Every realisation with its number, from 1.
    pub fn realisations(&self) -> impl Iterator<Item = (usize, &RealisationResults)> {
        (1..).zip(std::iter::once(&self.first).chain(&self.others))
    }
}

/// A stretch on which area or load of an asperity falls.
#[derive(Debug, Clone)]
pub struct FallResults {
    /// The law.
    pub law: String,
    /// Thickness of the layer, m; `None` where no layer is asked for.
    pub thickness: Option<f64>,
    /// Of the asperity, m.
    pub radius: f64,
    /// The stretch.
    pub fall: Fall,
}

/// Up to which thickness the real area stays within 5 % of the one without a layer.
#[derive(Debug, Clone)]
pub struct Threshold {
    /// The law.
    pub law: String,
    /// The model.
    pub kind: Kind,
    /// The nominal pressure, Pa.
    pub pressure: f64,
    /// The thickness, m: infinite where no layer matters, `None` where the thinnest layer that was looked at does.
    pub thickness: Option<f64>,
}

/// One realisation of a surface and what it answered.
#[derive(Debug)]
pub struct RealisationResults {
    /// Number of asperities.
    pub asperities: usize,
    /// Nominal area, m^2.
    pub nominal_area: f64,
    /// Statistics of the asperities.
    pub statistics: Statistics,
    /// What d is measured in, m.
    pub sigma: f64,
    /// Of the map that they were found on.
    pub moments: Option<Moments>,
    /// The population that the statistical model stands on.
    pub population: Population,
    /// Law by law.
    pub cases: Vec<CaseResults>,
}

/// One surface under one law.
#[derive(Debug)]
pub struct CaseResults {
    /// The law, as tables name it.
    pub law: String,
    /// Thickness of the layer, m; `None` where no layer is asked for.
    pub thickness: Option<f64>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Both models' answers.
    pub comparison: Comparison,
    /// The largest gaps between them.
    pub gaps: Gaps,
}
