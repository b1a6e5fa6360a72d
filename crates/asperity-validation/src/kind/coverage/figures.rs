//! Coverage against effective contacts, and wrong verdicts by process.

use super::results::{CaseResults, CoverageResults};
use super::spec::Intervals;
use crate::coverage::{Coverage, VerdictCount};
use asperity::numeric::extremes;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot, series_colours};

/// What a point is, and how far intervals fall short that take asperities as independent.
pub fn caption(results: &CoverageResults) -> String {
    let independent = results.cases.iter().flat_map(independent_where_claimed).map(|(_, share)| share);
    let below = extremes(independent).map_or_else(String::new, |[low, high]| {
        format!(" Below: asperities taken as independent; where blocks give intervals, these cover {low:.1} to {high:.1} %.")
    });
    format!(
        "Coverage against effective contacts; a point is a quantity at a load, the band {}.{below}",
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
        plot.with(Layer::points(points, of_series(k, marker)).coloured(Colour::Series(k)).named(name))
    })
}

/// Another marker for the series whose colour is that of an earlier one.
fn of_series(k: usize, marker: Marker) -> Marker {
    match marker {
        _ if k < series_colours().len() => marker,
        Marker::Circle => Marker::Square,
        _ => Marker::Triangle,
    }
}

/// The share of decided verdicts that may be wrong, %.
const ALLOWED: f64 = 5.0;

/// Wrong shares (%) of decided verdicts and of windows.
fn shares(count: &VerdictCount) -> Option<(f64, f64)> {
    Some((100.0 * count.wrong_share()?, 100.0 * count.wrong_window_share()?))
}

pub const WRONG_VERDICTS: &str = "Wrong verdicts; a point is a process. Circles: verdicts by themselves, in all windows; crosses: those that \
                                  depend on no choice in the analysis, in the windows studied.";

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_processes_look_alike() {
        for marker in [Marker::Circle, Marker::Cross] {
            assert_eq!(of_series(7, marker), marker);
            assert_ne!(of_series(8, marker), marker);
        }
        assert_ne!(of_series(8, Marker::Circle), of_series(8, Marker::Cross));
    }
}
