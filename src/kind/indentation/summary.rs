//! Summary of a sphere on layers.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::kind::indentation::run::{IndentationResults, LayerResults};
use asperity::ModulusModel;
use asperity::compare::ModulusError;
use asperity::sphere::{Curve, Decrease, RegimeChange};
use asperity_framework::fields;

/// A layer of one thickness.
#[derive(Serialize)]
struct SphereSummary<'a> {
    layer: &'a str,
    layer_thickness_m: f64,
    rule: &'static str,
    modulus_ratio: f64,
    is_modulus_ratio_good: bool,
    largest_rule_errors: Vec<RuleSummary>,
    largest_contact_radius_over_radius: f64,
    exact_points_left_out: usize,
    laws: Vec<LawSummary<'a>>,
}

#[derive(Serialize)]
struct RuleSummary {
    rule: &'static str,
    contact_radius_over_thickness: f64,
    indentation_ratio: f64,
    load_over_exact: f64,
}

#[derive(Serialize)]
struct LawSummary<'a> {
    law: &'a str,
    regimes: Vec<&'static str>,
    changes: Vec<ChangeSummary>,
    falls: Vec<DecreaseSummary>,
}

#[derive(Serialize)]
struct ChangeSummary {
    indentation_m: f64,
    load_n: f64,
    from: &'static str,
    to: &'static str,
    within_sweep: bool,
}

#[derive(Serialize)]
struct DecreaseSummary {
    of: &'static str,
    from_indentation_m: f64,
    to_indentation_m: f64,
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct IndentationSummary<'a> {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<SphereSummary<'a>>,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &IndentationResults) -> serde_json::Result<Map<String, Value>> {
    let layers = results.layers.iter().map(|found| layer(found, results.radius)).collect();
    fields(&IndentationSummary { layers })
}

fn layer(found: &LayerResults, radius: f64) -> SphereSummary<'_> {
    let worst = ModulusModel::ALL.into_iter().zip(&found.check.worst);
    SphereSummary {
        layer: &found.name,
        layer_thickness_m: found.thickness,
        rule: found.rule.name(),
        modulus_ratio: found.check.modulus_ratio,
        is_modulus_ratio_good: found.check.is_good(),
        largest_rule_errors: worst
            .filter_map(|(rule, worst)| Some(rule_error(rule, worst.as_ref()?)))
            .collect(),
        largest_contact_radius_over_radius: found.largest_slope(radius),
        exact_points_left_out: found.unsolved(),
        laws: found.laws.iter().map(|law| curve(&law.law, &law.coated)).collect(),
    }
}

fn rule_error(rule: ModulusModel, error: &ModulusError) -> RuleSummary {
    RuleSummary {
        rule: rule.name(),
        contact_radius_over_thickness: error.contact_ratio,
        indentation_ratio: error.indentation_ratio,
        load_over_exact: error.ratio,
    }
}

fn curve<'a>(law: &'a str, coated: &Curve) -> LawSummary<'a> {
    let change = |change: &RegimeChange| ChangeSummary {
        indentation_m: change.indentation,
        load_n: change.load,
        from: change.from.name(),
        to: change.to.name(),
        within_sweep: coated.is_within(change),
    };
    let decrease = |decrease: &Decrease| DecreaseSummary {
        of: decrease.of.name(),
        from_indentation_m: decrease.from.indentation,
        to_indentation_m: decrease.to.indentation,
        from: decrease.of.of(&decrease.from.contact),
        to: decrease.of.of(&decrease.to.contact),
    };
    LawSummary {
        law,
        regimes: coated.sequence().into_iter().map(|regime| regime.name()).collect(),
        changes: coated.changes.iter().map(change).collect(),
        falls: coated.decreases.iter().map(decrease).collect(),
    }
}
