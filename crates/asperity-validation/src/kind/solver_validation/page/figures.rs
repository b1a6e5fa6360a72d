//! Figures of the comparisons.

use crate::kind::solver_validation::findings::SolverFindings;
use crate::solver::ensemble::{EnsembleFindings, EnsemblePoint, Mean, bush_gibson_thomas, persson};
use crate::solver::published::{PUBLISHED, PublishedArea, published};
use crate::solver::work::WorkPoint;
use crate::solver::{LAYERED_CASES, Measured, Problem, Profile, Quantity};
use asperity::analytical;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

/// Standard errors of a band: 95 % of many surfaces.
const BAND: f64 = 2.0;

const PUBLISHED_COLOUR: Colour = Colour::Series(6);

fn of_problem(
    measured: &[Measured],
    problem: Problem,
    quantity: Quantity,
) -> impl Iterator<Item = &Measured> {
    measured.iter().filter(move |one| (one.problem, one.quantity) == (problem, quantity))
}

/// The largest error of each resolution.
fn largest(measured: &[Measured], problem: Problem, quantity: Quantity) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for one in of_problem(measured, problem, quantity) {
        let (place, error) = (one.points as f64, one.error.abs());
        match points.last_mut().filter(|last| last.0 == place) {
            Some(last) => last.1 = last.1.max(error),
            None => points.push((place, error)),
        }
    }
    points
}

fn with_series(plot: Plot, points: Vec<(f64, f64)>, colour: Colour, marker: Marker, name: &str) -> Plot {
    plot.with(Layer::line(points.clone()).coloured(colour).named(name))
        .with(Layer::points(points, marker).coloured(colour).named(name))
}

/// Errors against resolution, with lines of slopes -1 and -2.
fn convergence(
    measured: &[Measured],
    problem: Problem,
    axis: &str,
    quantities: &[(Quantity, Marker)],
) -> Plot {
    let mut plot = Plot::new("Largest errors", Axis::log(axis), Axis::log("error")).legend(Legend::Below);
    for (k, (quantity, marker)) in quantities.iter().enumerate() {
        let points = largest(measured, problem, *quantity);
        let first = points.first().copied();
        plot = with_series(plot, points, Colour::Series(k), *marker, quantity.words());
        let slope = match quantity {
            Quantity::Indentation | Quantity::MeanGap => -2.0,
            Quantity::Pressures => -1.0,
            _ => continue,
        };
        if let Some((x, y)) = first {
            plot = plot.with(Layer::slope((x, 0.6 * y), slope, format!("order {}", -slope)));
        }
    }
    plot
}

fn profile_plot(title: &str, x: &str, y: &str, profiles: &[Profile]) -> Plot {
    let mut plot = Plot::new(title, Axis::linear(x), Axis::linear(y)).legend(Legend::Below);
    for (k, profile) in profiles.iter().enumerate() {
        plot = plot
            .with(Layer::line(profile.exact.iter().copied()).coloured(Colour::Neutral).named("exact"))
            .with(
                Layer::points(profile.found.iter().copied(), Marker::Circle)
                    .coloured(Colour::Series(k))
                    .named(&profile.case),
            );
    }
    plot
}

/// Hertz: pressures and convergence.
pub fn hertz(measured: &[Measured], profile: &Profile) -> Figure {
    let pressures = profile_plot(
        "Pressures on the coarsest grid",
        "distance from the axis r/a",
        "p/p₀",
        std::slice::from_ref(profile),
    );
    let quantities = [
        (Quantity::Indentation, Marker::Circle),
        (Quantity::RawArea, Marker::Square),
        (Quantity::Area, Marker::Triangle),
        (Quantity::PeakPressure, Marker::Cross),
        (Quantity::Pressures, Marker::Ring),
    ];
    let errors = convergence(measured, Problem::Hertz, "pixels per contact radius", &quantities);
    Figure::row("Hertz", vec![pressures, errors])
}

/// A wave: pressures, width and convergence.
pub fn sinusoid(measured: &[Measured], profiles: &[Profile]) -> Figure {
    let pressures = profile_plot("Pressures", "place x/λ", "p/(2 p*)", profiles);
    let quantities = [
        (Quantity::MeanGap, Marker::Circle),
        (Quantity::RawArea, Marker::Square),
        (Quantity::Area, Marker::Triangle),
        (Quantity::Pressures, Marker::Ring),
    ];
    let errors = convergence(measured, Problem::Sinusoid, "points per wavelength", &quantities);
    Figure::row("Wave", vec![pressures, errors])
}

/// Spheres on a layer: errors of the indentation, by body and contact radius.
pub fn layered(measured: &[Measured]) -> Figure {
    let all = || of_problem(measured, Problem::LayeredSphere, Quantity::Indentation);
    let shown = all().map(|one| one.error.abs()).chain(all().filter_map(|one| one.allowed));
    let [least, most] =
        shown.fold([f64::INFINITY, 0.0], |[least, most], error| [error.min(least), error.max(most)]);
    let mut plot = Plot::new(
        "",
        Axis::log("contact radius over layer thickness a/t"),
        Axis::log("relative error of the indentation").range(0.5 * least, 2.0 * most),
    )
    .legend(Legend::Below);
    let mut bodies: Vec<String> = LAYERED_CASES.iter().map(|case| case.bodies()).collect();
    bodies.dedup();
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Cross];
    for (k, (bodies, marker)) in bodies.iter().zip(markers.into_iter().cycle()).enumerate() {
        let of_bodies = LAYERED_CASES.iter().filter(|case| case.bodies() == *bodies);
        let points: Vec<(f64, f64)> = of_bodies
            .filter_map(|case| {
                let name = case.name();
                all().find(|one| one.case == name).map(|one| (case.contact_radius, one.error.abs()))
            })
            .collect();
        plot = with_series(plot, points, Colour::Series(k), marker, &format!("E = {bodies}"));
    }
    if let Some(allowed) = all().find_map(|one| one.allowed) {
        plot = plot.with(Layer::at_y(allowed, "allowed"));
    }
    plot.into()
}

/// Place and band of values.
type BandPoints = Vec<(f64, f64, f64)>;

/// Relative differences from the published areas in percent.
fn percent_of(areas: impl Iterator<Item = (f64, Mean)>) -> (Vec<(f64, f64)>, BandPoints) {
    let (mut line, mut band) = (Vec::new(), Vec::new());
    for (pressure, area) in areas {
        let Some(published) = published(pressure) else { continue };
        let percent = |value: f64| 100.0 * (value / published.area - 1.0);
        line.push((pressure, percent(area.mean)));
        let width = BAND * area.error;
        band.push((pressure, percent(area.mean - width), percent(area.mean + width)));
    }
    (line, band)
}

fn grids(found: &EnsembleFindings) -> Vec<usize> {
    let mut grids: Vec<usize> = found.points.iter().map(|point| point.points).collect();
    grids.dedup();
    grids
}

fn on_grid(found: &EnsembleFindings, grid: usize) -> impl Iterator<Item = &EnsemblePoint> {
    found.points.iter().filter(move |point| point.points == grid)
}

/// Published areas at the pressures of the ensemble's range.
fn published_within(found: &EnsembleFindings) -> impl Iterator<Item = &'static PublishedArea> {
    let pressures = found.points.iter().map(|point| point.pressure);
    let [least, most] = pressures.fold([f64::INFINITY, 0.0], |[least, most], p| [p.min(least), p.max(most)]);
    PUBLISHED.iter().filter(move |row| (least..=most).contains(&row.pressure))
}

/// Areas of the ensemble, and their differences from the published ones.
pub fn ensemble(found: &EnsembleFindings) -> Figure {
    let grids = grids(found);
    let mut areas = Plot::new("", Axis::log("pressure p/E*"), Axis::log("area ratio A/A₀"))
        .legend(Legend::Below)
        .height(300.0);
    if let Some(&finest) = grids.last() {
        let line = on_grid(found, finest).map(|point| (point.pressure, point.area.mean));
        areas = areas.with(
            Layer::line(line).coloured(Colour::Reference).named("boundary elements, corrected, finest grid"),
        );
    }
    let listed = published_within(found).map(|row| (row.pressure, row.area));
    areas = areas.with(Layer::points(listed, Marker::Ring).coloured(PUBLISHED_COLOUR).named("published"));
    let mut differences =
        Plot::new("", Axis::log("pressure p/E*"), Axis::linear("difference from published area (%)"))
            .legend(Legend::Below)
            .with_zero();
    for (k, &grid) in grids.iter().enumerate() {
        let colour = Colour::Ordered { index: grids.len() - 1 - k, of: grids.len() + 1 };
        let (raw, _) = percent_of(on_grid(found, grid).map(|point| (point.pressure, point.raw_area)));
        let (corrected, _) = percent_of(on_grid(found, grid).map(|point| (point.pressure, point.area)));
        let name = |kind: &str| format!("{kind}, {grid} points");
        differences = differences
            .with(Layer::line(raw).coloured(colour).dashed(Dash::Dashed).named(name("raw")))
            .with(Layer::line(corrected).coloured(colour).dashed(Dash::Dotted).named(name("corrected")));
    }
    if !found.extrapolated.is_empty() {
        let (line, band) = percent_of(found.extrapolated.iter().map(|at| (at.pressure, at.raw_area)));
        differences = differences
            .with(
                Layer::band(band)
                    .coloured(Colour::Deterministic)
                    .named("extrapolated, with two standard errors"),
            )
            .with(
                Layer::line(line)
                    .coloured(Colour::Deterministic)
                    .thick()
                    .named("extrapolated, with two standard errors"),
            );
    }
    let earlier = published_within(found)
        .filter_map(|row| Some((row.pressure, 100.0 * (row.earlier? / row.area - 1.0))));
    differences = differences.with(
        Layer::points(earlier, Marker::Cross).coloured(PUBLISHED_COLOUR).named("earlier published file"),
    );
    Figure::column("Published ensemble", vec![areas, differences])
}

/// kappa against load, with the theories.
pub fn kappa(found: &EnsembleFindings, findings: &SolverFindings) -> Figure {
    /// Points of Persson's curve.
    const DENSE: usize = 100;
    let reduced = |pressure: f64| pressure / found.gradient;
    let mut plot = Plot::new(
        "",
        Axis::log("reduced pressure p/(E* g)"),
        Axis::linear("κ = (A/A₀) E* g/p").range(0.0, 3.2),
    )
    .legend(Legend::Below);
    let pressures = found.points.iter().map(|point| reduced(point.pressure));
    let [least, most] = pressures.fold([f64::INFINITY, 0.0], |[least, most], p| [p.min(least), p.max(most)]);
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
    plot = plot
        .with(Layer::line(curve).coloured(Colour::Neutral).dashed(Dash::DashDot).named("Persson, all loads"));
    let band = findings.kappa.iter().map(|(at, kappa)| {
        let width = BAND * kappa.error;
        (*at, kappa.mean - width, kappa.mean + width)
    });
    let line = findings.kappa.iter().map(|(at, kappa)| (*at, kappa.mean));
    let name = "boundary elements, extrapolated, with two standard errors";
    let of = |area: f64, pressure: f64| (reduced(pressure), area / reduced(pressure));
    let listed = published_within(found).map(|row| of(row.area, row.pressure));
    let earlier = published_within(found).filter_map(|row| Some(of(row.earlier?, row.pressure)));
    plot.with(Layer::band(band).coloured(Colour::Reference).named(name))
        .with(Layer::line(line).coloured(Colour::Reference).named(name))
        .with(Layer::points(listed, Marker::Ring).coloured(PUBLISHED_COLOUR).named("published"))
        .with(
            Layer::points(earlier, Marker::Cross).coloured(PUBLISHED_COLOUR).named("earlier published file"),
        )
        .into()
}

/// Convolutions against points.
pub fn work(points: &[WorkPoint]) -> Figure {
    let mut plot =
        Plot::new("", Axis::log("points along a side"), Axis::log("convolutions on the finest grid"))
            .legend(Legend::Below)
            .height(300.0);
    let mut pressures: Vec<f64> = points.iter().map(|point| point.pressure).collect();
    pressures.sort_by(f64::total_cmp);
    pressures.dedup();
    for (k, &pressure) in pressures.iter().enumerate() {
        let of_load = points.iter().filter(|point| point.pressure == pressure);
        let line = of_load.map(|point| (point.points as f64, point.convolutions as f64)).collect();
        let colour = Colour::Ordered { index: k, of: pressures.len() };
        plot = with_series(plot, line, colour, Marker::Circle, &format!("p/(E* g) = {pressure}"));
    }
    plot.into()
}
