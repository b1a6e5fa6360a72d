//! Density and radii, and the gap with its parts, against the length that is varied.

use asperity::compare::{Cause, ComparedQuantity};
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::quantity::Asperities;
use super::results::{Gap, QUANTITIES, Scale, ScaleResults, Series, SurfaceResults, Variation, gaps};
use crate::presentation::{cause_colour, quantity_name};

const MICRO: f64 = 1e6;
const HEIGHT: f64 = 360.0;

fn axis<'a>(all: impl IntoIterator<Item = &'a Series>, label: &str) -> Axis {
    /// Margin at both ends of an axis, as a ratio.
    const MARGIN: f64 = 1.3;
    let lengths = all.into_iter().flat_map(|series| series.scales.iter().map(|scale| MICRO * scale.length));
    let [low, high] =
        lengths.fold([f64::INFINITY, 0.0], |[low, high], at| [f64::min(low, at), f64::max(high, at)]);
    Axis::log(label).range(low / MARGIN, high * MARGIN)
}

/// Density and radii on logarithmic axes.
pub fn asperities(surface: &SurfaceResults) -> Figure {
    let plot = |title: &str, label: &str| {
        let lengths = axis(&surface.series, "sampling interval or nesting index (µm)");
        Plot::new(title, lengths, Axis::log(label)).height(HEIGHT).legend(Legend::Below)
    };
    let with = |plot: Plot, (colour, marker, name), value: fn(&Asperities) -> f64| {
        surface.series.iter().fold(plot, |plot, series| {
            let (variation, dash) = match series.variation {
                Variation::Interval => ("sampling interval", Dash::Solid),
                Variation::Filter => ("S filter", Dash::Dashed),
            };
            let point = |(scale, results): (&Scale, &ScaleResults)| {
                (MICRO * scale.length, value(&results.asperities))
            };
            let points: Vec<(f64, f64)> = series.results().map(point).collect();
            let name = format!("{name}{variation}");
            plot.with(Layer::line(points.clone()).coloured(colour).dashed(dash).named(name.clone()))
                .with(Layer::points(points, marker).coloured(colour).named(name))
        })
    };
    let mean = (Colour::Series(0), Marker::Circle, "mean, ");
    let curvature = (Colour::Series(1), Marker::Square, "1/(mean curvature), ");
    let density = (Colour::Series(0), Marker::Circle, "");
    let density =
        with(plot("Asperity density", "density (1/µm²)"), density, |all| all.density / (MICRO * MICRO));
    let radii = with(plot("Radii", "radius (µm)"), mean, |all| MICRO * all.statistics.mean_radius);
    let radii = with(radii, curvature, |all| MICRO * all.statistics.radius_of_mean_curvature);
    Figure::row("Asperities against the length that is varied", vec![density, radii])
}

/// The gap in separation and area and its parts; `None` where fewer than two lengths are admissible.
pub fn gap(series: &Series, load: usize) -> Option<Figure> {
    let panels: Vec<Plot> =
        QUANTITIES.into_iter().filter_map(|quantity| panel(series, load, quantity)).collect();
    (!panels.is_empty()).then(|| Figure::row("Gap between the models and its parts", panels))
}

fn panel(series: &Series, load: usize, quantity: ComparedQuantity) -> Option<Plot> {
    const GAP: &str = "statistical − deterministic";
    let gaps = gaps(series, load, quantity);
    if gaps.len() < 2 {
        return None;
    }
    let over_length = |y: &dyn Fn(&Gap) -> Option<f64>| {
        gaps.iter().filter_map(|gap| Some((MICRO * gap.length, y(gap)?))).collect::<Vec<(f64, f64)>>()
    };
    let lengths: Vec<f64> = gaps.iter().map(|gap| MICRO * gap.length).collect();
    let parts = Cause::ALL.map(|cause| {
        gaps.iter().map(|gap| gap.parts.map_or(f64::NAN, |parts| parts.part(cause))).collect::<Vec<f64>>()
    });
    let stacked = Cause::ALL.into_iter().zip(&parts);
    let stacked = stacked.map(|(cause, part)| (cause.label(), cause_colour(cause), &part[..]));
    let x = axis([series], &format!("{} (µm)", series.variation.label()));
    let y = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio of the models)",
    };
    let mut plot = Plot::new(capitalised(quantity_name(quantity)), x, Axis::linear(y))
        .height(HEIGHT)
        .legend(Legend::Below)
        .with_contributions(&lengths, stacked)
        .with_zero();
    for end in [0, 1] {
        let ends = over_length(&|gap| Some(gap.difference.interval()?[end]));
        if !ends.is_empty() {
            let line = Layer::line(ends).coloured(Colour::Sum).dashed(Dash::Dashed).thin();
            plot = plot.with(line.named("95 % interval"));
        }
    }
    let line = over_length(&|gap| Some(gap.difference.contrast));
    Some(
        plot.with(Layer::line(line.clone()).coloured(Colour::Sum).thick().named(GAP))
            .with(Layer::points(line, Marker::Circle).coloured(Colour::Sum).named(GAP)),
    )
}
