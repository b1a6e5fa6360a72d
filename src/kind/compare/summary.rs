//! `summary.json` of a comparison.

use asperity::compare::Tolerances;
use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use indexmap::IndexMap;
use serde::Serialize;
use serde_json::{Map, Value};

use super::layer_summary as layer;
use super::layer_summary::{DecreaseSummary, LayerSummary, Thickness, ThresholdSummary};
use super::readings_summary::{ReadingSummary, readings};
use super::results::{CompareResults, SurfaceResults};
use crate::surface::{PopulationSummary, RealisationSummary, SurfaceSummary};

#[derive(Serialize)]
struct CompareSummary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer: Option<LayerSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<ToleranceSummary>,
    surfaces: IndexMap<&'a str, SurfaceSummary<'a>>,
    largest_gaps: Vec<GapSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    readings: Vec<ReadingSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layer_thresholds: Vec<ThresholdSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    falls: Vec<DecreaseSummary<'a>>,
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

/// Its part of `summary.json`.
pub fn summary(results: &CompareResults) -> serde_json::Result<Map<String, Value>> {
    let Tolerances { statistical, deterministic } = results.tolerances;
    fields(&CompareSummary {
        contact: ContactSummary::of(&results.contact),
        layer: results.contact.layer.as_ref().map(layer::summary),
        tolerance: statistical.or(deterministic).map(|_| ToleranceSummary { statistical, deterministic }),
        surfaces: results.surfaces.iter().map(|found| (&*found.surface.name, surface(found))).collect(),
        largest_gaps: results.surfaces.iter().flat_map(gaps).collect(),
        readings: readings(results.readings.as_ref()),
        layer_thresholds: results.surfaces.iter().flat_map(layer::thresholds).collect(),
        falls: results.surfaces.iter().flat_map(layer::decreases).collect(),
    })
}

/// A surface under both models.
fn surface(found: &SurfaceResults) -> SurfaceSummary<'_> {
    let several = !found.others.is_empty();
    let realisations = found.realisations().filter(|_| several).map(|(number, answered)| {
        RealisationSummary::new(
            number,
            answered.asperities,
            answered.nominal_area,
            &answered.statistics,
            answered.moments,
        )
    });
    let mut surface = crate::surface::summary(&found.surface);
    surface.plasticity_index = found.first.cases.first().and_then(|case| case.plasticity_index);
    surface.statistical_model = Some(PopulationSummary::from(&found.first.population));
    surface.realisations = realisations.collect();
    surface
}

fn gaps(found: &SurfaceResults) -> impl Iterator<Item = GapSummary<'_>> {
    found.realisations().flat_map(move |(realisation, answered)| {
        answered.cases.iter().flat_map(move |case| {
            case.gaps.largest.iter().map(move |gap| GapSummary {
                surface: &found.surface.name,
                realisation,
                law: &case.law,
                layer_thickness_m: case.thickness.map(Thickness),
                quantity: gap.quantity.name(),
                pairing: gap.pairing.name(),
                target: gap.target,
                statistical: gap.statistical,
                deterministic: gap.deterministic,
                difference: gap.difference(),
                over_sampling_error: gap.over_sampling_error,
            })
        })
    })
}
