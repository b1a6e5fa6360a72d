//! What both models answered on the realisations of a surface.

use asperity::compare::{Comparison, Gaps, Kind};
use asperity::sphere::Decrease;
use asperity::topography::Moments;
use asperity::{Population, Statistics};

/// A stretch on which area or load of an asperity falls.
#[derive(Debug, Clone)]
pub struct DecreaseResults {
    /// The law.
    pub law: String,
    /// Thickness of the layer, m; `None` where no layer is asked for.
    pub thickness: Option<f64>,
    /// Of the asperity, m.
    pub radius: f64,
    /// The stretch.
    pub decrease: Decrease,
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
