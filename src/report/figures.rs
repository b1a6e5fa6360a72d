//! The pictures of a comparison.

use super::plot::{Axis, Colour, Dash, Figure, Layer, Plot};
use crate::compare::{Comparison, CurvePoint, Kind, Pair, Pairing};
use crate::experiment::results::SurfaceResults;
use crate::model::INTERACTION;

/// How many standard errors a band shows: 95 % of all draws lie within.
const BAND: f64 = 1.96;

/// The load axis that all pictures of one comparison share, so that they can be laid side by side.
fn load_axis(comparison: &Comparison, modulus: f64) -> Axis {
    /// Room at both ends, in ratios.
    const ROOM: f64 = 1.3;
    let loads = || {
        let all = comparison.curves.iter().map(|point| point.response.pressure.total() / modulus);
        all.filter(|&load| load > 0.0)
    };
    let (low, high) = (loads().fold(f64::INFINITY, f64::min), loads().fold(0.0, f64::max));
    Axis::log("load ratio P/(A_nom E*)").range(low / ROOM, high * ROOM)
}

fn colour(kind: Kind) -> Colour {
    match kind {
        Kind::Statistical => Colour::Statistical,
        Kind::Deterministic => Colour::Deterministic,
    }
}

/// The points of one model that carry load, by growing load.
fn curve(comparison: &Comparison, kind: Kind) -> Vec<&CurvePoint> {
    let mut points: Vec<&CurvePoint> = comparison
        .curves
        .iter()
        .filter(|point| point.kind == kind && point.response.pressure.total() > 0.0)
        .collect();
    points.sort_by(|a, b| a.response.pressure.total().total_cmp(&b.response.pressure.total()));
    points
}

/// Pairs at equal load, by growing load.
fn at_equal_load(comparison: &Comparison) -> Vec<&Pair> {
    let mut pairs: Vec<&Pair> =
        comparison.pairs.iter().filter(|pair| pair.pairing == Pairing::Load).collect();
    pairs.sort_by(|a, b| a.target.total_cmp(&b.target));
    pairs
}

/// d/sigma against load (Pasaribu and Schipper 2005, Fig. 4), the difference at equal load below.
pub fn separation(comparison: &Comparison, modulus: f64, sigma: f64) -> String {
    let axis = || load_axis(comparison, modulus);
    let mut plot = Plot::new("Separation against load", axis(), Axis::linear("separation d/σ"));
    for kind in [Kind::Deterministic, Kind::Statistical] {
        let points = curve(comparison, kind);
        let load = |point: &CurvePoint| point.response.pressure.total() / modulus;
        let band = points.iter().filter_map(|point| {
            let response = &point.response;
            let half = BAND * response.sampling?.pressure / (response.stiffness * sigma);
            let d = response.separation_over_sigma;
            Some((load(point), d - half, d + half))
        });
        plot = plot.with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(kind)));
        let line = points.iter().map(|point| (load(point), point.response.separation_over_sigma));
        plot = plot.with(model_line(kind, line));
    }
    let pairs = at_equal_load(comparison);
    if pairs.is_empty() {
        return plot.svg();
    }
    let difference =
        |pair: &Pair| pair.statistical.separation_over_sigma - pair.deterministic.separation_over_sigma;
    let band = pairs.iter().filter_map(|pair| {
        let response = &pair.deterministic;
        let half = BAND * response.sampling?.pressure / (response.stiffness * sigma);
        Some((pair.target / modulus, difference(pair) - half, difference(pair) + half))
    });
    let line = pairs.iter().map(|pair| (pair.target / modulus, difference(pair)));
    let below = Plot::new("", axis(), Axis::linear("difference in d/σ"))
        .height(170.0)
        .with(Layer::at_y(0.0, ""))
        .with(Layer::band(band.collect::<Vec<_>>()).coloured(Colour::Series(2)))
        .with(
            Layer::line(line.collect::<Vec<_>>())
                .coloured(Colour::Series(2))
                .named("statistical − deterministic at equal load"),
        );
    Figure::column("Separation against load, and the difference at equal load", vec![plot, below]).svg()
}

fn model_line(kind: Kind, points: impl Iterator<Item = (f64, f64)>) -> Layer {
    let dash = if kind == Kind::Statistical { Dash::Dashed } else { Dash::Solid };
    Layer::line(points.collect::<Vec<_>>()).coloured(colour(kind)).dashed(dash).named(kind.name())
}

/// Real over nominal area against load.
pub fn area(comparison: &Comparison, modulus: f64) -> String {
    let mut plot = Plot::new(
        "Real contact area against load",
        load_axis(comparison, modulus),
        Axis::log("area ratio A/A_nom"),
    )
    .with(Layer::region_y(INTERACTION, f64::INFINITY, "asperities interact: A/A_nom > 0.05"));
    for kind in [Kind::Deterministic, Kind::Statistical] {
        let points = curve(comparison, kind);
        let load = |point: &CurvePoint| point.response.pressure.total() / modulus;
        let band = points.iter().filter_map(|point| {
            let half = BAND * point.response.sampling?.area_ratio;
            let area = point.response.area_ratio.total();
            Some((load(point), area - half, area + half))
        });
        plot = plot.with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(kind)));
        plot = plot.with(model_line(kind, points.iter().map(|p| (load(p), p.response.area_ratio.total()))));
    }
    plot.svg()
}

/// Each regime's share of the load, one panel a model.
pub fn regimes(comparison: &Comparison, modulus: f64) -> String {
    let panel = |kind: Kind| {
        let points = curve(comparison, kind);
        let load: Vec<f64> = points.iter().map(|p| p.response.pressure.total() / modulus).collect();
        let shares: Vec<[f64; 3]> =
            points.iter().filter_map(|point| point.response.pressure.shares()).collect();
        let share = |regime: usize| shares.iter().map(|s| s[regime]).collect::<Vec<f64>>();
        let [elastic, middle, plastic] = [share(0), share(1), share(2)];
        Plot::new(
            kind.name(),
            load_axis(comparison, modulus),
            Axis::linear("share of the load").range(0.0, 1.0),
        )
        .with_stacked(
            &load,
            [
                ("elastic", Colour::Elastic, &elastic[..]),
                ("elastic-plastic", Colour::ElasticPlastic, &middle[..]),
                ("plastic", Colour::Plastic, &plastic[..]),
            ],
        )
    };
    let kinds = [Kind::Statistical, Kind::Deterministic];
    let present = kinds.into_iter().filter(|&kind| !curve(comparison, kind).is_empty());
    Figure::row("Regimes: shares of the load", present.map(panel).collect()).svg()
}

/// Where the asperities are: histograms of heights and radii, and the densities that the
/// statistical model puts in their place.
pub fn distributions(found: &SurfaceResults) -> String {
    let surface = &found.surface;
    let (mean, sigma) = (surface.statistics.mean_height, surface.statistics.sigma);
    let standardised: Vec<f64> = surface.set.heights().iter().map(|z| (z - mean) / sigma).collect();
    let (edges, density) = histogram(&standardised, -5.0, 5.0);
    let assumed = (0..=200).map(|k| {
        let x = -5.0 + 0.05 * f64::from(k);
        (x, found.population.heights.density(x))
    });
    let heights =
        Plot::new("Heights", Axis::linear("(z − mean)/σ").range(-5.0, 5.0), Axis::linear("density"))
            .with(Layer::bars(&edges, &density).coloured(Colour::Deterministic).named("asperities"))
            .with(
                Layer::line(assumed.collect::<Vec<_>>())
                    .coloured(Colour::Statistical)
                    .named(format!("{}, as the statistical model assumes", found.population.heights.name())),
            );
    if surface.statistics.radius_cv == 0.0 {
        return heights.svg();
    }
    let ratios: Vec<f64> = surface.set.radii().iter().map(|b| b / surface.statistics.mean_radius).collect();
    let (edges, density) = histogram(&ratios, 0.0, 5.0);
    let radii =
        Plot::new("Radii", Axis::linear("radius over mean radius").range(0.0, 5.0), Axis::linear("density"))
            .with(Layer::bars(&edges, &density).coloured(Colour::Deterministic).named("asperities"))
            .with(Layer::at_x(found.population.radius / surface.statistics.mean_radius, "statistical"));
    Figure::row("Heights and radii of the asperities", vec![heights, radii]).svg()
}

/// Counts in equal bins as a probability density of all values; bins as wide as Scott (1979) has
/// them for a Gaussian of the range's scale, at least 20.
fn histogram(values: &[f64], from: f64, to: f64) -> (Vec<f64>, Vec<f64>) {
    let width = 3.49 / (values.len() as f64).cbrt();
    let bins = (((to - from) / width).round() as usize).clamp(20, 100);
    let step = (to - from) / bins as f64;
    let edges = (0..=bins).map(|k| from + step * k as f64).collect();
    let mut density = vec![0.0; bins];
    for value in values.iter().filter(|value| (from..to).contains(value)) {
        let bin = ((value - from) / step) as usize;
        density[bin.min(bins - 1)] += 1.0 / (values.len() as f64 * step);
    }
    (edges, density)
}
