//! Results of a comparison: everything that its report contains.

use std::path::PathBuf;

use asperity::analytical::AnalyticalLine;
use asperity::compare::Tolerances;
use asperity_framework::contact::ContactMetadata;
use asperity_framework::metadata::Metadata;

use super::answers::{DecreaseResults, RealisationResults, Threshold};
use super::findings::{Readings, SurfaceFindings};
use super::ranking::Ranking;
use super::reference::{ContactView, ElasticCase};
use super::robustness::Robustness;
use crate::layer::rule_warning;
use crate::surface::{Surface, warnings};

/// Both models on given surfaces.
#[derive(Debug)]
pub struct CompareResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// Warnings about inputs that are hardly meant or too coarse.
    pub implausible: Vec<String>,
    /// How far the curves over d/sigma may be off.
    pub tolerances: Tolerances,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
    /// What the reading of sigma and d changes, where surfaces with the same numbers have both.
    pub readings: Option<Readings>,
    /// Closed results beside the models.
    pub lines: Vec<AnalyticalLine>,
    /// How the reference was run; `None` where none was asked for.
    pub reference: Option<ReferenceMetadata>,
    /// Of a measured file that the command line named.
    pub described: Option<Described>,
}

/// How the reference was run.
#[derive(Debug)]
pub struct ReferenceMetadata {
    /// The relative dual gap that was asked for.
    pub error: f64,
    /// Points along an axis for each of the map's.
    pub refine: usize,
    /// Laws that yield beside an elastic reference.
    pub elastic: Vec<ElasticCase>,
}

/// What the command line made of a measured file.
#[derive(Debug)]
pub struct Described {
    /// The file.
    pub file: PathBuf,
    /// The spec that runs the same.
    pub spec: String,
}

impl CompareResults {
    /// Whether the gap between the models is divided among its causes.
    pub fn is_attributed(&self) -> bool {
        let cases = self.surfaces.iter().flat_map(|found| &found.first.cases);
        cases.into_iter().any(|case| !case.attribution.is_empty())
    }

    /// Warnings about the results, one per line.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = warnings(self.surfaces.iter().map(|found| &found.surface));
        lines.extend(self.implausible.iter().cloned());
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

/// Results on one surface and all its realisations.
#[derive(Debug)]
pub struct SurfaceResults {
    /// The first realisation, with its asperities.
    pub surface: Surface,
    /// Results on the first realisation.
    pub first: RealisationResults,
    /// The others: their asperities are not kept.
    pub others: Vec<RealisationResults>,
    /// Up to which thickness the first takes no notice of the layer, law by law, load by load, model by model.
    pub thresholds: Vec<Threshold>,
    /// Where the sharpest, a mean and the bluntest asperity of the first carry less, or touch on less, as they are
    /// pressed deeper.
    pub decreases: Vec<DecreaseResults>,
    /// Findings.
    pub findings: SurfaceFindings,
    /// The verdicts under other treatments of a measured map; `None` where none were examined.
    pub robustness: Option<Robustness>,
    /// The other statistical models, in the order of the cases of the first; empty where none is asked for.
    pub rankings: Vec<Ranking>,
    /// The contact of each solution of the reference at one load, on the first.
    pub contacts: Vec<ContactView>,
}

impl SurfaceResults {
    /// Every realisation with its number, from 1.
    pub fn realisations(&self) -> impl Iterator<Item = (usize, &RealisationResults)> {
        (1..).zip(std::iter::once(&self.first).chain(&self.others))
    }

    /// Number of realisations.
    pub fn count(&self) -> usize {
        1 + self.others.len()
    }
}
