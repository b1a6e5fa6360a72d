//! The figures of a sphere on layers.

use std::f64::consts::PI;

use crate::kind::compare::figures::curves::regime_colour;
use crate::kind::indentation::run::{IndentationResults, LawCurves, LayerResults};
use crate::kind::indentation::shown::Shown;
use crate::kind::indentation::spec::Show;
use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusError};
use asperity_framework::report::format::number;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

/// Micrometres in a metre: what indentations are drawn in.
const MICRO: f64 = 1e6;

type Line = Vec<(f64, f64)>;

fn colour(shown: Shown) -> Colour {
    match shown {
        Shown::Coated => Colour::ElasticPlastic,
        Shown::Uncoated => Colour::Series(0),
        Shown::AllLayer => Colour::Series(3),
        Shown::Exact => Colour::Series(2),
    }
}

fn style(shown: Shown) -> Dash {
    match shown {
        Shown::Coated | Shown::Exact => Dash::Solid,
        Shown::Uncoated => Dash::Dashed,
        Shown::AllLayer => Dash::Dotted,
    }
}

/// The curves of one law, each as (w, P, A): `turn` gives the coordinates of a point.
fn lines(
    plot: Plot,
    found: &LayerResults,
    law: &LawCurves,
    turn: impl Fn(f64, f64, f64) -> (f64, f64),
) -> Plot {
    let mut plot = plot;
    for (shown, curve) in Shown::of(law) {
        let place =
            |point: &asperity::sphere::Point| turn(point.indentation, point.contact.load, point.contact.area);
        if shown == Shown::Coated {
            continue;
        }
        let line: Line = curve.trace.iter().map(place).collect();
        plot = plot.with(Layer::line(line).coloured(colour(shown)).dashed(style(shown)).named(shown.name()));
    }
    let exact = found.exact.iter().flatten();
    let exact: Line = exact
        .map(|contact| turn(contact.indentation, contact.load, PI * contact.contact_radius.powi(2)))
        .collect();
    plot = plot.with(
        Layer::line(exact)
            .coloured(colour(Shown::Exact))
            .dashed(style(Shown::Exact))
            .named(Shown::Exact.name()),
    );
    let coated = &law.coated;
    for (regime, points) in coated.stretches() {
        let line: Line = points
            .iter()
            .map(|point| turn(point.indentation, point.contact.load, point.contact.area))
            .collect();
        let name = format!("coated, {}", regime.name());
        plot = plot.with(Layer::line(line).coloured(regime_colour(regime)).named(name));
    }
    let changes: Line =
        coated.changes_within().map(|change| turn(change.indentation, change.load, change.area)).collect();
    if changes.is_empty() {
        return plot;
    }
    plot.with(Layer::points(changes, Marker::Circle).coloured(Colour::Neutral).named("change of regime"))
}

/// Load and indentation, on logarithmic axes and on linear ones.
pub fn load(results: &IndentationResults, found: &LayerResults, law: &LawCurves) -> Figure {
    let turn = |w: f64, load: f64| match results.show {
        Show::Load => (w * MICRO, load),
        Show::Approach => (load, w * MICRO),
    };
    let (w, p) = (["indentation w (µm)", "normal approach w (µm)"], "load P (N)");
    let panel = |title: &str, axis: fn(&str) -> Axis| {
        let plot = match results.show {
            Show::Load => Plot::new(title, axis(w[0]), axis(p)),
            Show::Approach => Plot::new(title, axis(p), axis(w[1])),
        };
        let mut plot = lines(plot, found, law, |w, load, _| turn(w, load));
        if let Some((_, points)) = &results.overlay {
            plot = plot.with(measured(points.iter().map(|&(w, load)| turn(w, load))));
        }
        plot
    };
    let panels = vec![
        panel("Logarithmic", |label| Axis::log(label)).legend(Legend::Below),
        panel("Linear", |label| Axis::linear(label)).legend(Legend::Hidden),
    ];
    Figure::row("Load and indentation", panels)
}

/// Load and area over those of Hertz without a layer, against indentation.
pub fn ratios(results: &IndentationResults, found: &LayerResults, law: &LawCurves) -> Figure {
    let radius = results.radius;
    let hertz_load = |w: f64| 4.0 / 3.0 * results.reduced_modulus * radius.sqrt() * w.powf(1.5);
    let x = || Axis::log("indentation w (µm)");
    let load =
        Plot::new("Load", x(), Axis::linear("load over the uncoated Hertz load")).legend(Legend::Below);
    let area = Plot::new("Real contact area", x(), Axis::linear("area A/(π R w)")).legend(Legend::Hidden);
    let mut load = lines(load, found, law, |w, load, _| (w * MICRO, load / hertz_load(w)));
    if let Some((_, points)) = &results.overlay {
        load = load.with(measured(points.iter().map(|&(w, load)| (w * MICRO, load / hertz_load(w)))));
    }
    let area = lines(area, found, law, |w, _, area| (w * MICRO, area / (PI * radius * w)));
    Figure::row("Load and real contact area over those of Hertz without a layer", vec![load, area])
}

fn measured(points: impl Iterator<Item = (f64, f64)>) -> Layer {
    Layer::points(points.collect::<Line>(), Marker::Cross).coloured(Colour::Series(6)).named("measured")
}

fn errors(errors: &[ModulusError]) -> Layer {
    Layer::line(errors.iter().map(|error| (error.contact_ratio, error.ratio)).collect::<Line>())
}

/// Load by each effective-modulus model over the exact one, for one layer.
pub fn rule(found: &LayerResults) -> Figure {
    let colours = [Colour::Series(1), Colour::Series(0)];
    let mut plot = Plot::new(
        "Effective-modulus models: elastic load over the exact one at equal indentation",
        Axis::log("a/t of the exact contact"),
        Axis::log("load by the model / exact elastic load"),
    );
    let exact = found.errors[0].iter().map(|error| (error.contact_ratio, 1.0));
    plot = plot.with(
        Layer::line(exact.collect::<Line>()).coloured(Colour::Neutral).dashed(Dash::Dotted).named("exact"),
    );
    for ((rule, of), colour) in ModulusModel::ALL.into_iter().zip(&found.errors).zip(colours) {
        plot =
            plot.with(errors(of).coloured(colour).dashed(dash(rule)).named(format!("model {}", rule.name())));
    }
    plot.into()
}

fn dash(rule: ModulusModel) -> Dash {
    match rule {
        ModulusModel::Gao => Dash::Solid,
        ModulusModel::Series => Dash::Dashed,
    }
}

/// The same for all layers: one panel per effective-modulus model.
pub fn rules(results: &IndentationResults) -> Figure {
    let all = || results.layers.iter().flat_map(|found| found.errors.iter().flatten());
    let low = all().map(|error| error.ratio).fold(1.0, f64::min) / 1.1;
    let high = all().map(|error| error.ratio).fold(1.0, f64::max) * 1.1;
    let panel = |(k, rule): (usize, ModulusModel)| {
        let axis = Axis::log("load by the model / exact elastic load").range(low, high);
        let title = format!("Model {}", rule.name());
        let mut plot =
            Plot::new(title, Axis::log("a/t of the exact contact"), axis).with(Layer::at_y(1.0, ""));
        for (index, found) in results.layers.iter().enumerate() {
            let name = format!(
                "{}, E_l/E_s = {}",
                super::subject(results, found),
                number(found.check.modulus_ratio)
            );
            plot = plot.with(errors(&found.errors[k]).coloured(Colour::Series(index)).named(name));
        }
        plot.legend(if k == 0 { Legend::Below } else { Legend::Hidden })
    };
    let panels = ModulusModel::ALL.into_iter().enumerate().map(panel).collect();
    let [from, to] = GOOD_RATIO;
    Figure::row(
        format!(
            "Both effective-modulus models for all layers; gao is accurate for E_l/E_s from {from} to {to}"
        ),
        panels,
    )
}
