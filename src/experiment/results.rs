//! What an experiment found: everything that a report may say.

use std::path::PathBuf;
use std::time::Duration;

use indexmap::IndexMap;

use super::indentation::IndentationResults;
use super::laws::LawsResults;
use super::precision::PrecisionResults;
use super::stability::StabilityResults;
use super::surface::Surface;
use asperity::asperity::{Population, Statistics};
use asperity::compare::{Comparison, Gaps, Kind, LimitPoint, RuleFindings, Tolerances};
use asperity::layer::Rule;
use asperity::literature::Paper;
use asperity::material::Material;
use asperity::sphere::Fall;
use asperity::topography::Moments;
use asperity::work::Work;

/// The two bodies, by name.
#[derive(Debug, Clone)]
pub struct Bodies {
    /// Material of the rough body.
    pub rough: String,
    /// Material of the flat.
    pub flat: String,
}

/// What every experiment has.
#[derive(Debug, Clone)]
pub struct Metadata {
    /// What the report is called.
    pub title: String,
    /// Name of the spec's file, without its ending.
    pub stem: String,
    /// What the spec's author says of it.
    pub notes: String,
    /// SHA-256 of the spec, hexadecimal.
    pub spec_sha256: String,
    /// Every random number came from it.
    pub seed: u64,
    /// The papers behind what was run.
    pub papers: Vec<Paper>,
    /// Where the time went.
    pub timing: Timing,
    /// What was done; `None` where that depends on the clock, or is the experiment itself.
    pub work: Option<Work>,
}

/// What lies on the flat.
#[derive(Debug, Clone)]
pub struct LayerMetadata {
    /// Name of its material.
    pub name: String,
    /// How its modulus and that of the substrate are put together.
    pub rule: Rule,
    /// Thicknesses, m, ascending; 0 and infinity among them.
    pub thicknesses: Vec<f64>,
    /// How good the rules are for these materials, over a/t from 0.1 to 10; `None` where no thickness asks for one.
    pub check: Option<RuleFindings>,
}

/// The two bodies of a contact.
#[derive(Debug, Clone)]
pub struct ContactMetadata {
    /// The bodies of the spec.
    pub materials: IndexMap<String, Material>,
    /// Who touches whom.
    pub bodies: Bodies,
    /// Reduced modulus of the pair, Pa.
    pub reduced_modulus: f64,
    /// Hardness of the softer body, Pa.
    pub hardness: Option<f64>,
    /// What lies on the flat.
    pub layer: Option<LayerMetadata>,
    /// Laws that are asked beyond what they were made for, a line each.
    pub caveats: Vec<String>,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    /// Reading files.
    pub read: Duration,
    /// Drawing asperities.
    pub generate: Duration,
    /// Levelling, filtering, finding summits.
    pub summits: Duration,
    /// The integrals.
    pub statistical: Duration,
    /// The sums, ordering included.
    pub deterministic: Duration,
    /// From the spec to the results.
    pub total: Duration,
}

/// The results of one experiment.
#[derive(Debug)]
pub enum Results {
    /// Of `[compare]`.
    Compare(CompareResults),
    /// Of `[indentation]`.
    Indentation(IndentationResults),
    /// Of `[laws]`.
    Laws(LawsResults),
    /// Of `[limit]`.
    Limit(LimitResults),
    /// Of `[precision]`.
    Precision(PrecisionResults),
    /// Of `[stability]`.
    Stability(StabilityResults),
    /// Of a look at surfaces.
    Surfaces(SurfacesResults),
}

impl Results {
    /// What every experiment has.
    pub fn metadata(&self) -> &Metadata {
        match self {
            Self::Compare(results) => &results.metadata,
            Self::Indentation(results) => &results.metadata,
            Self::Laws(results) => &results.compare.metadata,
            Self::Limit(results) => &results.metadata,
            Self::Precision(results) => &results.metadata,
            Self::Stability(results) => &results.metadata,
            Self::Surfaces(results) => &results.metadata,
        }
    }

    /// What makes the answers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        match self {
            Self::Compare(results) => results.warnings(),
            Self::Indentation(results) => results.warnings(),
            Self::Laws(results) => results.compare.warnings(),
            Self::Limit(results) => results.contact.caveats.clone(),
            Self::Precision(results) => results.contact.caveats.clone(),
            Self::Stability(results) => results.warnings(),
            Self::Surfaces(results) => results.warnings(),
        }
    }
}

/// Warnings of surfaces, by name.
fn warnings<'a>(surfaces: impl IntoIterator<Item = &'a Surface>) -> Vec<String> {
    let of = |surface: &'a Surface| {
        surface.warnings.iter().map(|warning| format!("surface {}: {warning}", surface.name))
    };
    surfaces.into_iter().flat_map(of).collect()
}

/// A look at surfaces, without any contact.
#[derive(Debug)]
pub struct SurfacesResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The file that was looked at: a measured one, or a spec.
    pub file: PathBuf,
    /// The words of a spec that the command line made, for a measured file.
    pub words: Option<String>,
    /// The surfaces, in file order.
    pub surfaces: Vec<Surface>,
}

impl SurfacesResults {
    /// What makes the numbers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        warnings(&self.surfaces)
    }
}

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
                .and_then(|layer| layer.check.as_ref()?.warning(&layer.name, layer.rule)),
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

impl SurfaceResults {
    /// Every realisation with its number, from 1.
    pub fn realisations(&self) -> impl Iterator<Item = (usize, &RealisationResults)> {
        (1..).zip(std::iter::once(&self.first).chain(&self.others))
    }
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

/// Sets of growing size against their limit.
#[derive(Debug)]
pub struct LimitResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// What the sets were drawn from.
    pub population: Population,
    /// The laws, and what each one's limit was taken from.
    pub laws: Vec<(String, &'static str)>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Random sets of each size.
    pub draws: usize,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
}
