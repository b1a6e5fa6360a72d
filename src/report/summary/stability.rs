//! What a summary says of stability.

use serde::Serialize;

use crate::experiment::StabilityResults;

/// Group by group.
#[derive(Serialize)]
pub(super) struct StabilitySummary {
    cases: u64,
    groups: Vec<FamilySummary>,
}

#[derive(Serialize)]
struct FamilySummary {
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

pub(super) fn summary(results: &StabilityResults) -> StabilitySummary {
    let groups = results.groups.iter().map(|findings| FamilySummary {
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
    StabilitySummary { cases: results.cases(), groups: groups.collect() }
}
