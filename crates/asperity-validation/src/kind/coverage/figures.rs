//! Coverage against effective contacts, and wrong verdicts by process.

use super::results::{CaseResults, CoverageResults};
use super::spec::Intervals;
use crate::coverage::{Coverage, VerdictCount};
use asperity::numeric::extremes;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot};

/// The range of coverages of both kinds of intervals, and what a point is.
pub fn caption(results: &CoverageResults) -> String {
    let (kind, least) = match results.intervals {
        Intervals::Blocks => ("Intervals from blocks", "90 %"),
        Intervals::ModelBased => ("Model-based intervals", "half"),
    };
    let cases = &results.cases;
    let range = |points: fn(&CaseResults) -> Vec<(f64, f64)>| {
        let [low, high] = extremes(cases.iter().flat_map(points).map(|(_, share)| share))?;
        Some(format!("{low:.1} to {high:.1} %"))
    };
    let finding = |kind: &str, range: Option<String>| {
        range.map_or_else(String::new, |range| format!("{kind} cover the truth in {range} of the windows. "))
    };
    format!(
        "{}{}A point is a quantity at a load; band: {}.",
        finding(&format!("{kind}, where at least {least} of the windows have one,"), range(claimed)),
        finding("There, intervals that take asperities as independent", range(independent_where_claimed)),
        results.intervals.band_name(),
    )
}

/// Effective contacts and coverage (%) of the points of a case, their marker, and what the legend adds to the case.
type Series = (fn(&CaseResults) -> Vec<(f64, f64)>, Marker, &'static str);

fn claimed(case: &CaseResults) -> Vec<(f64, f64)> {
    case.claimed().map(|((_, coverage), share)| (coverage.contacts, 100.0 * share)).collect()
}

fn claimed_in_part(case: &CaseResults) -> Vec<(f64, f64)> {
    case.claimed_in_part().map(|((_, coverage), share)| (coverage.contacts, 100.0 * share)).collect()
}

fn independent(case: &CaseResults) -> Vec<(f64, f64)> {
    case.coverages().filter_map(|(_, coverage)| of_independent(coverage)).collect()
}

/// The same as [`independent`], of what [`claimed`] counts.
fn independent_where_claimed(case: &CaseResults) -> Vec<(f64, f64)> {
    case.claimed().filter_map(|((_, coverage), _)| of_independent(coverage)).collect()
}

fn of_independent(coverage: &Coverage) -> Option<(f64, f64)> {
    Some((coverage.contacts, 100.0 * coverage.independent.coverage()?))
}

pub fn coverage(results: &CoverageResults) -> Figure {
    let in_part = match results.intervals {
        Intervals::Blocks => ", in 5 to 90 % of windows",
        Intervals::ModelBased => ", in 5 to 50 % of windows",
    };
    let claims: [Series; 2] = [(claimed, Marker::Circle, ""), (claimed_in_part, Marker::Cross, in_part)];
    let mut plots = vec![plot(results, "Intervals that are claimed", &claims)];
    if results.cases.iter().any(|case| !independent(case).is_empty()) {
        plots.push(plot(results, "Asperities taken as independent", &[(independent, Marker::Cross, "")]));
    }
    Figure::column("Coverage of 95 % intervals", plots)
}

fn plot(results: &CoverageResults, title: &str, kinds: &[Series]) -> Plot {
    let contacts =
        results.cases.iter().flat_map(CaseResults::coverages).map(|(_, coverage)| coverage.contacts);
    let [least, most] = extremes(contacts).unwrap_or([1.0, 1e3]);
    let [low, high] = results.intervals.band().map(|share| 100.0 * share);
    let series = results.cases.iter().enumerate().flat_map(|(k, case)| {
        kinds
            .iter()
            .map(move |(points, marker, part)| (k, format!("{}{part}", case.name), points(case), *marker))
    });
    let series: Vec<_> = series.filter(|(.., points, _)| !points.is_empty()).collect();
    let shares = series.iter().flat_map(|(.., points, _)| points).map(|(_, share)| *share);
    let lowest = shares.fold(low, f64::min);
    let plot = Plot::new(
        title,
        Axis::log("effective contacts").range(0.9 * least, 1.1 * most),
        Axis::linear("coverage (%)").range(lowest - 1.0, 100.0),
    )
    .height(260.0)
    .legend(Legend::Below)
    .with(Layer::region_y(low, high, results.intervals.band_name()));
    series.into_iter().fold(plot, |plot, (k, name, points, marker)| {
        plot.with(Layer::points(points, marker).coloured(Colour::Series(k)).named(name))
    })
}

/// The share of decided verdicts that may be wrong, %.
const ALLOWED: f64 = 5.0;

/// Wrong shares (%) of decided verdicts and of windows.
fn shares(count: &VerdictCount) -> Option<(f64, f64)> {
    Some((100.0 * count.wrong_share()?, 100.0 * count.wrong_window_share()?))
}

/// In how many processes more decided verdicts than allowed are wrong, and what a point is.
pub fn wrong_verdicts_caption(results: &CoverageResults) -> String {
    let more = |of: fn(&CaseResults) -> &VerdictCount| {
        let shares = results.cases.iter().filter_map(|case| shares(of(case)));
        let (over, all) =
            shares.fold((0, 0), |(over, all), (share, _)| (over + usize::from(share > ALLOWED), all + 1));
        format!("{over} of {all}")
    };
    let robust = if results.cases.iter().any(|case| case.robust.windows > 0) {
        format!(", with robustness in {}", more(|case| &case.robust))
    } else {
        String::new()
    };
    format!(
        "More than 5 % of the decided verdicts are wrong in {} processes{robust}. A point is a process: circles are verdicts by themselves in all \
         windows, crosses those that depend on no choice in the analysis, in the windows studied.",
        more(|case| &case.verdicts),
    )
}

pub fn wrong_verdicts(results: &CoverageResults) -> Figure {
    let all = results.cases.iter().flat_map(|case| [&case.verdicts, &case.robust]);
    let largest = all.filter_map(shares).map(|(share, _)| share).fold(ALLOWED, f64::max);
    let plot = Plot::new(
        "",
        // The bound is in view, whatever the shares are.
        Axis::linear("decided verdicts that are wrong (%)").range(-0.1, 1.1 * largest),
        Axis::linear("of deciding windows, with a wrong verdict (%)"),
    )
    .height(260.0)
    .legend(Legend::Below)
    .with_zero()
    .with(Layer::at_x(ALLOWED, "5 %"));
    let points = |k: usize, case: &CaseResults, count: &VerdictCount, marker: Marker, part: &str| {
        let layer = Layer::points([shares(count)?], marker);
        Some(layer.coloured(Colour::Series(k)).named(format!("{}{part}", case.name)))
    };
    let series = results.cases.iter().enumerate().flat_map(|(k, case)| {
        let alone = points(k, case, &case.verdicts, Marker::Circle, "");
        let robust = points(k, case, &case.robust, Marker::Cross, ", with robustness");
        alone.into_iter().chain(robust)
    });
    Figure::column("Wrong verdicts by process", vec![series.fold(plot, Plot::with)])
}
