//! `processes.csv`, `coverage.csv`, and tables of verdicts, fitness checks and planted spikes.

use asperity::topography::MIN_BLOCKS;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

use super::plan::WindowPlan;
use super::results::{CaseResults, CoverageResults, LoadCoverage, SpikedResults, total};
use super::spec::Intervals;
use crate::coverage::{CheckCount, Coverage, CoveredQuantity, VerdictCount};
use asperity::numeric::extremes;

/// One case.
pub struct ProcessRow<'a> {
    case: &'a CaseResults,
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
            heights["text"] = row.case.heights.to_string(), "Distribution of the heights of the field.";
            roughness["text"] = row.case.roughness.as_str(), "How the roughness differs from an isotropic, homogeneous one; empty where it does not.";
            roll_off_m["m", label("roll-off"), input] = row.case.roll_off, "Longest wavelength of the power law.";
            waves_per_block["1", label("longest waves per block")] = row.block / row.case.roll_off, "Side of a block, a sixteenth of a window, over the longest wavelength.";
            correlation_lengths_per_window["1"] = 4.0 * row.block / row.case.correlation, "Side of a window over the correlation length, which is the median over the windows.";
            correlation_lengths_per_block["1"] = row.block / row.case.correlation, "Side of a block over the correlation length, which is the median over the windows.";
            windows["count"] = row.case.windows, "Windows.";
            patchy_share["1", label("windows found patchy"), percent] = row.case.patchy, "Share of the windows whose roughness is found to be patchy.";
            largest_claimed_share["1", label("windows with an interval, at most"), percent] = row.case.coverages().map(|(_, coverage)| coverage.claimed_share()).fold(0.0, f64::max), "Largest share of the windows in which the program claims an interval.";
            combinations["count", label("combinations counted")] = row.case.claimed().count(), "Combinations of load and quantity in which at least 90 % of the windows have an interval, or half of them a model-based one.";
            lowest_coverage["1", percent] = row.claimed.map(|[low, _]| low), "Smallest coverage in these combinations.";
            highest_coverage["1", percent] = row.claimed.map(|[_, high]| high), "Largest coverage in these combinations.";
            outside["count", label("outside the band")] = row.case.outside().count(), "Combinations of these whose coverage is outside 93 to 97 %, of model-based intervals 93 to 98 %.";
            lowest_in_part["1", label("lowest coverage where fewer have an interval"), percent] = row.in_part.map(|[low, _]| low), "Smallest coverage in combinations in which 5 to 90 % of the windows have an interval, or 5 to 50 % a model-based one.";
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

/// Verdicts in the windows of one case, or of all.
pub struct VerdictRow<'a> {
    case: &'a str,
    kind: &'static str,
    robustness: &'static str,
    count: &'a VerdictCount,
    blocked: Option<usize>,
}

/// The name of the sums over all cases.
pub const ALL_CASES: &str = "all";
/// Verdicts by themselves, in all windows.
pub const ALONE: &str = "none";
/// The same in those windows that were studied under other treatments.
pub const ALONE_STUDIED: &str = "none, windows studied";
/// Verdicts that depend on no choice.
pub const ROBUST: &str = "examined";
/// Verdicts that decide.
const DECIDED: &str = "decided";
/// Very likely ones by a model-based interval.
pub const LIKELY: &str = "very likely";
/// Very likely ones by differences far beyond what is accepted on all halves of a window.
pub const FAR_BEYOND: &str = "very likely, without interval";

impl Row for VerdictRow<'_> {
    const FILE: &'static str = "wrong-verdicts.csv";
    const ROWS: &'static str = "One row for each case and all together, without and with robustness: how often verdicts of one window (`within` or `beyond` at an admissible load) contradict the mean over all windows.";
    const RECORDS: Option<&'static str> = Some("verdicts");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case, or `all`.";
            verdicts_counted["text", label("verdicts")] = row.kind, "Which verdicts are counted: `decided` ones (`within`, `beyond`); `very likely` ones by a model-based interval; `very likely, without interval`: a difference far beyond what is accepted on all halves of a window.";
            robustness["text"] = row.robustness, "Whether robustness counts. `none`: verdicts by themselves, in all windows; `none, windows studied`: the same in the windows that were studied under other treatments; `examined`: there, verdicts that depend on a choice are not counted as decided, and windows that a fitness check blocks have none.";
            windows["count"] = row.count.windows, "Windows.";
            blocked["count"] = row.blocked, "Of them those that a fitness check blocks.";
            deciding_windows["count", label("windows that decide")] = row.count.deciding_windows, "Windows with a decided verdict.";
            verdicts["count"] = row.count.verdicts, "Verdicts: quantities at admissible loads.";
            decided["count"] = row.count.decided, "Verdicts of the kind that is counted.";
            wrong["count"] = row.count.wrong, "Decided verdicts that are wrong: the mean over all windows is on another side of what is accepted.";
            wrong_share["1", label("wrong, of decided"), percent] = row.count.wrong_share(), "Share of the decided verdicts that are wrong.";
            wrong_windows["count"] = row.count.wrong_windows, "Windows with a wrong verdict.";
            wrong_window_share["1", label("windows with a wrong verdict"), percent] = row.count.wrong_window_share(), "Their share of the windows that decide.";
            wrong_window_upper["1", label("upper 95 % limit"), percent] = row.count.wrong_window_limit(), "Upper 95 % limit of this share (binomial).";
        }
    }
}

/// One fitness check in the windows of one case.
pub struct CheckRow<'a> {
    case: &'a str,
    count: &'a CheckCount,
}

impl Row for CheckRow<'_> {
    const FILE: &'static str = "fitness-checks.csv";
    const ROWS: &'static str =
        "One row for each case and fitness check of a map: how often it fails in windows that have no fault.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case.";
            check["text"] = row.count.check.name(), "Fitness check; those but `spikes` and `lines` are examined in the windows that were studied under other treatments.";
            windows["count"] = row.count.windows, "Windows.";
            failed["count"] = row.count.failed, "Windows in which the check fails.";
            blocked["count"] = row.count.blocked, "Windows in which it fails so that no verdict is given.";
            failed_share["1", label("share that fails"), percent] = row.count.failed as f64 / row.count.windows as f64, "Share of the windows in which it fails.";
            failed_share_upper["1", label("upper 95 % limit"), percent] = row.count.upper_limit(), "Upper 95 % limit of this share (binomial).";
        }
    }
}

/// Windows with spikes of one number and height.
pub struct SpikeRow<'a> {
    case: &'a str,
    results: &'a SpikedResults,
    clean: &'a SpikedResults,
}

impl Row for SpikeRow<'_> {
    const FILE: &'static str = "planted-spikes.csv";
    const ROWS: &'static str = "One row for each number and height of spikes of one point that are planted in windows, first for the same windows without: how often they are found, and how often verdicts where they are not contradict the mean over all windows without spikes.";
    const RECORDS: Option<&'static str> = Some("planted-spikes");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case whose process the windows are of.";
            spikes["count", input] = row.results.planted.map_or(0, |planted| planted.count), "Spikes in a window; 0 without.";
            deviations["1", input] = row.results.planted.map(|planted| planted.deviations), "Their height above the median of the 9 x 9 points around them, in robust standard deviations of such deviations.";
            windows["count"] = row.results.verdicts.windows, "Windows.";
            found["count"] = row.results.found, "Windows in which spikes are found, so that no verdict is given.";
            verdicts["count"] = row.results.verdicts.verdicts, "Verdicts in the others: quantities at admissible loads.";
            decided["count"] = row.results.verdicts.decided, "Verdicts by themselves that are `within` or `beyond`.";
            wrong_share["1", label("wrong, of decided"), percent] = row.results.verdicts.wrong_share(), "Share of these that are wrong.";
            wrong_window_share["1", label("windows with a wrong verdict"), percent] = row.results.verdicts.wrong_window_share(), "Share of the windows with a wrong verdict.";
            decided_without_suspects["count", label("decided, narrow points examined")] = row.results.without_suspects.decided, "Decided verdicts that do not depend on the removal of narrow points (`spikes` among the treatments).";
            wrong_share_without_suspects["1", label("wrong, of these"), percent] = row.results.without_suspects.wrong_share(), "Share of these that are wrong.";
            wrong_window_share_without_suspects["1", label("windows with a wrong one"), percent] = row.results.without_suspects.wrong_window_share(), "Share of the windows with a wrong one of these.";
            above_clean["1", label("above windows without spikes"), percent, signed] = row.above_clean(), "That share less the one of the same windows without spikes.";
            decided_robust["count", label("decided, all treatments")] = row.results.robust.decided, "Decided verdicts that depend on no choice.";
            wrong_share_robust["1", label("wrong, of these"), percent] = row.results.robust.wrong_share(), "Share of these that are wrong.";
            wrong_window_share_robust["1", label("windows with a wrong one"), percent] = row.results.robust.wrong_window_share(), "Share of the windows with a wrong one of these.";
        }
    }
}

impl SpikeRow<'_> {
    fn above_clean(&self) -> Option<f64> {
        let share = |of: &SpikedResults| of.without_suspects.wrong_window_share();
        self.results.planted?;
        Some(share(self.results)? - share(self.clean)?)
    }
}

/// Case, kind of verdict, robustness, counts, blocked windows.
type Counted = (String, &'static str, &'static str, VerdictCount, Option<usize>);

fn verdict_rows(results: &CoverageResults) -> Vec<Counted> {
    let of_case = |case: &CaseResults| {
        let studied = (case.studied.windows > 0).then_some([
            (case.name.clone(), DECIDED, ALONE_STUDIED, case.studied, Some(case.blocked)),
            (case.name.clone(), DECIDED, ROBUST, case.robust, Some(case.blocked)),
        ]);
        let likely = (case.intervals == Intervals::ModelBased).then_some([
            (case.name.clone(), LIKELY, ALONE, case.likely, None),
            (case.name.clone(), FAR_BEYOND, ALONE, case.far_beyond, None),
        ]);
        let alone = (case.name.clone(), DECIDED, ALONE, case.verdicts, None);
        std::iter::once(alone)
            .chain(likely.into_iter().flatten())
            .chain(studied.into_iter().flatten())
            .collect::<Vec<_>>()
    };
    let mut rows: Vec<_> = results.cases.iter().flat_map(of_case).collect();
    let all = |of| total(&results.cases, of);
    rows.push((ALL_CASES.to_owned(), DECIDED, ALONE, all(|case| &case.verdicts), None));
    if results.intervals == Intervals::ModelBased {
        rows.push((ALL_CASES.to_owned(), LIKELY, ALONE, all(|case| &case.likely), None));
        rows.push((ALL_CASES.to_owned(), FAR_BEYOND, ALONE, all(|case| &case.far_beyond), None));
    }
    let blocked = Some(results.cases.iter().map(|case| case.blocked).sum());
    if all(|case| &case.studied).windows > 0 {
        rows.push((ALL_CASES.to_owned(), DECIDED, ALONE_STUDIED, all(|case| &case.studied), blocked));
        rows.push((ALL_CASES.to_owned(), DECIDED, ROBUST, all(|case| &case.robust), blocked));
    }
    rows
}

/// The tables.
pub fn tables(results: &CoverageResults) -> Vec<Table> {
    let cases = results.cases.iter().map(|case| ProcessRow::new(case, &results.windows));
    let loads = results.cases.iter().flat_map(|case| case.loads.iter().map(move |load| (case, load)));
    let rows = loads.flat_map(|(CaseResults { name: case, .. }, load)| {
        let quantities = load.coverages.iter();
        quantities.map(move |&(quantity, ref coverage)| CoverageRow { case, load, quantity, coverage })
    });
    let counts = verdict_rows(results);
    let verdicts = counts.iter().map(|(case, kind, robustness, count, blocked)| VerdictRow {
        case,
        kind,
        robustness,
        count,
        blocked: *blocked,
    });
    let checks = results
        .cases
        .iter()
        .flat_map(|case| case.checks.iter().map(|count| CheckRow { case: &case.name, count }));
    let spikes = results.spikes.iter().flat_map(|spikes| {
        let row = |results| SpikeRow { case: &spikes.case, results, clean: &spikes.each[0] };
        spikes.each.iter().map(row)
    });
    vec![Table::new(cases), Table::new(rows), Table::new(verdicts), Table::new(checks), Table::new(spikes)]
}
