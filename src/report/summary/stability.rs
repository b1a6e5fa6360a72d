//! What a summary says of stability.

use serde::Serialize;

use crate::experiment::StabilityResults;

/// Family by family.
#[derive(Serialize)]
pub(super) struct StabilitySummary {
    scenes: u64,
    families: Vec<FamilySummary>,
}

#[derive(Serialize)]
struct FamilySummary {
    family: &'static str,
    kind: &'static str,
    scenes: u64,
    faults: usize,
    within_bounds: bool,
    quantities: Vec<QuantitySummary>,
}

#[derive(Serialize)]
struct QuantitySummary {
    quantity: &'static str,
    worst_error: f64,
}

pub(super) fn summary(results: &StabilityResults) -> StabilitySummary {
    let families = results.families.iter().map(|findings| FamilySummary {
        family: findings.family.name(),
        kind: findings.family.kind().name(),
        scenes: findings.scenes,
        faults: findings.faults.len(),
        within_bounds: findings.holds(),
        quantities: findings
            .quantities
            .iter()
            .map(|worst| QuantitySummary { quantity: worst.quantity.name(), worst_error: worst.judged })
            .collect(),
    });
    StabilitySummary { scenes: results.scenes(), families: families.collect() }
}
