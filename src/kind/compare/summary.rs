//! `summary.json` of a comparison.

use std::path::Path;

use asperity::compare::{ComparedQuantity, Kind, Stretch, Tolerances, Verdict};
use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use indexmap::IndexMap;
use serde::Serialize;
use serde_json::{Map, Value};

use super::findings::LeadingCause;
use super::layer_summary as layer;
use super::layer_summary::{DecreaseSummary, LayerSummary, Thickness, ThresholdSummary};
use super::ranking::summary::{RankingSummary, ranking};
use super::readings_summary::{ReadingSummary, readings};
use super::reference::{self, NearerSummary, ReferenceSummary};
use super::results::{CompareResults, SurfaceResults};
use super::tables::REFERENCE;
use crate::surface::fitness::{FitnessSummary, fitness_summary};
use crate::surface::{PopulationSummary, RealisationSummary, SurfaceSummary};

#[derive(Serialize)]
struct CompareSummary<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    looked_at: Option<&'a Path>,
    #[serde(flatten)]
    contact: ContactSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer: Option<LayerSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<ToleranceSummary>,
    surfaces: IndexMap<&'a str, SurfaceSummary<'a>>,
    fitness: Vec<FitnessSummary<'a>>,
    verdicts: Vec<VerdictSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    robustness: Vec<RobustnessSummary<'a>>,
    largest_gaps: Vec<GapSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    statistical_models: Vec<RankingSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    reference: Vec<ReferenceSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    nearer_to_reference: Vec<NearerSummary<'a>>,
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
}

/// The answer for one quantity over a stretch of load: of the statistical model against the sum, over all realisations.
/// Separations are in sigma, areas and stiffnesses relative to the deterministic model.
#[derive(Serialize)]
struct VerdictSummary<'a> {
    surface: &'a str,
    law: &'a str,
    layer_thickness_m: Option<Thickness>,
    quantity: &'static str,
    against: &'static str,
    model: &'static str,
    from_pa: f64,
    to_pa: f64,
    verdict: &'static str,
    difference: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    at_pa: Option<f64>,
    accepted: f64,
    area_needed_m2: Option<f64>,
    cause: Option<&'static str>,
    /// Choices in the analysis of the map that reverse the verdict on this quantity.
    depends_on: Vec<&'static str>,
}

/// A difference under another treatment of a measured map, at a valid load of its own verdicts.
#[derive(Serialize)]
struct RobustnessSummary<'a> {
    surface: &'a str,
    law: &'a str,
    layer_thickness_m: Option<Thickness>,
    choice: &'static str,
    treatment: String,
    quantity: &'static str,
    at_pa: f64,
    valid: bool,
    difference: f64,
    low: Option<f64>,
    high: Option<f64>,
    verdict: &'static str,
}

fn robustness(found: &SurfaceResults) -> Vec<RobustnessSummary<'_>> {
    let mut rows = Vec::new();
    for treated in found.robustness.iter().flat_map(|robustness| &robustness.treated) {
        for (index, (case, findings)) in found.first.cases.iter().zip(&found.findings.cases).enumerate() {
            for at in treated.differences(index) {
                for quantity in ComparedQuantity::ALL {
                    let Some(estimate) = at.estimates[quantity as usize] else { continue };
                    let ends = estimate.interval().map(|ends| ends.map(|end| quantity.reported(end)));
                    rows.push(RobustnessSummary {
                        surface: &found.surface.name,
                        law: &case.law,
                        layer_thickness_m: case.thickness.map(Thickness),
                        choice: treated.treatment.choice().name(),
                        treatment: treated.treatment.to_string(),
                        quantity: quantity.name(),
                        at_pa: at.load,
                        valid: at.exceeded().is_none(),
                        difference: quantity.reported(estimate.contrast),
                        low: ends.map(|ends| ends[0]),
                        high: ends.map(|ends| ends[1]),
                        verdict: Verdict::of(&estimate, findings.verdicts.accepted.band(quantity)).name(),
                    });
                }
            }
        }
    }
    rows
}

fn verdicts(found: &SurfaceResults) -> impl Iterator<Item = VerdictSummary<'_>> {
    let cases = found.first.cases.iter().zip(&found.findings.cases);
    cases.enumerate().flat_map(move |(index, (case, findings))| {
        let verdicts = &findings.verdicts;
        let depends_on = move |quantity| -> Vec<&'static str> {
            let of = found.robustness.iter().flat_map(|robustness| &robustness.dependences[index]);
            of.filter(|one| one.quantity == quantity).map(|one| one.choice.name()).collect()
        };
        let [statistical, deterministic] = [Kind::Statistical.name(), Kind::Deterministic.name()];
        let of = move |[model, against]: [&'static str; 2], stretch: &Stretch| {
            let reported = |contrast: f64| stretch.quantity.reported(contrast);
            let estimate = stretch.largest.map(|(_, estimate)| estimate);
            let ends = estimate.and_then(|estimate| estimate.interval());
            VerdictSummary {
                surface: &found.surface.name,
                law: &case.law,
                layer_thickness_m: case.thickness.map(Thickness),
                quantity: stretch.quantity.name(),
                against,
                model,
                from_pa: stretch.loads[0],
                to_pa: stretch.loads[1],
                verdict: verdicts.name(stretch.verdict),
                difference: estimate.map(|estimate| reported(estimate.contrast)),
                low: ends.map(|[low, _]| reported(low)),
                high: ends.map(|[_, high]| reported(high)),
                at_pa: stretch.largest.map(|(load, _)| load),
                accepted: stretch.accepted,
                area_needed_m2: verdicts.area_needed(stretch),
                cause: if against == REFERENCE {
                    let kind = if model == statistical { Kind::Statistical } else { Kind::Deterministic };
                    verdicts.cause_against_reference(kind, stretch).map(LeadingCause::name)
                } else {
                    verdicts.cause(stretch).map(LeadingCause::name)
                },
                depends_on: if against == REFERENCE { Vec::new() } else { depends_on(stretch.quantity) },
            }
        };
        let between = verdicts.stretches.iter().map(move |one| of([statistical, deterministic], one));
        let reference = verdicts.reference.iter().flat_map(move |reference| {
            let names = [statistical, deterministic].map(|model| [model, REFERENCE]);
            let each = names.into_iter().zip(&reference.stretches);
            each.flat_map(move |(names, stretches)| stretches.iter().map(move |one| of(names, one)))
        });
        between.chain(reference)
    })
}

/// Its part of `summary.json`.
pub fn summary(results: &CompareResults) -> serde_json::Result<Map<String, Value>> {
    let Tolerances { statistical, deterministic } = results.tolerances;
    fields(&CompareSummary {
        looked_at: results.described.as_ref().map(|described| &*described.file),
        contact: ContactSummary::of(&results.contact),
        layer: results.contact.layer.as_ref().map(layer::summary),
        tolerance: statistical.or(deterministic).map(|_| ToleranceSummary { statistical, deterministic }),
        surfaces: results.surfaces.iter().map(|found| (&*found.surface.name, surface(found))).collect(),
        fitness: fitness_summary(results.surfaces.iter().map(|found| &found.surface)),
        verdicts: results.surfaces.iter().flat_map(verdicts).collect(),
        robustness: results.surfaces.iter().flat_map(robustness).collect(),
        largest_gaps: results.surfaces.iter().flat_map(gaps).collect(),
        statistical_models: ranking(results),
        reference: reference::summary(results),
        nearer_to_reference: reference::nearer(results),
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
    // A joint density is named in the spec.
    let is_separate = found.first.model.joint.is_none();
    surface.statistical_model = is_separate.then(|| PopulationSummary::from(&found.first.population));
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
            })
        })
    })
}
