//! `processes.csv` and `coverage.csv`.

use asperity::topography::MIN_BLOCKS;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

use super::plan::WindowPlan;
use super::results::{CaseResults, CoverageResults, LoadCoverage};
use crate::coverage::{Coverage, CoveredQuantity};
use asperity::numeric::extremes;

/// One case.
pub struct ProcessRow<'a> {
    case: &'a CaseResults,
    windows: &'a WindowPlan,
    /// Side of a block, m.
    block: f64,
    /// Smallest and largest coverage where nearly all windows have an interval.
    claimed: Option<[f64; 2]>,
    /// The same where a part of the windows has one.
    in_part: Option<[f64; 2]>,
    /// The same of intervals that take asperities as independent.
    independent: Option<[f64; 2]>,
}

impl<'a> ProcessRow<'a> {
    fn new(case: &'a CaseResults, windows: &'a WindowPlan) -> Self {
        Self {
            case,
            windows,
            block: windows.side() / (MIN_BLOCKS as f64).sqrt(),
            claimed: extremes(case.claimed().map(|(_, share)| share)),
            in_part: extremes(case.claimed_in_part().map(|(_, share)| share)),
            independent: extremes(
                case.coverages().filter_map(|(_, coverage)| coverage.independent.coverage()),
            ),
        }
    }
}

impl Row for ProcessRow<'_> {
    const FILE: &'static str = "processes.csv";
    const ROWS: &'static str = "One row for each case, a random process: its windows, and the coverage of 95 % intervals over all combinations of load and quantity.";
    const RECORDS: Option<&'static str> = Some("processes");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case.name.as_str(), "Case.";
            heights["text"] = row.case.heights.to_string(), "Distribution of the heights.";
            roll_off_m["m", label("roll-off"), input] = row.case.roll_off, "Longest wavelength of the power law.";
            waves_per_block["1", label("longest waves per block")] = row.block / row.case.roll_off, "Side of a block, a sixteenth of a window, over the longest wavelength.";
            correlation_lengths_per_block["1"] = row.block / row.case.correlation, "Side of a block over the correlation length, which is the median over the windows.";
            windows["count"] = row.windows.count(), "Windows.";
            largest_claimed_share["1", label("windows with an interval, at most"), percent] = row.case.coverages().map(|(_, coverage)| coverage.claimed_share()).fold(0.0, f64::max), "Largest share of the windows in which the program claims an interval.";
            combinations["count", label("combinations with intervals in 90 % of the windows")] = row.case.claimed().count(), "Combinations of load and quantity in which at least 90 % of the windows have an interval.";
            lowest_coverage["1", percent] = row.claimed.map(|[low, _]| low), "Smallest coverage in these combinations.";
            highest_coverage["1", percent] = row.claimed.map(|[_, high]| high), "Largest coverage in these combinations.";
            outside["count", label("outside 93 to 97 %")] = row.case.outside().count(), "Combinations of these whose coverage is outside 93 to 97 %.";
            lowest_in_part["1", label("lowest coverage where fewer have an interval"), percent] = row.in_part.map(|[low, _]| low), "Smallest coverage in combinations in which 5 to 90 % of the windows have an interval.";
            highest_in_part["1", label("highest"), percent] = row.in_part.map(|[_, high]| high), "Largest coverage in these combinations.";
            lowest_independent["1", label("lowest coverage, asperities as independent"), percent] = row.independent.map(|[low, _]| low), "Smallest coverage of intervals that take asperities as independent, over all combinations.";
            highest_independent["1", label("highest"), percent] = row.independent.map(|[_, high]| high), "Largest coverage of such intervals.";
        }
    }
}

/// One quantity at one load of one case.
pub struct CoverageRow<'a> {
    case: &'a str,
    load: &'a LoadCoverage,
    quantity: CoveredQuantity,
    coverage: &'a Coverage,
}

impl Row for CoverageRow<'_> {
    const FILE: &'static str = "coverage.csv";
    const ROWS: &'static str =
        "One row for each case, load and quantity: how often 95 % intervals hold the mean over all windows.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case: the random process of which windows are seen.";
            load_pa["Pa", prefix("M")] = row.load.load, "Nominal pressure at which all quantities but `load-at-separation` are taken.";
            fixed_separation_over_sigma["1"] = row.load.separation, "Separation at which `load-at-separation` is taken.";
            quantity["text"] = row.quantity.name(), "Difference between both models at equal load in `separation` (in sigma), `area` or `stiffness` (logarithm of the ratio); `area-of-sum`: logarithm of the area ratio of the sum; `load-at-separation`: logarithm of the statistical over the deterministic load.";
            effective_contacts["1"] = row.coverage.contacts, "Mean number of effective contacts of the sum.";
            area_ratio["1", percent] = row.coverage.area_ratio, "Mean of the larger area ratio of both models.";
            windows["count"] = row.coverage.windows, "Windows in which the quantity has a value.";
            truth["1"] = row.coverage.truth, "Mean of the quantity over these windows.";
            scatter["1"] = row.coverage.scatter, "Standard deviation of the quantity over these windows.";
            intervals["count"] = row.coverage.claimed.intervals, "Windows in which the program claims an interval.";
            covered["count"] = row.coverage.claimed.covered, "Windows whose claimed interval holds the truth.";
            coverage["1", percent] = row.coverage.claimed.coverage(), "Share of the claimed intervals that hold the truth; empty where none is claimed.";
            coverage_standard_error["1", label("± s.e."), percent] = row.coverage.claimed.coverage_error(), "Binomial standard error of the coverage.";
            stated_over_scatter["1", label("stated error over scatter")] = row.coverage.error_over_scatter(&row.coverage.claimed), "Mean stated standard error over the scatter.";
            independent_intervals["count"] = row.coverage.independent.intervals, "Windows with an interval from asperities taken as independent: of one window of each map, those with enough contacts.";
            independent_covered["count"] = row.coverage.independent.covered, "Those of them whose interval holds the truth.";
            independent_coverage["1", label("coverage, asperities as independent"), percent] = row.coverage.independent.coverage(), "Share of these intervals that hold the truth.";
            independent_stated_over_scatter["1"] = row.coverage.error_over_scatter(&row.coverage.independent), "Mean standard error for independent asperities over the scatter.";
        }
    }
}

/// The tables.
pub fn tables(results: &CoverageResults) -> Vec<Table> {
    let cases = results.cases.iter().map(|case| ProcessRow::new(case, &results.windows));
    let loads = results.cases.iter().flat_map(|case| case.loads.iter().map(move |load| (case, load)));
    let rows = loads.flat_map(|(CaseResults { name: case, .. }, load)| {
        let quantities = load.coverages.iter();
        quantities.map(move |&(quantity, ref coverage)| CoverageRow { case, load, quantity, coverage })
    });
    vec![Table::new(cases), Table::new(rows)]
}
