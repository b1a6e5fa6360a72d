//! Coverage against effective contacts.

use super::results::{BAND, CaseResults, CoverageResults, range};
use crate::coverage::Coverage;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot};

pub const CAPTION: &str = "Intervals from blocks of a window cover the truth about as often as stated, those that take \
                           asperities as independent less often. A point is a quantity at a load. Of intervals that are claimed: filled \
                           where nearly all windows have an interval, else a cross. Band: 93 to 97 %.";

/// Effective contacts and coverage (%) of the points of a case, and their marker.
type Series = (fn(&CaseResults) -> Vec<(f64, f64)>, Marker);

fn claimed(case: &CaseResults) -> Vec<(f64, f64)> {
    case.claimed().map(|((_, coverage), share)| (coverage.contacts, 100.0 * share)).collect()
}

fn claimed_in_part(case: &CaseResults) -> Vec<(f64, f64)> {
    case.claimed_in_part().map(|((_, coverage), share)| (coverage.contacts, 100.0 * share)).collect()
}

fn independent(case: &CaseResults) -> Vec<(f64, f64)> {
    let point = |coverage: &Coverage| Some((coverage.contacts, 100.0 * coverage.independent.coverage()?));
    case.coverages().filter_map(|(_, coverage)| point(coverage)).collect()
}

pub fn coverage(results: &CoverageResults) -> Figure {
    let blocks: [Series; 2] = [(claimed, Marker::Circle), (claimed_in_part, Marker::Cross)];
    let plots = vec![
        plot(results, "Intervals that are claimed", &blocks),
        plot(results, "Asperities taken as independent", &[(independent, Marker::Cross)]),
    ];
    Figure::column("Coverage of 95 % intervals", plots)
}

fn plot(results: &CoverageResults, title: &str, kinds: &[Series]) -> Plot {
    let contacts =
        results.cases.iter().flat_map(CaseResults::coverages).map(|(_, coverage)| coverage.contacts);
    let [least, most] = range(contacts).unwrap_or([1.0, 1e3]);
    let [low, high] = BAND.map(|share| 100.0 * share);
    let series = results
        .cases
        .iter()
        .enumerate()
        .flat_map(|(k, case)| kinds.iter().map(move |(points, marker)| (k, case, points(case), *marker)));
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
    .with(Layer::region_y(low, high, "93 to 97 %"));
    series.into_iter().fold(plot, |plot, (k, case, points, marker)| {
        plot.with(Layer::points(points, marker).coloured(Colour::Series(k)).named(&case.name))
    })
}
