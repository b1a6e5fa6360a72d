//! The layer in `summary.json`.

use serde::{Serialize, Serializer};

use crate::kind::compare::results::SurfaceResults;
use asperity::ModulusModel;
use asperity::compare::ModulusError;
use asperity_framework::contact::LayerMetadata;

/// A thickness, m. JSON has no infinity: it is the word "inf", as in a spec.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thickness(pub(super) f64);

impl Serialize for Thickness {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() { serializer.serialize_f64(self.0) } else { serializer.serialize_str("inf") }
    }
}

#[derive(Serialize)]
pub(super) struct LayerSummary<'a> {
    material: &'a str,
    rule: &'static str,
    thicknesses_m: Vec<Thickness>,
    #[serde(skip_serializing_if = "Option::is_none")]
    modulus_ratio: Option<f64>,
    rule_errors: Vec<RuleErrorSummary>,
}

/// Elastic load by an effective-modulus model over the exact one.
#[derive(Serialize)]
struct RuleErrorSummary {
    rule: &'static str,
    contact_radius_over_thickness: f64,
    load_over_exact: f64,
}

/// Largest thickness at which the real area is within 5 % of the uncoated one; empty where even the thinnest has an effect.
#[derive(Serialize)]
pub(super) struct ThresholdSummary<'a> {
    surface: &'a str,
    law: &'a str,
    model: &'static str,
    pressure_pa: f64,
    thickness_m: Option<Thickness>,
}

/// Where a deeper asperity has less area or load.
#[derive(Serialize)]
pub(super) struct DecreaseSummary<'a> {
    surface: &'a str,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    radius_m: f64,
    of: &'static str,
    from_m: f64,
    to_m: f64,
    loss: f64,
}

pub(super) fn summary(layer: &LayerMetadata) -> LayerSummary<'_> {
    let error = |(rule, error): (ModulusModel, &ModulusError)| RuleErrorSummary {
        rule: rule.name(),
        contact_radius_over_thickness: error.contact_ratio,
        load_over_exact: error.ratio,
    };
    let told = layer.check.iter().flat_map(|check| ModulusModel::ALL.into_iter().zip(&check.reported));
    let errors = told.flat_map(|(rule, errors)| errors.iter().map(move |error| (rule, error)));
    LayerSummary {
        material: &layer.name,
        rule: layer.rule.name(),
        thicknesses_m: layer.thicknesses.iter().copied().map(Thickness).collect(),
        modulus_ratio: layer.check.as_ref().map(|check| check.modulus_ratio),
        rule_errors: errors.map(error).collect(),
    }
}

pub(super) fn thresholds(found: &SurfaceResults) -> impl Iterator<Item = ThresholdSummary<'_>> {
    found.thresholds.iter().map(|threshold| ThresholdSummary {
        surface: &found.surface.name,
        law: &threshold.law,
        model: threshold.kind.name(),
        pressure_pa: threshold.pressure,
        thickness_m: threshold.thickness.map(Thickness),
    })
}

pub(super) fn decreases(found: &SurfaceResults) -> impl Iterator<Item = DecreaseSummary<'_>> {
    found.decreases.iter().map(|one| DecreaseSummary {
        surface: &found.surface.name,
        law: &one.law,
        layer_thickness_m: one.thickness.map(Thickness),
        radius_m: one.radius,
        of: one.decrease.of.name(),
        from_m: one.decrease.from.indentation,
        to_m: one.decrease.to.indentation,
        loss: one.decrease.loss(),
    })
}
