//! The figures of a comparison.

use super::differences::invalid;
use crate::kind::compare::answers::CaseResults;
use asperity::compare::{Comparison, CurvePoint, Kind, Pair, Pairing, ReferencePoint, ValidRange};
use asperity::{INTERACTION, Regime};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

/// Half-width of a band in standard errors: 95 % of all samples lie within.
const BAND: f64 = 1.96;

/// The load axis shared by all figures of one comparison.
fn load_axis(case: &CaseResults, modulus: f64) -> Axis {
    /// Margin at both ends, as a ratio.
    const ROOM: f64 = 1.3;
    let loads = || {
        let of_models = case.comparison.curves.iter().map(|point| point.response.pressure.total());
        let of_reference = case.reference.iter().flat_map(|curve| &curve.points).map(|point| point.pressure);
        of_models.chain(of_reference).map(|load| load / modulus).filter(|&load| load > 0.0)
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

/// The points of one model that carry load, by increasing load.
pub fn curve(comparison: &Comparison, kind: Kind) -> Vec<&CurvePoint> {
    let mut points: Vec<&CurvePoint> = comparison
        .curves
        .iter()
        .filter(|point| point.kind == kind && point.response.pressure.total() > 0.0)
        .collect();
    points.sort_by(|a, b| a.response.pressure.total().total_cmp(&b.response.pressure.total()));
    points
}

/// Pairs at equal load, by increasing load.
pub fn at_equal_load(comparison: &Comparison) -> Vec<&Pair> {
    let mut pairs: Vec<&Pair> =
        comparison.pairs.iter().filter(|pair| pair.pairing == Pairing::Load).collect();
    pairs.sort_by(|a, b| a.target.total_cmp(&b.target));
    pairs
}

/// d/sigma against load (Pasaribu and Schipper 2005, Fig. 4), with `lines` beside the models; the deterministic results of other
/// realisations are dotted.
pub fn separation(
    case: &CaseResults,
    others: &[&Comparison],
    valid: &ValidRange,
    modulus: f64,
    sigma: f64,
    lines: Vec<Layer>,
) -> String {
    const OTHERS: &str = "other realisations";
    let comparison = &case.comparison;
    let axis = load_axis(case, modulus);
    let mut plot = Plot::new("Separation against load", axis, Axis::linear("separation d/σ"));
    for region in invalid(valid, modulus.recip()) {
        plot = plot.with(region);
    }
    for other in others {
        let points = curve(other, Kind::Deterministic);
        let line = points
            .iter()
            .map(|point| (point.response.pressure.total() / modulus, point.response.separation_over_sigma));
        let line = Layer::line(line.collect::<Vec<_>>()).coloured(Colour::Deterministic).dashed(Dash::Dotted);
        plot = plot.with(line.named(format!("deterministic, {OTHERS}")));
    }
    for kind in [Kind::Deterministic, Kind::Statistical] {
        let points = curve(comparison, kind);
        let load = |point: &CurvePoint| point.response.pressure.total() / modulus;
        let band = points.iter().filter_map(|point| {
            let response = &point.response;
            let half = BAND * response.separation_error(sigma)?;
            let d = response.separation_over_sigma;
            Some((load(point), d - half, d + half))
        });
        plot = plot.with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(kind)));
        let line = points.iter().map(|point| (load(point), point.response.separation_over_sigma));
        plot = plot.with(model_line(kind, line));
    }
    let plot = lines.into_iter().fold(plot, Plot::with);
    with_reference(plot, case, modulus, |point| point.separation_over_sigma).svg()
}

/// Adds the line of the reference, where it was run.
fn with_reference(
    plot: Plot,
    case: &CaseResults,
    modulus: f64,
    value: fn(&ReferencePoint) -> Option<f64>,
) -> Plot {
    let points = reference_line(case, modulus, value);
    if points.is_empty() {
        return plot;
    }
    let line = Layer::line(points.iter().copied()).coloured(Colour::Reference).dashed(Dash::DashDot);
    let places = Layer::points(points, Marker::Triangle).coloured(Colour::Reference);
    plot.with(line.named("reference")).with(places.named("reference"))
}

/// Load ratio and a value of the reference, by increasing load.
pub fn reference_line(
    case: &CaseResults,
    modulus: f64,
    value: fn(&ReferencePoint) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let points = case.reference.iter().flat_map(|curve| &curve.points);
    let mut line: Vec<(f64, f64)> =
        points.filter_map(|point| Some((point.pressure / modulus, value(point)?))).collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    line
}

fn model_line(kind: Kind, points: impl Iterator<Item = (f64, f64)>) -> Layer {
    let dash = if kind == Kind::Statistical { Dash::Dashed } else { Dash::Solid };
    Layer::line(points.collect::<Vec<_>>()).coloured(colour(kind)).dashed(dash).named(kind.name())
}

/// Real over nominal area against load, with `lines` beside the models.
pub fn area(case: &CaseResults, valid: &ValidRange, modulus: f64, lines: Vec<Layer>) -> String {
    let comparison = &case.comparison;
    let mut plot = Plot::new(
        "Real contact area against load",
        load_axis(case, modulus),
        Axis::log("area ratio A/A_nom"),
    )
    .with(Layer::at_y(INTERACTION, "asperities interact above"));
    for region in invalid(valid, modulus.recip()) {
        plot = plot.with(region);
    }
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
    let plot = lines.into_iter().fold(plot, Plot::with);
    with_reference(plot, case, modulus, |point| Some(point.area_ratio)).svg()
}

/// The colour of a regime.
pub fn regime_colour(regime: Regime) -> Colour {
    match regime {
        Regime::Elastic => Colour::Elastic,
        Regime::ElasticPlastic => Colour::ElasticPlastic,
        Regime::Plastic => Colour::Plastic,
    }
}

/// Each regime's share of the load against something.
pub fn shares_of_load(title: &str, x: Axis, shares: impl Iterator<Item = (f64, [f64; 3])>) -> Plot {
    let (x_values, shares): (Vec<f64>, Vec<[f64; 3]>) = shares.unzip();
    let share = Regime::ALL.map(|regime| shares.iter().map(|s| s[regime as usize]).collect::<Vec<f64>>());
    let stacked = Regime::ALL.into_iter().zip(&share);
    Plot::new(title, x, Axis::linear("share of the load").range(0.0, 1.0)).with_stacked(
        &x_values,
        stacked.map(|(regime, share)| (regime.name(), regime_colour(regime), &share[..])),
    )
}

/// Each regime's share of the load, one panel per model.
pub fn regimes(case: &CaseResults, valid: &ValidRange, modulus: f64) -> String {
    let comparison = &case.comparison;
    let panel = |kind: Kind| {
        let points = curve(comparison, kind);
        let load: Vec<f64> = points.iter().map(|p| p.response.pressure.total() / modulus).collect();
        let shares: Vec<[f64; 3]> =
            points.iter().filter_map(|point| point.response.pressure.shares()).collect();
        let axis = load_axis(case, modulus);
        let plot = shares_of_load(kind.name(), axis, load.into_iter().zip(shares));
        // Regions lie below the shares: the edges of the valid range are lines.
        let edges = valid.stretches.iter().flatten().map(|load| load / modulus);
        edges.fold(plot, |plot, edge| plot.with(Layer::at_x(edge, "")))
    };
    let kinds = [Kind::Statistical, Kind::Deterministic];
    let present = kinds.into_iter().filter(|&kind| !curve(comparison, kind).is_empty());
    Figure::row("Share of the load by contact regime", present.map(panel).collect()).svg()
}
