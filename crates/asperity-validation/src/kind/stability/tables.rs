//! `stability.csv` and `maps.csv`.

use crate::kind::stability::run::StabilityResults;
use crate::stability::{GroupFindings, Worst};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// The errors of one quantity over the cases of a group.
struct WorstRow<'a> {
    findings: &'a GroupFindings,
    worst: &'a Worst,
}

impl Row for WorstRow<'_> {
    const FILE: &'static str = "stability.csv";
    const ROWS: &'static str =
        "One row for each group of cases and quantity: errors relative to an evaluation of 32 digits.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            kind["text"] = row.findings.group.kind().name(), "What is evaluated: `single contact`, `sum`, `integral` or `load control`.";
            group["text"] = row.findings.group.name(), "Group of cases.";
            quantity["text"] = row.worst.quantity.name(), "Quantity whose error is given.";
            cases["count"] = row.findings.cases, "Cases checked.";
            failures["count"] = row.findings.failures.len(), "Cases that failed or could not be checked.";
            median_error["1", ignored] = row.worst.median, "Median of the errors.";
            worst_error["1", ignored] = row.worst.checked, "Largest error; zero where the result is exact for a separation within rounding of the given one.";
            bound["1"] = row.findings.group.bound(row.worst.quantity), "Bound of the error under most laws.";
            plain_error["1", ignored] = row.worst.error, "Largest error, the rounding of the separation included.";
            worst_bound["1", ignored] = row.worst.bound(row.findings.group), "Bound of the case with the largest error, which a narrow elastic-plastic transition makes larger.";
            worst_scene["count", ignored] = row.worst.case.index, "Number of the case with the largest error within its group.";
            worst_inputs["text", ignored] = row.worst.case.inputs(), "Every input of that case, to run it again.";
        }
    }
}

/// A cell of a map of errors.
struct CellRow {
    map: &'static str,
    x: f64,
    y: f64,
    error: f64,
}

impl Row for CellRow {
    const FILE: &'static str = "maps.csv";
    const ROWS: &'static str = "One row for each cell of each map of errors.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            map["text"] = row.map, "Map; the report names its quantity and axes.";
            x["1"] = row.x, "Position along x, as a common logarithm where the axis says so.";
            y["1"] = row.y, "Position along y, likewise.";
            cell_error["1", ignored] = Some(row.error).filter(|error| error.is_finite()), "Relative error; empty where the evaluation of 32 digits does not converge.";
        }
    }
}

/// Both tables.
pub(super) fn schemas() -> Vec<Schema> {
    vec![Schema::of::<WorstRow>(), Schema::of::<CellRow>()]
}

/// The files of [`schemas`].
pub(super) fn tables(results: &StabilityResults) -> Vec<Table> {
    vec![Table::new(worst(results)), Table::new(cells(results))]
}

fn worst(results: &StabilityResults) -> impl Iterator<Item = WorstRow<'_>> {
    results
        .groups
        .iter()
        .flat_map(|findings| findings.quantities.iter().map(move |worst| WorstRow { findings, worst }))
}

fn cells(results: &StabilityResults) -> impl Iterator<Item = CellRow> {
    results.maps.iter().flat_map(|map| {
        let position = |k: usize, axis: usize| {
            let [from, to] = map.ends[axis];
            from + (to - from) * k as f64 / (map.cells[axis] - 1) as f64
        };
        map.errors.iter().enumerate().map(move |(k, &error)| CellRow {
            map: map.name,
            x: position(k % map.cells[0], 0),
            y: position(k / map.cells[0], 1),
            error,
        })
    })
}
