//! Figures of the comparisons.

use super::results::{ErrorRow, GRID_QUANTITIES, SolverResults, convolutions, errors, loads};
use crate::solver::ensemble::{EnsemblePoint, EnsembleResults, Mean, bush_gibson_thomas, persson};
use crate::solver::grid::{GridCase, GridPoint, MAY_EXCEED};
use crate::solver::published::{ENSEMBLE, PUBLISHED, PublishedArea, published};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity, LAYERED_CASES, Problem, Profile};
use asperity::analytical;
use asperity::numeric::extremes;
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

/// Standard errors of a band: 95 % of many surfaces.
const BAND: f64 = 2.0;

const PUBLISHED_COLOUR: Colour = Colour::Series(6);

fn plot(title: &str, x: Axis, y: Axis) -> Plot {
    Plot::new(title, x, y).legend(Legend::Below)
}

fn with_series(plot: Plot, points: Vec<(f64, f64)>, colour: Colour, marker: Marker, name: &str) -> Plot {
    plot.with(Layer::line(points.clone()).coloured(colour).named(name))
        .with(Layer::points(points, marker).coloured(colour).named(name))
}

/// The largest errors of a problem against resolution, with lines of slopes -1 and -2.
fn convergence(results: &SolverResults, problem: Problem, resolution: &str) -> Plot {
    /// With the order of convergence whose line is drawn.
    const QUANTITIES: [(BenchmarkQuantity, Marker, Option<f64>); 6] = [
        (BenchmarkQuantity::Indentation, Marker::Circle, Some(2.0)),
        (BenchmarkQuantity::RawArea, Marker::Square, None),
        (BenchmarkQuantity::Area, Marker::Triangle, None),
        (BenchmarkQuantity::PeakPressure, Marker::Cross, None),
        (BenchmarkQuantity::Pressures, Marker::Ring, Some(1.0)),
        (BenchmarkQuantity::MeanGap, Marker::Circle, Some(2.0)),
    ];
    let mut plot = plot("Largest errors", Axis::log(resolution), Axis::log("error"));
    for (k, (quantity, marker, order)) in QUANTITIES.into_iter().enumerate() {
        let errors = errors(&results.benchmarks).filter(|errors| errors.problem() == problem);
        let point = |errors: ErrorRow| Some((errors.points() as f64, errors.error(quantity)?.abs()));
        let points: Vec<(f64, f64)> = errors.filter_map(point).collect();
        let Some(&(x, y)) = points.first() else { continue };
        plot = with_series(plot, points, Colour::Series(k), marker, quantity.words());
        if let Some(order) = order {
            plot = plot.with(Layer::slope((x, 0.6 * y), -order, format!("order {order}")));
        }
    }
    plot
}

fn pressures(title: &str, x: &str, y: &str, profiles: &[Profile]) -> Plot {
    let plot = plot(title, Axis::linear(x), Axis::linear(y));
    profiles.iter().enumerate().fold(plot, |plot, (k, Profile { case, computed, exact })| {
        let computed = Layer::points(computed.iter().copied(), Marker::Circle);
        plot.with(Layer::line(exact.iter().copied()).coloured(Colour::Neutral).named("exact"))
            .with(computed.coloured(Colour::Series(k)).named(case))
    })
}

/// Hertz: pressures and convergence.
pub fn hertz(results: &SolverResults) -> Figure {
    let (title, x) = ("Pressures on the coarsest grid", "distance from the axis r/a");
    let pressures = pressures(title, x, "p/p₀", results.hertz_profile.as_slice());
    let errors = convergence(results, Problem::Hertz, "pixels per contact radius");
    Figure::row("Hertz", vec![pressures, errors])
}

/// A wave: pressures, width and convergence.
pub fn sinusoid(results: &SolverResults) -> Figure {
    let pressures = pressures("Pressures", "place x/λ", "p/(2 p*)", &results.wave_profiles);
    let errors = convergence(results, Problem::Sinusoid, "points per wavelength");
    Figure::row("Wave", vec![pressures, errors])
}

/// Spheres on a layer: errors of the indentation, by body and contact radius.
pub fn layered(results: &SolverResults) -> Figure {
    let is_it = |benchmark: &&Benchmark| {
        (benchmark.problem, benchmark.quantity) == (Problem::LayeredSphere, BenchmarkQuantity::Indentation)
    };
    let all: Vec<&Benchmark> = results.benchmarks.iter().filter(is_it).collect();
    let errors =
        all.iter().flat_map(|benchmark| benchmark.allowed.into_iter().chain([benchmark.error.abs()]));
    let [least, most] = range(errors);
    let mut plot = plot(
        "",
        Axis::log("contact radius over layer thickness a/t"),
        Axis::log("relative error of the indentation").range(0.5 * least, 2.0 * most),
    );
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Cross];
    let bodies = LAYERED_CASES.chunk_by(|a, b| a.bodies() == b.bodies());
    for (k, (cases, marker)) in bodies.zip(markers.into_iter().cycle()).enumerate() {
        let points = cases.iter().filter_map(|case| {
            let benchmark = all.iter().find(|benchmark| benchmark.case == case.name())?;
            Some((case.contact_radius, benchmark.error.abs()))
        });
        let name = format!("E = {}", cases[0].bodies());
        plot = with_series(plot, points.collect(), Colour::Series(k), marker, &name);
    }
    let allowed = all.iter().find_map(|benchmark| benchmark.allowed);
    allowed.into_iter().fold(plot, |plot, allowed| plot.with(Layer::at_y(allowed, "allowed"))).into()
}

/// The least and the largest of some values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    extremes(values).unwrap_or([f64::INFINITY, 0.0])
}

/// A curve of means.
fn mean_line(means: impl Iterator<Item = (f64, Mean)>) -> Layer {
    Layer::line(means.map(|(x, mean)| (x, mean.mean)))
}

/// The band of their errors.
fn error_band(means: impl Iterator<Item = (f64, Mean)>) -> Layer {
    Layer::band(means.map(|(x, Mean { mean, error })| (x, mean - BAND * error, mean + BAND * error)))
}

/// An area relative to the published one, in percent.
fn percent(pressure: f64, area: Mean) -> Option<(f64, Mean)> {
    let published = published(pressure)?.area;
    let mean = 100.0 * (area.mean / published - 1.0);
    Some((pressure, Mean { mean, error: 100.0 * area.error / published }))
}

/// Published areas at the pressures of the ensemble's range.
fn published_within(ensemble: &EnsembleResults) -> impl Iterator<Item = &'static PublishedArea> {
    let [least, most] = range(ensemble.points.iter().map(|point| point.pressure));
    PUBLISHED.iter().filter(move |published| (least..=most).contains(&published.pressure))
}

/// Areas of the publication as points.
fn published_points(points: impl Iterator<Item = (f64, f64)>) -> Layer {
    Layer::points(points, Marker::Ring).coloured(PUBLISHED_COLOUR).named("published")
}

/// Those of the earlier file.
fn earlier_points(points: impl Iterator<Item = (f64, f64)>) -> Layer {
    Layer::points(points, Marker::Cross).coloured(PUBLISHED_COLOUR).named("earlier published file")
}

/// Areas of the ensemble, and their differences from the published ones.
pub fn ensemble(ensemble: &EnsembleResults) -> Figure {
    let mut areas = plot("", Axis::log("pressure p/E*"), Axis::log("area ratio A/A₀")).height(300.0);
    if let Some(finest) = ensemble.grids().next_back() {
        let line = mean_line(finest.iter().map(|point| (point.pressure, point.area)));
        areas =
            areas.with(line.coloured(Colour::Reference).named("boundary elements, corrected, finest grid"));
    }
    let listed = published_within(ensemble).map(|row| (row.pressure, row.area));
    areas = areas.with(published_points(listed));
    let mut differences =
        plot("", Axis::log("pressure p/E*"), Axis::linear("difference from published area (%)")).with_zero();
    let of = ensemble.grids().count();
    for (k, points) in ensemble.grids().enumerate() {
        let colour = Colour::Ordered { index: of - 1 - k, of: of + 1 };
        let line = |kind: &str, dash: Dash, area: fn(&EnsemblePoint) -> Mean| {
            let areas = points.iter().filter_map(|point| percent(point.pressure, area(point)));
            let name = format!("{kind}, {} points", points[0].points.unwrap_or_default());
            mean_line(areas).coloured(colour).dashed(dash).named(name)
        };
        differences = differences.with(line("raw", Dash::Dashed, |point| point.raw_area));
        differences = differences.with(line("corrected", Dash::Dotted, |point| point.area));
    }
    if !ensemble.extrapolated.is_empty() {
        let areas = ensemble.extrapolated.iter();
        let areas = areas.filter_map(|point| percent(point.pressure, point.raw_area));
        let layers = [error_band(areas.clone()), mean_line(areas).thick()];
        for layer in layers.map(|layer| layer.coloured(Colour::Deterministic)) {
            differences = differences.with(layer.named("extrapolated, with two standard errors"));
        }
    }
    let earlier = published_within(ensemble)
        .filter_map(|row| Some((row.pressure, 100.0 * (row.earlier? / row.area - 1.0))));
    Figure::column("Published ensemble", vec![areas, differences.with(earlier_points(earlier))])
}

/// kappa against load, with the theories.
pub fn kappa(ensemble: &EnsembleResults) -> Figure {
    /// Points of Persson's curve.
    const DENSE: usize = 100;
    let mut plot =
        plot("", Axis::log("reduced pressure p/(E* g)"), Axis::linear("κ = (A/A₀) E* g/p").range(0.0, 3.2));
    let [least, most] = range(ensemble.points.iter().map(EnsemblePoint::reduced_pressure));
    let limits = [
        (bush_gibson_thomas(), Dash::Dashed, "Bush, Gibson and Thomas, light load: (2π)^½"),
        (persson(), Dash::Dotted, "Persson, light load: (8/π)^½"),
    ];
    for (limit, dash, name) in limits {
        let line = Layer::line([(least, limit), (most, limit)]);
        plot = plot.with(line.coloured(Colour::Neutral).dashed(dash).named(name));
    }
    let curve = (0..=DENSE).map(|k| {
        let pressure = least * (most / least).powf(k as f64 / DENSE as f64);
        (pressure, analytical::persson(pressure, 1.0) / pressure)
    });
    let curve = Layer::line(curve).coloured(Colour::Neutral).dashed(Dash::DashDot);
    let points = ensemble.extrapolated.iter().map(|point| (point.reduced_pressure(), point.kappa()));
    let layers = [error_band(points.clone()), mean_line(points)];
    plot = plot.with(curve.named("Persson, all loads"));
    for layer in layers.map(|layer| layer.coloured(Colour::Reference)) {
        plot = plot.with(layer.named("boundary elements, extrapolated, with two standard errors"));
    }
    let point = |row: &PublishedArea, area: f64| {
        let reduced = row.pressure / ENSEMBLE.gradient;
        (reduced, area / reduced)
    };
    let listed = published_within(ensemble).map(|row| point(row, row.area));
    let earlier = published_within(ensemble).filter_map(|row| Some(point(row, row.earlier?)));
    plot.with(published_points(listed)).with(earlier_points(earlier)).into()
}

/// Convolutions against points.
pub fn work(work: &[WorkPoint]) -> Figure {
    let loads = loads(work);
    let y = Axis::log("convolutions on the finest grid");
    let plot = plot("", Axis::log("points along a side"), y).height(300.0);
    let with_load = |plot: Plot, (k, &load): (usize, &f64)| {
        let colour = Colour::Ordered { index: k, of: loads.len() };
        let line = convolutions(work, load).collect();
        with_series(plot, line, colour, Marker::Circle, &format!("p/(E* g) = {load}"))
    };
    loads.iter().enumerate().fold(plot, with_load).into()
}

/// The share of the contacts whose errors by the grid exceed their bounds, against points per shortest wave on the coarser axis.
pub fn grid(grid: &[GridPoint]) -> Figure {
    const MARKERS: [Marker; 5] =
        [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Cross, Marker::Ring];
    let panel = |(quantity, name): (usize, &str)| {
        let points = Axis::log("points per shortest wave").range(1.6, 10.0);
        let plot = plot(&capitalised(name), points, Axis::linear("errors beyond their bound (%)"));
        let plot = plot.height(300.0).with_zero().with(Layer::at_y(100.0 * MAY_EXCEED, "allowed of all"));
        GridCase::ALL.into_iter().zip(MARKERS).enumerate().fold(plot, |plot, (k, (case, marker))| {
            let place = |point: &GridPoint| {
                let share = point.checks[quantity].exceeded as f64 / point.contacts as f64;
                (point.points.into_iter().fold(usize::MAX, usize::min) as f64, 100.0 * share)
            };
            let places = grid.iter().filter(|point| point.case == case).map(place);
            plot.with(Layer::points(places, marker).coloured(Colour::Series(k)).named(case.name()))
        })
    };
    let panels = GRID_QUANTITIES.into_iter().enumerate().map(panel);
    Figure::row("Errors by the grid beyond their bounds", panels.collect())
}
