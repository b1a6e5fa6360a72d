//! Density and radii, and the gap with its parts, against the length that is varied.

use asperity::compare::{Cause, ComparedQuantity, Contributions, Estimate};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::super::findings::gap as gap_at;
use super::super::results::{Found, Scale, Series, SurfaceResults, Variation};
use crate::kind::compare::figures::causes::colour;

const MICRO: f64 = 1e6;

/// Margin at both ends of an axis, as a ratio.
const ROOM: f64 = 1.3;

fn axis<'a>(all: impl Iterator<Item = &'a Series>, label: &str) -> Axis {
    let lengths = all.flat_map(|series| series.scales.iter().map(|scale| MICRO * scale.length));
    let [low, high] =
        lengths.fold([f64::INFINITY, 0.0], |[low, high], at| [f64::min(low, at), f64::max(high, at)]);
    Axis::log(label).range(low / ROOM, high * ROOM)
}

/// Density and radii on logarithmic axes.
pub fn asperities(surface: &SurfaceResults) -> Figure {
    const LABEL: &str = "sampling interval or nesting index (µm)";
    let x = || axis(surface.series.iter(), LABEL);
    let plot = |title: &str, label: &str, legend| {
        Plot::new(title, x(), Axis::log(label)).height(360.0).legend(legend)
    };
    let style = |variation| match variation {
        Variation::Interval => ("sampling interval", Dash::Solid),
        Variation::Filter => ("S filter", Dash::Dashed),
    };
    let with = |plot: Plot, colour, marker, name: &str, of: &dyn Fn(&Found) -> f64| {
        surface.series.iter().fold(plot, |plot, series| {
            let (variation, dash) = style(series.variation);
            let points = series.found().map(|(scale, found)| (MICRO * scale.length, of(found)));
            let points: Vec<(f64, f64)> = points.collect();
            let name = format!("{name}{variation}");
            plot.with(Layer::line(points.clone()).coloured(colour).dashed(dash).named(name.clone()))
                .with(Layer::points(points, marker).coloured(colour).named(name))
        })
    };
    let density = plot("Asperity density", "density (1/µm²)", Legend::Below);
    let density =
        with(density, Colour::Series(0), Marker::Circle, "", &|found| found.density / (MICRO * MICRO));
    let radii = plot("Radii", "radius (µm)", Legend::Below);
    let radii = with(radii, Colour::Series(0), Marker::Circle, "mean, ", &|found| {
        MICRO * found.statistics.mean_radius
    });
    let radii = with(radii, Colour::Series(1), Marker::Square, "1/(mean curvature), ", &|found| {
        MICRO * found.statistics.radius_of_mean_curvature
    });
    Figure::row("Asperities against the length that is varied", vec![density, radii])
}

/// The gap in separation and area and its parts; `None` where fewer than two lengths are within the valid range.
pub fn gap(series: &Series, load: usize) -> Option<Figure> {
    let label = match series.variation {
        Variation::Interval => "sampling interval (µm)",
        Variation::Filter => "S nesting index (µm)",
    };
    const GAP: &str = "statistical − deterministic";
    let panel = |quantity: ComparedQuantity, title: &str, y: &str| {
        let at = |(scale, found): (&Scale, &Found)| {
            let parts = found.parts(load, quantity).copied();
            Some((MICRO * scale.length, gap_at(found, load, quantity)?, parts))
        };
        let gaps: Vec<(f64, Estimate, Option<Contributions>)> = series.found().filter_map(at).collect();
        if gaps.len() < 2 {
            return None;
        }
        let lengths: Vec<f64> = gaps.iter().map(|(length, ..)| *length).collect();
        let part = |cause: Cause| -> Vec<f64> {
            gaps.iter().map(|(.., parts)| parts.map_or(f64::NAN, |parts| parts.of(cause))).collect()
        };
        let parts = Cause::ALL.map(part);
        let stacked = Cause::ALL.into_iter().zip(&parts);
        let mut plot = Plot::new(title, axis(std::iter::once(series), label), Axis::linear(y))
            .height(360.0)
            .legend(Legend::Below)
            .with_contributions(
                &lengths,
                stacked.map(|(cause, part)| (cause.label(), colour(cause), &part[..])),
            )
            .with_zero();
        for end in [0, 1] {
            let ends = gaps.iter().filter_map(|(length, gap, _)| Some((*length, gap.interval()?[end])));
            let ends: Vec<(f64, f64)> = ends.collect();
            if !ends.is_empty() {
                let line = Layer::line(ends).coloured(Colour::Sum).dashed(Dash::Dashed).thin();
                plot = plot.with(line.named("95 % interval"));
            }
        }
        let line: Vec<(f64, f64)> = gaps.iter().map(|(length, gap, _)| (*length, gap.contrast)).collect();
        plot = plot
            .with(Layer::line(line.clone()).coloured(Colour::Sum).thick().named(GAP))
            .with(Layer::points(line, Marker::Circle).coloured(Colour::Sum).named(GAP));
        Some(plot)
    };
    let panels = [
        panel(ComparedQuantity::Separation, "Separation", "separation (σ)"),
        panel(ComparedQuantity::Area, "Real contact area", "ln(area ratio of the models)"),
    ];
    let panels: Vec<Plot> = panels.into_iter().flatten().collect();
    (!panels.is_empty()).then(|| Figure::row("Gap between the models and its parts", panels))
}
