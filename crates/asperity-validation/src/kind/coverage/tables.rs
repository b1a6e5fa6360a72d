//! `coverage.csv`

use super::findings::LoadCoverage;
use super::run::CoverageResults;
use crate::coverage::{Coverage, Quantity};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// One quantity at one load of one case.
struct CoverageRow<'a> {
    case: &'a str,
    load: &'a LoadCoverage,
    quantity: Quantity,
    coverage: &'a Coverage,
}

impl Row for CoverageRow<'_> {
    const FILE: &'static str = "coverage.csv";
    const ROWS: &'static str =
        "One row for each case, load and quantity: how often 95 % intervals hold the mean over all windows.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case: the random process of which windows are seen.";
            load_pa["Pa"] = row.load.load, "Nominal pressure at which all quantities but `load-at-separation` are taken.";
            fixed_separation_over_sigma["1"] = row.load.separation, "Separation at which `load-at-separation` is taken.";
            quantity["text"] = row.quantity.name(), "Difference between both models at equal load in `separation` (in sigma), `area` or `stiffness` (logarithm of the ratio); `area-of-sum`: logarithm of the area ratio of the sum; `load-at-separation`: logarithm of the statistical over the deterministic load.";
            effective_contacts["1"] = row.coverage.contacts, "Mean number of effective contacts of the sum.";
            area_ratio["1"] = row.coverage.area_ratio, "Mean of the larger area ratio of both models.";
            windows["count"] = row.coverage.windows, "Windows in which the quantity has a value.";
            truth["1"] = row.coverage.truth, "Mean of the quantity over these windows.";
            scatter["1"] = row.coverage.scatter, "Standard deviation of the quantity over these windows.";
            intervals["count"] = row.coverage.claimed.intervals, "Windows in which the program claims an interval.";
            covered["count"] = row.coverage.claimed.covered, "Windows whose claimed interval holds the truth.";
            coverage["1"] = row.coverage.claimed.coverage(), "Share of the claimed intervals that hold the truth; empty where none is claimed.";
            coverage_standard_error["1"] = row.coverage.claimed.coverage_error(), "Binomial standard error of the coverage.";
            stated_over_scatter["1"] = row.coverage.error_over_scatter(&row.coverage.claimed), "Mean stated standard error over the scatter.";
            independent_intervals["count"] = row.coverage.independent.intervals, "Windows with an interval from asperities taken as independent: of one window of each map, those with enough contacts.";
            independent_covered["count"] = row.coverage.independent.covered, "Those of them whose interval holds the truth.";
            independent_coverage["1"] = row.coverage.independent.coverage(), "Share of these intervals that hold the truth.";
            independent_stated_over_scatter["1"] = row.coverage.error_over_scatter(&row.coverage.independent), "Mean standard error for independent asperities over the scatter.";
        }
    }
}

/// The one table.
pub(super) fn schemas() -> Vec<Schema> {
    vec![Schema::of::<CoverageRow>()]
}

/// The file of [`schemas`].
pub(super) fn tables(results: &CoverageResults) -> Vec<Table> {
    let rows = results.cases.iter().flat_map(|case| {
        case.loads.iter().flat_map(move |load| {
            load.each().map(move |(quantity, coverage)| CoverageRow {
                case: &case.name,
                load,
                quantity,
                coverage,
            })
        })
    });
    vec![Table::new(rows)]
}
