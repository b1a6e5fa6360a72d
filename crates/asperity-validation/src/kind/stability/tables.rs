//! `stability.csv` and `maps.csv`.

use crate::kind::stability::run::StabilityResults;
use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;

row! {
struct WorstRow {
    kind: &'static str,
    group: &'static str,
    quantity: &'static str,
    cases: u64,
    failures: usize,
    median_error: f64,
    worst_error: f64,
    bound: f64,
    plain_error: f64,
    worst_bound: f64,
    worst_scene: u64,
    worst_inputs: String,
}
}

row! {
struct CellRow {
    map: &'static str,
    x: f64,
    y: f64,
    cell_error: Option<f64>,
}
}

/// Both tables.
///
/// # Errors
/// See [`TableError`].
pub fn tables(results: &StabilityResults) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
    Ok(vec![("stability.csv", worst(results)?), ("maps.csv", cells(results)?)])
}

fn worst(results: &StabilityResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[WorstRow::COLUMNS])?;
    for findings in &results.groups {
        for worst in &findings.quantities {
            table.row(WorstRow {
                kind: findings.group.kind().name(),
                group: findings.group.name(),
                quantity: worst.quantity.name(),
                cases: findings.cases,
                failures: findings.failures.len(),
                median_error: worst.median,
                worst_error: worst.checked,
                bound: findings.group.bound(worst.quantity),
                plain_error: worst.error,
                worst_bound: worst.bound(findings.group),
                worst_scene: worst.case.index,
                worst_inputs: worst.case.inputs(),
            })?;
        }
    }
    table.bytes()
}

fn cells(results: &StabilityResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CellRow::COLUMNS])?;
    for map in &results.maps {
        let place = |k: usize, axis: usize| {
            let [from, to] = map.ends[axis];
            from + (to - from) * k as f64 / (map.cells[axis] - 1) as f64
        };
        for (k, error) in map.errors.iter().enumerate() {
            table.row(CellRow {
                map: map.name,
                x: place(k % map.cells[0], 0),
                y: place(k / map.cells[0], 1),
                cell_error: Some(*error).filter(|error| error.is_finite()),
            })?;
        }
    }
    table.bytes()
}
