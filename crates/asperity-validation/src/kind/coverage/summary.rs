//! Summary of `[coverage]`.

use serde::Serialize;
use serde_json::{Map, Value};

use super::findings::{BAND, Combination, range};
use super::run::CoverageResults;
use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;

#[derive(Serialize)]
struct Summary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    coverage: CoverageSummary<'a>,
}

#[derive(Serialize)]
struct CoverageSummary<'a> {
    windows: usize,
    /// Combinations of case, load and quantity in which nearly all windows have an interval.
    combinations: usize,
    lowest: Option<f64>,
    highest: Option<f64>,
    /// Smallest and largest coverage where only a part of the windows has an interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_part_of_windows: Option<[f64; 2]>,
    allowed: [f64; 2],
    outside: Vec<OutsideSummary>,
    unclaimed: Vec<UnclaimedSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    independent: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct OutsideSummary {
    case: String,
    quantity: &'static str,
    effective_contacts: f64,
    coverage: f64,
    standard_error: f64,
}

#[derive(Serialize)]
struct UnclaimedSummary<'a> {
    case: &'a str,
    largest_share_claimed: f64,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &CoverageResults) -> serde_json::Result<Map<String, Value>> {
    let findings = &results.findings;
    let all = findings.range();
    let outside = |one: &'_ Combination| OutsideSummary {
        case: one.case.clone(),
        quantity: one.quantity.name(),
        effective_contacts: one.coverage.contacts,
        coverage: one.share,
        standard_error: one.error,
    };
    let unclaimed = findings
        .unclaimed
        .iter()
        .map(|one| UnclaimedSummary { case: &one.case, largest_share_claimed: one.share });
    let coverage = CoverageSummary {
        windows: results.windows.count(),
        combinations: findings.quantity.len(),
        lowest: all.map(|[lowest, _]| lowest),
        highest: all.map(|[_, highest]| highest),
        in_part_of_windows: range(findings.partial.iter().map(|one| one.share)),
        allowed: BAND,
        outside: findings.outside().map(outside).collect(),
        unclaimed: unclaimed.collect(),
        independent: findings.independent,
    };
    fields(&Summary { contact: ContactSummary::of(&results.contact), coverage })
}
