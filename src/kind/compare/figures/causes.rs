//! Contributions to the difference between the models over the load.

use asperity::compare::{Cause, ComparedQuantity, Contributions};
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use super::axes::Units;
use super::differences::{MARGIN, NOT_ADMISSIBLE, invalid, megapascals};
use crate::presentation::{cause_colour, quantity_name};

/// The quantities that are divided on the page.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

/// The contributions over the load, stacked, with the difference; one panel per quantity; `finding` is what it shows, in words.
/// `None` where too few contacts carry every load.
pub fn figure(verdicts: &Verdicts, units: &Units, finding: &str) -> Option<Figure> {
    let is_divided = verdicts
        .attribution
        .iter()
        .any(|at| QUANTITIES.into_iter().any(|quantity| at.contributions(quantity).is_some()));
    let panels = QUANTITIES.into_iter().map(|quantity| panel(verdicts, units, quantity));
    is_divided.then(|| Figure::row(finding, panels.collect()))
}

fn panel(verdicts: &Verdicts, units: &Units, quantity: ComparedQuantity) -> Plot {
    let divided = || verdicts.attribution.iter().map(|at| (megapascals(at.load), at.contributions(quantity)));
    let load: Vec<f64> = divided().map(|(load, _)| load).collect();
    let ends = [load.iter().copied().fold(f64::INFINITY, f64::min), load.iter().copied().fold(0.0, f64::max)];
    let y = match quantity {
        ComparedQuantity::Separation => units.separation_difference("contribution"),
        _ => Axis::linear("ln(area ratio of the models)"),
    };
    let parts = Cause::ALL.map(|cause| {
        divided().map(|(_, parts)| parts.map_or(f64::NAN, |parts| parts.part(cause))).collect::<Vec<f64>>()
    });
    let axis = units.pressure().range(ends[0] / MARGIN, ends[1] * MARGIN);
    let mut plot = Plot::new(capitalised(quantity_name(quantity)), axis, y).height(240.0);
    for region in invalid(&verdicts.admissible, 1e-6, NOT_ADMISSIBLE) {
        plot = plot.with(region);
    }
    let stacked = Cause::ALL.into_iter().zip(&parts);
    plot = plot.with_contributions(
        &load,
        stacked.map(|(cause, part)| (cause.label(), cause_colour(cause), &part[..])),
    );
    let radii =
        divided().map(|(load, parts)| (load, parts.map_or(f64::NAN, |parts| parts.radii.mean.contrast)));
    plot = plot.with(
        Layer::line(radii)
            .coloured(Colour::Radii)
            .dashed(Dash::Dashed)
            .named("spread and correlation of radii together"),
    );
    let gap = divided().map(|(load, parts)| (load, parts.map_or(f64::NAN, Contributions::gap)));
    plot = plot
        .with_zero()
        .with(Layer::line(gap).coloured(Colour::Sum).thick().named("statistical − deterministic"));
    let missed: Vec<(f64, f64)> = verdicts
        .attribution
        .iter()
        .filter_map(|at| Some((megapascals(at.load), verdicts.missed(quantity, at.load)?.contrast)))
        .collect();
    if missed.is_empty() {
        return plot;
    }
    let name = "deterministic − reference";
    let line = Layer::line(missed.iter().copied()).coloured(Colour::Deterministic).dashed(Dash::DashDot);
    plot.with(line.named(name))
        .with(Layer::points(missed, Marker::Triangle).coloured(Colour::Deterministic).named(name))
}
