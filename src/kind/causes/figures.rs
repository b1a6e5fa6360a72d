//! Maps of causes, verdicts and the nearer model over a grid, and contributions over the skewness.

use asperity::compare::{Cause, ComparedQuantity, ModelKind, Verdict};
use asperity_contact_framework::report::format::{capitalised, number};
use asperity_plot::{Axis as PlotAxis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::Axis;
use super::results::{CausesResults, GridPoint, QUANTITIES};
use crate::presentation::{cause_colour, difference_unit, quantity_name};

fn rows(results: &CausesResults) -> Vec<&[GridPoint]> {
    let same = |a: &GridPoint, b: &GridPoint| match results.axis {
        Axis::Bandwidth => a.wavelengths == b.wavelengths,
        Axis::Kurtosis => a.kurtosis == b.kurtosis,
    };
    results.points.chunk_by(same).collect()
}

/// Where a row lies on the second axis: Nayak's alpha, the mean over its surfaces, or the kurtosis.
fn place(results: &CausesResults, row: &[GridPoint]) -> f64 {
    match results.axis {
        Axis::Kurtosis => row[0].kurtosis,
        Axis::Bandwidth => {
            let alphas: Vec<f64> =
                row.iter().filter_map(|point| Some(point.surfaces.as_ref().ok()?.reached.alpha)).collect();
            alphas.iter().sum::<f64>() / alphas.len() as f64
        }
    }
}

/// Edges half way between values.
fn edges(values: &[f64]) -> Vec<f64> {
    let inner = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let (first, last) = (values[0], values[values.len() - 1]);
    let (low, high) = (values[1] - first, last - values[values.len() - 2]);
    std::iter::once(first - 0.5 * low).chain(inner).chain([last + 0.5 * high]).collect()
}

/// What a cell of a map says: its colour, the name of the colour, and its text.
type Cell = (Colour, &'static str, String);

/// A difference that needs no cause.
const WITHIN: (Colour, &str) = (Colour::Reference, "within what is accepted");

/// Heights against radii, whose spread and correlation count together.
pub fn heights_or_radii(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Heights or radii", "difference", |point, quantity| {
        let parts = point.parts(condition, quantity)?;
        let heights = parts.of_cause(Cause::Heights);
        let (colour, name) = if point.unaccepted(condition, quantity).is_none() {
            WITHIN
        } else if heights.exceeds(&parts.radii) {
            (Colour::Heights, "heights contribute more")
        } else if parts.radii.exceeds(heights) {
            (Colour::Radii, "radii (spread and correlation) contribute more")
        } else {
            (Colour::Neutral, "intervals overlap")
        };
        Some((colour, name, reported(quantity, parts.gap())))
    })
}

pub fn leading_causes(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Leading causes", "difference", |point, quantity| {
        let parts = point.parts(condition, quantity)?;
        let none = (Colour::Neutral, "none leads");
        let (colour, name) = match point.unaccepted(condition, quantity) {
            None => WITHIN,
            Some(parts) => parts.leading().map_or(none, |cause| (cause_colour(cause), cause.label())),
        };
        Some((colour, name, reported(quantity, parts.gap())))
    })
}

/// Whether the integral may replace the sum.
pub fn verdicts(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Verdicts", "difference", |point, quantity| {
        let (estimate, verdict) = point.quantity(condition, quantity)?.difference?;
        let text = reported(quantity, estimate.contrast);
        Some(match verdict {
            Some(Verdict::Within | Verdict::VeryLikelyWithin) => (WITHIN.0, WITHIN.1, text),
            Some(Verdict::Beyond | Verdict::VeryLikelyBeyond) => {
                (Colour::Deterministic, "beyond what is accepted", text)
            }
            Some(Verdict::CannotTell) => (Colour::Neutral, "cannot tell", text),
            None => (Colour::Others, "load not admissible", text),
        })
    })
}

/// Which model is nearer to the reference; a cell has the distances of both.
pub fn nearer(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Nearer to boundary elements", "integral | sum less reference", |point, quantity| {
        let at = point.quantity(condition, quantity)?;
        let [statistical, deterministic, _] = at.against?;
        let (colour, name) = match at.nearer_model() {
            Some(ModelKind::Statistical) => (Colour::Statistical, "integral nearer"),
            Some(ModelKind::Deterministic) => (Colour::Deterministic, "sum nearer"),
            None => (Colour::Neutral, "cannot be told, or both as near"),
        };
        let text = [statistical, deterministic].map(|estimate| reported(quantity, estimate.contrast));
        Some((colour, name, text.join(" | ")))
    })
}

/// A contrast in sigma with one decimal, or in percent: what fits into a cell.
fn reported(quantity: ComparedQuantity, contrast: f64) -> String {
    match quantity {
        ComparedQuantity::Separation => format!("{contrast:+.1}").replace('-', "−"),
        _ => format!("{:+.0}", 100.0 * quantity.reported(contrast)).replace('-', "−"),
    }
}

fn map(
    results: &CausesResults,
    title: &str,
    what: &str,
    cell: impl Fn(&GridPoint, ComparedQuantity) -> Option<Cell>,
) -> Figure {
    let panel = |quantity| map_of(results, quantity, what, &|point| cell(point, quantity));
    let over = match results.axis {
        Axis::Bandwidth => "over skewness and bandwidth",
        Axis::Kurtosis => "over skewness and kurtosis",
    };
    Figure::row(format!("{title} {over}"), QUANTITIES.map(panel).into())
}

fn map_of(
    results: &CausesResults,
    quantity: ComparedQuantity,
    what: &str,
    cell: &dyn Fn(&GridPoint) -> Option<Cell>,
) -> Plot {
    let rows = rows(results);
    let x = edges(&rows[0].iter().map(|point| point.skewness).collect::<Vec<_>>());
    let places = rows.iter().map(|row| place(results, row));
    let (y, y_axis) = match results.axis {
        Axis::Bandwidth => {
            let y: Vec<f64> = edges(&places.map(f64::ln).collect::<Vec<_>>());
            (y.into_iter().map(f64::exp).collect(), PlotAxis::log("Nayak's α"))
        }
        Axis::Kurtosis => (edges(&places.collect::<Vec<_>>()), PlotAxis::linear("kurtosis of the heights")),
    };
    let range = |axis: PlotAxis, edges: &[f64]| axis.range(edges[0], edges[edges.len() - 1]);
    let (unit, _) = difference_unit(quantity);
    let title = format!("{}, {what} in {unit}", capitalised(quantity_name(quantity)));
    let x_axis = range(PlotAxis::linear("skewness of the heights"), &x);
    let mut plot = Plot::new(title, x_axis, range(y_axis, &y))
        .height(60.0 * rows.len().max(5) as f64)
        .legend(Legend::Below);
    for (row, points) in rows.iter().enumerate() {
        for (column, point) in points.iter().enumerate() {
            let Some((colour, name, text)) = cell(point) else { continue };
            let (from, to) = ((x[column], y[row]), (x[column + 1], y[row + 1]));
            plot = plot.with(Layer::tile(from, to, &text).coloured(colour).named(name));
        }
    }
    plot
}

pub fn contributions(results: &CausesResults, quantity: ComparedQuantity, condition: [usize; 2]) -> Figure {
    let panels = rows(results).into_iter().map(|row| lines(results, row, quantity, condition));
    Figure::row("Contributions over the skewness", panels.collect())
}

fn lines(
    results: &CausesResults,
    row: &[GridPoint],
    quantity: ComparedQuantity,
    condition: [usize; 2],
) -> Plot {
    let label = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio)",
    };
    let place = number(place(results, row));
    let title = match results.axis {
        Axis::Bandwidth => format!("α = {place}"),
        Axis::Kurtosis => format!("kurtosis {place}"),
    };
    let x = edges(&row.iter().map(|point| point.skewness).collect::<Vec<_>>());
    let mut plot = Plot::new(
        title,
        PlotAxis::linear("skewness of the heights").range(x[0], x[x.len() - 1]),
        PlotAxis::linear(label),
    )
    .height(240.0)
    .with_zero();
    let divided = || row.iter().filter_map(|point| Some((point.skewness, point.parts(condition, quantity)?)));
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle];
    for (cause, marker) in Cause::ALL.into_iter().zip(markers) {
        let points: Vec<(f64, f64)> = divided().map(|(x, parts)| (x, parts.part(cause))).collect();
        let band = divided().filter_map(|(x, parts)| {
            let [low, high] = parts.of_cause(cause).interval()?;
            Some((x, low, high))
        });
        let colour = cause_colour(cause);
        plot = plot
            .with(Layer::band(band).coloured(colour).named(cause.label()))
            .with(Layer::line(points.iter().copied()).coloured(colour).named(cause.label()))
            .with(Layer::points(points, marker).coloured(colour).named(cause.label()));
    }
    let radii = divided().map(|(x, parts)| (x, parts.radii.mean.contrast));
    plot = plot.with(
        Layer::line(radii)
            .coloured(Colour::Radii)
            .dashed(Dash::Dashed)
            .named("spread and correlation together"),
    );
    let gap = divided().map(|(x, parts)| (x, parts.gap()));
    plot.with(Layer::line(gap).coloured(Colour::Sum).thick().named("statistical − deterministic"))
}
