//! `summary.json` of a limit.

use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use serde::Serialize;
use serde_json::{Map, Value};

use super::run::LimitResults;

#[derive(Serialize)]
struct LimitSummary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    slopes: Vec<SlopeSummary<'a>>,
}

#[derive(Serialize)]
struct SlopeSummary<'a> {
    law: &'a str,
    quantity: &'static str,
    heights: &'static str,
    separation_over_sigma: f64,
    slope: f64,
    standard_error: f64,
    expected_slope: f64,
    points: usize,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &LimitResults) -> serde_json::Result<Map<String, Value>> {
    let slopes = results.slopes.iter().map(|slope| SlopeSummary {
        law: &slope.law,
        quantity: slope.quantity.name(),
        heights: slope.heights.name(),
        separation_over_sigma: slope.separation,
        slope: slope.fit.slope,
        standard_error: slope.fit.standard_error,
        expected_slope: slope.expected,
        points: slope.fit.points,
    });
    fields(&LimitSummary { contact: ContactSummary::of(&results.contact), slopes: slopes.collect() })
}
