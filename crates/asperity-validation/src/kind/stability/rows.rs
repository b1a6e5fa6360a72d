//! `groups.csv`, `stability.csv` and `maps.csv`.

use super::results::StabilityResults;
use crate::stability::{CheckedQuantity, Failure, GroupResults, WorstCase};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

impl Row for &GroupResults {
    const FILE: &'static str = "groups.csv";
    const ROWS: &'static str = "One row for each group of cases: the largest errors relative to an evaluation of 32 digits, zero where the result is exact for a separation within rounding of the given one. Empty where the group does not have the quantity.";
    const RECORDS: Option<&'static str> = Some("groups");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            kind["text"] = row.group.kind().name(), "What is evaluated: `single contact`, `sum`, `integral` or `load control`.";
            group["text"] = row.group.name(), "Group of cases.";
            description["text"] = row.group.about(), "Its cases.";
            cases["count"] = row.cases, "Cases checked.";
            failures["count"] = row.failures.len(), "Cases that failed or could not be checked.";
            not_finite["count"] = row.failures.iter().filter(|(_, failure)| matches!(failure, Failure::NotFinite(_))).count(), "Of these, cases with a NaN or an infinity.";
            within_bounds["true/false"] = row.is_within_bounds(), "Whether every case was checked and every quantity is within its bound.";
            bound["1", one_digit] = row.group.bound(CheckedQuantity::Load), "Bound of all errors but those of slopes of tables, before the factor of a narrow transition; without a layer, of laws in closed form.";
            area_error["1", label("area"), one_digit, ignored] = row.largest_error(CheckedQuantity::Area), "Error of the area.";
            load_error["1", label("load"), one_digit, ignored] = row.largest_error(CheckedQuantity::Load), "Error of the load or nominal pressure.";
            stiffness_error["1", label("stiffness"), one_digit, ignored] = row.largest_error(CheckedQuantity::Stiffness), "Error of the stiffness.";
            contact_density_error["1", label("contact density"), one_digit, ignored] = row.largest_error(CheckedQuantity::Density), "Error of the contacts per nominal area.";
            regime_share_error["1", label("regime shares"), one_digit, ignored] = row.largest_error(CheckedQuantity::Shares), "Absolute error of the parts of area and load in each regime.";
            sampling_error["1", one_digit, ignored] = row.largest_error(CheckedQuantity::Sampling), "Error of the variances of area and load over the mean square.";
            pressure_error["1", label("pressure reached"), one_digit, ignored] = row.largest_error(CheckedQuantity::Reached), "Error of the pressure on which load control ends.";
        }
    }
}

/// The errors of one quantity over the cases of a group.
pub struct WorstRow<'a> {
    group: &'a GroupResults,
    worst: &'a WorstCase,
}

impl Row for WorstRow<'_> {
    const FILE: &'static str = "stability.csv";
    const ROWS: &'static str =
        "One row for each group of cases and quantity: errors relative to an evaluation of 32 digits.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            kind["text"] = row.group.group.kind().name(), "What is evaluated: `single contact`, `sum`, `integral` or `load control`.";
            group["text"] = row.group.group.name(), "Group of cases.";
            quantity["text"] = row.worst.quantity.name(), "Quantity whose error is given.";
            cases["count"] = row.group.cases, "Cases checked.";
            failures["count"] = row.group.failures.len(), "Cases that failed or could not be checked.";
            median_error["1", one_digit, ignored] = row.worst.median, "Median of the errors.";
            worst_error["1", one_digit, ignored] = row.worst.checked, "Error of the case closest to its bound; zero where the result is exact for a separation within rounding of the given one.";
            bound["1", one_digit] = row.group.group.bound(row.worst.quantity), "Bound of the error under most laws.";
            plain_error["1", one_digit, ignored] = row.worst.error, "Largest error, the rounding of the separation included.";
            worst_bound["1", label("bound of the worst case"), one_digit, ignored] = row.worst.bound(), "Bound of the case closest to its bound, which a narrow elastic-plastic transition makes larger.";
            worst_scene["count", label("worst case"), ignored] = row.worst.case.index, "Number of that case within its group.";
            worst_inputs["text", ignored] = row.worst.case.inputs(), "Every input of that case, to run it again.";
        }
    }
}

/// A cell of a map of errors.
pub struct CellRow {
    map: &'static str,
    position: [f64; 2],
    error: f64,
}

impl Row for CellRow {
    const FILE: &'static str = "maps.csv";
    const ROWS: &'static str = "One row for each cell of each map of errors.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            map["text"] = row.map, "Map; the report names its quantity and axes.";
            x["1"] = row.position[0], "Position along x, as a common logarithm where the axis says so.";
            y["1"] = row.position[1], "Position along y, likewise.";
            cell_error["1", ignored] = Some(row.error).filter(|error| error.is_finite()), "Relative error; empty where the evaluation of 32 digits does not converge.";
        }
    }
}

/// The tables.
pub fn tables(results: &StabilityResults) -> Vec<Table> {
    let worst = results.groups.iter();
    let worst = worst.flat_map(|group| group.worst.iter().map(move |worst| WorstRow { group, worst }));
    let cells = results
        .maps
        .iter()
        .flat_map(|map| map.points().map(|(position, error)| CellRow { map: map.name, position, error }));
    vec![Table::new(&results.groups), Table::new(worst), Table::new(cells)]
}
