//! Maps of leading causes, and contributions over the skewness.

use asperity::compare::{Cause, ComparedQuantity, Contributions};
use asperity_contact_framework::report::format::{capitalised, number, signed};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::results::{CausesResults, GridPoint, QUANTITIES};
use crate::presentation::cause_colour;
use crate::presentation::quantity_name;

/// The points of equal wavelengths.
fn rows(results: &CausesResults) -> Vec<&[GridPoint]> {
    results.points.chunk_by(|a, b| a.wavelengths == b.wavelengths).collect()
}

/// Nayak's alpha of a row.
fn alpha(row: &[GridPoint]) -> f64 {
    row.iter().map(|point| point.reached.alpha).sum::<f64>() / row.len() as f64
}

/// Edges half way between values.
fn edges(values: &[f64]) -> Vec<f64> {
    let inner = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let (first, last) = (values[0], values[values.len() - 1]);
    let (low, high) = (values[1] - first, last - values[values.len() - 2]);
    std::iter::once(first - 0.5 * low).chain(inner).chain([last + 0.5 * high]).collect()
}

/// What a cell of a map says: its colour and the name of the colour.
type Statement = fn(&Contributions) -> (Colour, &'static str);

/// Heights against radii, whose spread and correlation count together.
pub fn heights_or_radii(results: &CausesResults, load: usize) -> Figure {
    map(results, load, "Heights or radii over skewness and bandwidth", |parts| {
        let heights = parts.of_cause(Cause::Heights);
        if heights.exceeds(&parts.radii) {
            (Colour::Heights, "heights contribute more")
        } else if parts.radii.exceeds(heights) {
            (Colour::Radii, "radii (spread and correlation) contribute more")
        } else {
            (Colour::Neutral, "intervals overlap")
        }
    })
}

/// The leading of the three causes.
pub fn leading_causes(results: &CausesResults, load: usize) -> Figure {
    map(results, load, "Leading causes over skewness and bandwidth", |parts| {
        parts.leading().map_or((Colour::Neutral, "none leads"), |cause| (cause_colour(cause), cause.label()))
    })
}

fn map(results: &CausesResults, load: usize, title: &str, statement: Statement) -> Figure {
    let panels = QUANTITIES.map(|quantity| map_of(results, quantity, load, statement));
    Figure::row(title, panels.into())
}

fn map_of(results: &CausesResults, quantity: ComparedQuantity, load: usize, statement: Statement) -> Plot {
    let rows = rows(results);
    let x = edges(&rows[0].iter().map(|point| point.skewness).collect::<Vec<_>>());
    let y: Vec<f64> = edges(&rows.iter().map(|row| alpha(row).ln()).collect::<Vec<_>>());
    let y: Vec<f64> = y.into_iter().map(f64::exp).collect();
    let axes = (Axis::linear("skewness of the heights"), Axis::log("Nayak's α"));
    let range = |axis: Axis, edges: &[f64]| axis.range(edges[0], edges[edges.len() - 1]);
    let (unit, size) = if quantity == ComparedQuantity::Separation { ("σ", 1.0) } else { ("%", 100.0) };
    let title = format!("{}, difference in {unit}", capitalised(quantity_name(quantity)));
    let mut plot = Plot::new(title, range(axes.0, &x), range(axes.1, &y)).height(300.0).legend(Legend::Below);
    for (row, points) in rows.iter().enumerate() {
        for (column, point) in points.iter().enumerate() {
            let Some(parts) = point.parts(load, quantity) else { continue };
            let (colour, label) = statement(parts);
            let (from, to) = ((x[column], y[row]), (x[column + 1], y[row + 1]));
            let text = signed(size * quantity.reported(parts.gap()));
            plot = plot.with(Layer::tile(from, to, &text).coloured(colour).named(label));
        }
    }
    plot
}

pub fn contributions(results: &CausesResults, quantity: ComparedQuantity, load: usize) -> Figure {
    let panels = rows(results).into_iter().map(|row| lines(row, quantity, load));
    Figure::row("Contributions over the skewness", panels.collect())
}

fn lines(row: &[GridPoint], quantity: ComparedQuantity, load: usize) -> Plot {
    let label = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio)",
    };
    let title = format!("α = {}", number(alpha(row)));
    let x = edges(&row.iter().map(|point| point.skewness).collect::<Vec<_>>());
    let mut plot = Plot::new(
        title,
        Axis::linear("skewness of the heights").range(x[0], x[x.len() - 1]),
        Axis::linear(label),
    )
    .height(240.0)
    .with_zero();
    let divided = || row.iter().filter_map(|point| Some((point.skewness, point.parts(load, quantity)?)));
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
