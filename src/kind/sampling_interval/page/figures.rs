//! Density and radii, and the gap with its parts, against the length that is varied.

use asperity::compare::{Cause, ComparedQuantity, Estimate};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::super::findings::gap as gap_at;
use super::super::results::{Found, Series, SurfaceResults, Variation};

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
pub fn asperities(surface: &SurfaceResults) -> String {
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
    let density = plot("asperity density", "density (1/µm²)", Legend::Below);
    let density =
        with(density, Colour::Series(0), Marker::Circle, "", &|found| found.density / (MICRO * MICRO));
    let radii = plot("radii", "radius (µm)", Legend::Below);
    let radii = with(radii, Colour::Series(0), Marker::Circle, "mean, ", &|found| {
        MICRO * found.statistics.mean_radius
    });
    let radii = with(radii, Colour::Series(1), Marker::Square, "1/(mean curvature), ", &|found| {
        MICRO * found.statistics.radius_of_mean_curvature
    });
    Figure::row("Asperities against the length that is varied", vec![density, radii]).svg()
}

/// The gap in separation and area and its parts; `None` where fewer than two lengths are within the valid range.
pub fn gap(series: &Series, load: usize) -> Option<String> {
    let label = match series.variation {
        Variation::Interval => "sampling interval (µm)",
        Variation::Filter => "S nesting index (µm)",
    };
    let panel = |quantity: ComparedQuantity, title: &str, y: &str| {
        let at = |(scale, found): (&_, &Found)| {
            let scale: &super::super::results::Scale = scale;
            Some((MICRO * scale.length, gap_at(found, load, quantity)?))
        };
        let gaps: Vec<(f64, Estimate)> = series.found().filter_map(at).collect();
        if gaps.len() < 2 {
            return None;
        }
        let whole = Colour::Series(6);
        let band = gaps.iter().filter_map(|(x, gap)| gap.interval().map(|[low, high]| (*x, low, high)));
        let line: Vec<(f64, f64)> = gaps.iter().map(|(x, gap)| (*x, gap.contrast)).collect();
        let mut plot = Plot::new(title, axis(std::iter::once(series), label), Axis::linear(y))
            .height(360.0)
            .legend(Legend::Below)
            .with(Layer::at_y(0.0, ""))
            .with(Layer::band(band.collect::<Vec<_>>()).coloured(whole).named("gap"))
            .with(Layer::line(line.clone()).coloured(whole).thick().named("gap"))
            .with(Layer::points(line, Marker::Ring).coloured(whole).named("gap"));
        let styles = [
            (Cause::Heights, Dash::Dashed, Marker::Circle),
            (Cause::Radii, Dash::Dotted, Marker::Triangle),
            (Cause::Correlation, Dash::DashDot, Marker::Square),
        ];
        for (index, (cause, dash, marker)) in styles.into_iter().enumerate() {
            let points = series.found().filter_map(|(scale, found)| {
                gap_at(found, load, quantity)?;
                Some((MICRO * scale.length, found.parts(load, quantity)?.of(cause)))
            });
            let points: Vec<(f64, f64)> = points.collect();
            let colour = Colour::Series(index);
            plot = plot
                .with(Layer::line(points.clone()).coloured(colour).dashed(dash).named(cause.label()))
                .with(Layer::points(points, marker).coloured(colour).named(cause.label()));
        }
        Some(plot)
    };
    let panels = [
        panel(ComparedQuantity::Separation, "separation", "d/σ, statistical − deterministic"),
        panel(ComparedQuantity::Area, "real contact area", "ln(A statistical/A deterministic)"),
    ];
    let panels: Vec<Plot> = panels.into_iter().flatten().collect();
    (!panels.is_empty()).then(|| Figure::row("Gap between the models and its parts", panels).svg())
}
