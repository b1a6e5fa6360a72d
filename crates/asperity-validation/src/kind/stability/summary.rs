//! Summary of `[stability]`.

use asperity_framework::fields;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::kind::stability::run::StabilityResults;

#[derive(Serialize)]
struct Summary {
    stability: StabilitySummary,
}

#[derive(Serialize)]
struct StabilitySummary {
    cases: u64,
    groups: Vec<GroupSummary>,
}

#[derive(Serialize)]
struct GroupSummary {
    group: &'static str,
    kind: &'static str,
    cases: u64,
    failures: usize,
    within_bounds: bool,
    quantities: Vec<QuantitySummary>,
}

#[derive(Serialize)]
struct QuantitySummary {
    quantity: &'static str,
    worst_error: f64,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &StabilityResults) -> serde_json::Result<Map<String, Value>> {
    let groups = results.groups.iter().map(|findings| GroupSummary {
        group: findings.group.name(),
        kind: findings.group.kind().name(),
        cases: findings.cases,
        failures: findings.failures.len(),
        within_bounds: findings.holds(),
        quantities: findings
            .quantities
            .iter()
            .map(|worst| QuantitySummary { quantity: worst.quantity.name(), worst_error: worst.checked })
            .collect(),
    });
    let stability = StabilitySummary { cases: results.cases(), groups: groups.collect() };
    fields(&Summary { stability })
}
