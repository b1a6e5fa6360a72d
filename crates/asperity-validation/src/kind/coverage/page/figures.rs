//! Coverage against effective contacts.

use crate::coverage::Coverage;
use crate::kind::coverage::findings::{BAND, LoadCoverage, NEARLY_ALL, RARELY};
use crate::kind::coverage::run::CoverageResults;
use asperity_plot::{Axis, Colour, Figure, Layer, Legend, Marker, Plot};

pub const CAPTION: &str = "Intervals from blocks of a window cover the truth about as often as stated, those that take \
                           asperities as independent less often. A point is a quantity at a load. Of intervals that are claimed: filled \
                           where nearly all windows have an interval, else a cross. Band: 93 to 97 %.";

/// Coverage of a combination, of intervals of one kind.
type Of = fn(&Coverage) -> Option<f64>;

pub fn coverage(results: &CoverageResults) -> Figure {
    let in_nearly_all: Of =
        |coverage| coverage.claimed.coverage().filter(|_| coverage.claimed_share() >= NEARLY_ALL);
    let in_part: Of = |coverage| {
        coverage.claimed.coverage().filter(|_| (RARELY..NEARLY_ALL).contains(&coverage.claimed_share()))
    };
    let independent: Of = |coverage| coverage.independent.coverage();
    let plots = vec![
        plot(
            results,
            "Intervals that are claimed",
            &[(in_nearly_all, Marker::Circle), (in_part, Marker::Cross)],
        ),
        plot(results, "Asperities taken as independent", &[(independent, Marker::Cross)]),
    ];
    Figure::column("Coverage of 95 % intervals", plots)
}

fn plot(results: &CoverageResults, title: &str, kinds: &[(Of, Marker)]) -> Plot {
    let points_of = |loads: &[LoadCoverage], of: Of| -> Vec<(f64, f64)> {
        let each = loads.iter().flat_map(LoadCoverage::each);
        each.filter_map(|(_, coverage)| Some((coverage.contacts, 100.0 * of(coverage)?))).collect()
    };
    let all =
        results.cases.iter().flat_map(|case| kinds.iter().flat_map(|kind| points_of(&case.loads, kind.0)));
    let lowest = all.map(|(_, share)| share).fold(100.0 * BAND[0], f64::min);
    let each = results.cases.iter().flat_map(|case| case.loads.iter().flat_map(LoadCoverage::each));
    let [least, most] = each
        .map(|(_, coverage)| coverage.contacts)
        .fold([f64::INFINITY, 0.0], |[least, most], n| [f64::min(least, n), f64::max(most, n)]);
    let mut plot = Plot::new(
        title,
        Axis::log("effective contacts").range(0.9 * least, 1.1 * most),
        Axis::linear("coverage (%)").range(lowest - 1.0, 100.0),
    )
    .height(260.0)
    .legend(Legend::Below)
    .with(Layer::region_y(100.0 * BAND[0], 100.0 * BAND[1], "93 to 97 %"));
    for (k, case) in results.cases.iter().enumerate() {
        for (of, marker) in kinds {
            let points = points_of(&case.loads, *of);
            if !points.is_empty() {
                plot =
                    plot.with(Layer::points(points, *marker).coloured(Colour::Series(k)).named(&case.name));
            }
        }
    }
    plot
}
