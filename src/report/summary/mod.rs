//! `summary.json` and `timing.json`: what ran, on what, and what came out, for machines.

mod indentation;
mod laws;
mod layer;
mod precision;
mod stability;
mod surface;

use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use super::limit::Slope;
use crate::experiment::results::{CompareResults, ContactMetadata, LimitResults, Metadata, SurfacesResults};
use crate::experiment::{LawsResults, StabilityResults};
use asperity::compare::Tolerances;
use asperity::work::Work;
pub use indentation::indentation;
use laws::LawsSummary;
use layer::{FallSummary, LayerSummary, Thickness, ThresholdSummary};
use precision::PrecisionSummary;
pub use precision::precision;
use stability::StabilitySummary;
use surface::SurfaceSummary;

/// The name by which a report says that this program wrote it.
pub const PROGRAM: &str = "asperity";

#[derive(Serialize)]
struct Summary<'a> {
    program: &'static str,
    version: &'static str,
    title: &'a str,
    spec_sha256: &'a str,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    looked_at: Option<&'a Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reduced_modulus_pa: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hardness_pa: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer: Option<LayerSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<ToleranceSummary>,
    surfaces: IndexMap<&'a str, SurfaceSummary<'a>>,
    largest_gaps: Vec<GapSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layer_thresholds: Vec<ThresholdSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    falls: Vec<FallSummary<'a>>,
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<indentation::SphereSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    laws: Option<LawsSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    precision: Option<PrecisionSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    slopes: Vec<SlopeSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stability: Option<StabilitySummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    work: Option<Work>,
    papers: Vec<&'static str>,
    files: &'a [String],
}

/// Of the curves over d/sigma; `None` where they are exact.
#[derive(Serialize)]
struct ToleranceSummary {
    statistical: Option<f64>,
    deterministic: Option<f64>,
}

#[derive(Serialize)]
struct GapSummary<'a> {
    surface: &'a str,
    realisation: usize,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    quantity: &'static str,
    pairing: &'static str,
    target: f64,
    statistical: f64,
    deterministic: f64,
    difference: f64,
    over_sampling_error: Option<f64>,
}

#[derive(Serialize)]
struct SlopeSummary<'a> {
    law: &'a str,
    quantity: &'static str,
    heights: &'static str,
    separation_over_sigma: f64,
    slope: f64,
    standard_error: f64,
    points: usize,
}

impl<'a> Summary<'a> {
    fn new(metadata: &'a Metadata, contact: Option<&'a ContactMetadata>, files: &'a [String]) -> Self {
        Self {
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: &metadata.title,
            spec_sha256: &metadata.spec_sha256,
            seed: metadata.seed,
            looked_at: None,
            reduced_modulus_pa: contact.map(|contact| contact.reduced_modulus),
            hardness_pa: contact.and_then(|contact| contact.hardness),
            tolerance: None,
            surfaces: IndexMap::new(),
            layer: contact.and_then(|contact| contact.layer.as_ref()).map(layer::summary),
            largest_gaps: Vec::new(),
            layer_thresholds: Vec::new(),
            falls: Vec::new(),
            warnings: Vec::new(),
            layers: Vec::new(),
            laws: None,
            precision: None,
            slopes: Vec::new(),
            stability: None,
            work: metadata.work,
            papers: metadata.papers.iter().map(|paper| paper.full).collect(),
            files,
        }
    }
}

/// `summary.json` of a comparison; `files` are the names of all files of the report.
///
/// # Errors
/// None that a result can cause.
pub fn compare(results: &CompareResults, files: &[String]) -> serde_json::Result<Vec<u8>> {
    serde_json::to_vec_pretty(&compared(results, files))
}

/// `summary.json` of several laws.
///
/// # Errors
/// None that a result can cause.
pub fn laws(results: &LawsResults, files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = compared(&results.compare, files);
    summary.laws = Some(laws::summary(results));
    serde_json::to_vec_pretty(&summary)
}

/// `summary.json` of stability.
///
/// # Errors
/// None that a result can cause.
pub fn stability(results: &StabilityResults, files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = Summary::new(&results.metadata, None, files);
    summary.warnings = results.warnings();
    summary.stability = Some(stability::summary(results));
    serde_json::to_vec_pretty(&summary)
}

fn compared<'a>(results: &'a CompareResults, files: &'a [String]) -> Summary<'a> {
    let mut summary = Summary::new(&results.metadata, Some(&results.contact), files);
    summary.warnings = results.warnings();
    let Tolerances { statistical, deterministic } = results.tolerances;
    summary.tolerance =
        statistical.or(deterministic).map(|_| ToleranceSummary { statistical, deterministic });
    for found in &results.surfaces {
        summary.surfaces.insert(&found.surface.name, surface::compared(found));
        summary.layer_thresholds.extend(layer::thresholds(found));
        summary.falls.extend(layer::falls(found));
        for (realisation, answered) in found.realisations() {
            for case in &answered.cases {
                summary.largest_gaps.extend(case.gaps.largest.iter().map(|gap| GapSummary {
                    surface: &found.surface.name,
                    realisation,
                    law: &case.law,
                    layer_thickness_m: case.thickness.map(Thickness),
                    quantity: gap.quantity,
                    pairing: gap.pairing.name(),
                    target: gap.target,
                    statistical: gap.statistical,
                    deterministic: gap.deterministic,
                    difference: gap.difference(),
                    over_sampling_error: gap.over_sampling_error,
                }));
            }
        }
    }
    summary
}

/// `summary.json` of a look at surfaces.
///
/// # Errors
/// None that a result can cause.
pub fn surfaces(results: &SurfacesResults, files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = Summary::new(&results.metadata, None, files);
    summary.looked_at = Some(&results.file);
    summary.warnings = results.warnings();
    for surface in &results.surfaces {
        summary.surfaces.insert(&surface.name, surface::surface(surface));
    }
    serde_json::to_vec_pretty(&summary)
}

/// The file that the report in `folder` looked at; `None` if there is no such report.
pub fn looked_at(folder: &Path) -> Option<PathBuf> {
    #[derive(Deserialize)]
    struct AnalysisDepth {
        looked_at: PathBuf,
    }
    let summary = std::fs::read(folder.join("summary.json")).ok()?;
    serde_json::from_slice::<AnalysisDepth>(&summary).ok().map(|look| look.looked_at)
}

/// `summary.json` of a limit.
///
/// # Errors
/// None that a result can cause.
pub fn limit(results: &LimitResults, slopes: &[Slope], files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = Summary::new(&results.metadata, Some(&results.contact), files);
    summary.slopes = slopes
        .iter()
        .map(|slope| SlopeSummary {
            law: slope.law,
            quantity: slope.quantity.name(),
            heights: slope.heights.name(),
            separation_over_sigma: slope.separation,
            slope: slope.fit.slope,
            standard_error: slope.fit.standard_error,
            points: slope.fit.points,
        })
        .collect();
    serde_json::to_vec_pretty(&summary)
}

#[derive(Serialize)]
struct Times {
    read_s: f64,
    generate_s: f64,
    summits_s: f64,
    statistical_s: f64,
    deterministic_s: f64,
    report_s: f64,
    total_s: f64,
}

/// `timing.json`, given the time that pages, tables and pictures took.
///
/// # Errors
/// None that a result can cause.
pub fn timing(metadata: &Metadata, report: std::time::Duration) -> serde_json::Result<Vec<u8>> {
    let timing = &metadata.timing;
    serde_json::to_vec_pretty(&Times {
        read_s: timing.read.as_secs_f64(),
        generate_s: timing.generate.as_secs_f64(),
        summits_s: timing.summits.as_secs_f64(),
        statistical_s: timing.statistical.as_secs_f64(),
        deterministic_s: timing.deterministic.as_secs_f64(),
        report_s: report.as_secs_f64(),
        total_s: (timing.total + report).as_secs_f64(),
    })
}
