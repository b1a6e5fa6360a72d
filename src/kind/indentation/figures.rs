//! The figures of a sphere on layers.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use asperity::ModulusModel;
use asperity::compare::GOOD_RATIO;
use asperity::numeric::is_positive;
use asperity::sphere::Point;
use asperity_contact_framework::input::{InputError, Source, Spanned};
use asperity_contact_framework::report::format::number;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::Show;
use super::run::{IndentationResults, LawCurves, LayerResults};
use crate::paper::{SphereFigure, title};
use crate::presentation::regime_colour;
use crate::surface::beside;

/// Micrometres in a metre: what indentations are drawn in.
const MICRO: f64 = 1e6;

/// The curves of one law; `place` turns indentation, load and area into coordinates.
fn lines(
    plot: Plot,
    layer: &LayerResults,
    law: &LawCurves,
    place: impl Fn(f64, f64, f64) -> (f64, f64),
) -> Plot {
    let of_point = |point: &Point| place(point.indentation, point.contact.load, point.contact.area);
    let line = |points: &[Point]| Layer::line(points.iter().map(of_point));
    let exact = layer
        .exact
        .iter()
        .flatten()
        .map(|contact| place(contact.indentation, contact.load, PI * contact.contact_radius.powi(2)));
    let plot = plot
        .with(line(&law.uncoated.trace).coloured(Colour::Series(0)).dashed(Dash::Dashed).named("uncoated"))
        .with(line(&law.all_layer.trace).coloured(Colour::Series(3)).dashed(Dash::Dotted).named("all-layer"))
        .with(Layer::line(exact).coloured(Colour::Series(2)).named("exact-elastic"));
    let plot = law.coated.stretches().into_iter().fold(plot, |plot, (regime, points)| {
        plot.with(line(points).coloured(regime_colour(regime)).named(format!("coated, {}", regime.name())))
    });
    let changes: Vec<(f64, f64)> = law
        .coated
        .changes_within()
        .map(|change| place(change.indentation, change.load, change.area))
        .collect();
    if changes.is_empty() {
        return plot;
    }
    plot.with(Layer::points(changes, Marker::Circle).coloured(Colour::Neutral).named("change of regime"))
}

/// The measured points, where there are some.
fn with_measured(plot: Plot, results: &IndentationResults, place: impl Fn(f64, f64) -> (f64, f64)) -> Plot {
    if results.overlay.is_empty() {
        return plot;
    }
    let points = results.overlay.iter().map(|&(w, load)| place(w, load));
    plot.with(Layer::points(points, Marker::Cross).coloured(Colour::Series(6)).named("measured"))
}

/// Load and indentation, on logarithmic axes and on linear ones.
pub fn load(results: &IndentationResults, layer: &LayerResults, law: &LawCurves) -> Figure {
    let place = |w: f64, load: f64| match results.show {
        Show::Load => (w * MICRO, load),
        Show::Approach => (load, w * MICRO),
    };
    let panel = |title: &str, axis: fn(&str) -> Axis| {
        let plot = match results.show {
            Show::Load => Plot::new(title, axis("indentation w (µm)"), axis("load P (N)")),
            Show::Approach => Plot::new(title, axis("load P (N)"), axis("normal approach w (µm)")),
        };
        with_measured(lines(plot, layer, law, |w, load, _| place(w, load)), results, place)
    };
    let panels = vec![
        panel("Logarithmic", |label| Axis::log(label)).legend(Legend::Below),
        panel("Linear", |label| Axis::linear(label)).legend(Legend::Hidden),
    ];
    let figure = Figure::row("Load and indentation", panels);
    match (results.figure_of_paper, results.show) {
        (None, _) => figure,
        (Some(SphereFigure), Show::Load) => figure.titled(title(5, "load against indentation")),
        (Some(SphereFigure), Show::Approach) => figure.titled(title(5, "normal approach against load")),
    }
}

/// Load and area over those of Hertz without a layer, against indentation.
pub fn ratios(results: &IndentationResults, layer: &LayerResults, law: &LawCurves) -> Figure {
    let (radius, modulus) = (results.radius, results.reduced_modulus);
    let hertz_load = |w: f64| 4.0 / 3.0 * modulus * radius.sqrt() * w.powf(1.5);
    let x = || Axis::log("indentation w (µm)");
    let load =
        Plot::new("Load", x(), Axis::linear("load over the uncoated Hertz load")).legend(Legend::Below);
    let area = Plot::new("Real contact area", x(), Axis::linear("area A/(π R w)")).legend(Legend::Hidden);
    let place = |w: f64, load: f64| (w * MICRO, load / hertz_load(w));
    let load = with_measured(lines(load, layer, law, |w, load, _| place(w, load)), results, place);
    let area = lines(area, layer, law, |w, _, area| (w * MICRO, area / (PI * radius * w)));
    Figure::row("Load and real contact area over those of Hertz without a layer", vec![load, area])
}

/// Load by each effective-modulus model over the exact one: a panel per model, a line per layer.
pub fn rules(layers: &[&LayerResults]) -> Figure {
    let ratios = || layers.iter().flat_map(|layer| layer.errors.iter().flatten().map(|error| error.ratio));
    let (low, high) = (ratios().fold(1.0, f64::min) / 1.1, ratios().fold(1.0, f64::max) * 1.1);
    let panel = |(k, model): (usize, ModulusModel)| {
        let axis = Axis::log("load by the model / exact elastic load").range(low, high);
        let title = format!("Model {}", model.name());
        let plot = Plot::new(title, Axis::log("a/t of the exact contact"), axis).with(Layer::at_y(1.0, ""));
        let plot = layers.iter().enumerate().fold(plot, |plot, (index, layer)| {
            let errors = layer.errors[k].iter().map(|error| (error.contact_ratio, error.ratio));
            let name = format!("{}, E_l/E_s = {}", layer.label(), number(layer.check.modulus_ratio));
            plot.with(Layer::line(errors).coloured(Colour::Series(index)).named(name))
        });
        plot.legend(if k == 0 { Legend::Below } else { Legend::Hidden })
    };
    let [from, to] = GOOD_RATIO;
    let title = format!("Effective-modulus models; gao is accurate for E_l/E_s from {from} to {to}");
    Figure::row(title, ModulusModel::ALL.into_iter().enumerate().map(panel).collect())
}

pub struct OverlayPlan {
    pub path: PathBuf,
    /// Indentation (m) and load (N), in file order.
    pub points: Vec<(f64, f64)>,
}

impl OverlayPlan {
    /// Reads a file next to the spec.
    pub(super) fn new(source: &Source, file: &Spanned<PathBuf>) -> Result<Self, InputError> {
        let path = beside(source, file)?;
        let points = points(&path)
            .map_err(|message| source.error_at(file.span(), format!("{}: {message}", path.display())))?;
        Ok(Self { path, points })
    }

    /// The largest indentation, m.
    pub fn deepest(&self) -> f64 {
        self.points.iter().map(|(w, _)| *w).fold(0.0, f64::max)
    }
}

/// Indentation (m) and load (N) from a CSV; lines that begin with `#` are comments, further columns are passed over.
fn points(path: &Path) -> Result<Vec<(f64, f64)>, String> {
    let reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path);
    let mut reader = reader.map_err(|error| error.to_string())?;
    let header = reader.headers().map_err(|error| error.to_string())?.clone();
    let column = |name: &str| {
        header.iter().position(|found| found == name).ok_or_else(|| {
            let found = header.iter().collect::<Vec<_>>().join(", ");
            format!(
                "no column `{name}` (found: {found}); allowed: a header line with the columns indentation in m and load in N"
            )
        })
    };
    let columns = [("indentation", column("indentation")?), ("load", column("load")?)];
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let [w, load] = columns.map(|(name, index)| {
            let text = record.get(index).unwrap_or_default();
            text.parse().ok().filter(|value| is_positive(*value)).ok_or_else(|| {
                format!("line {line}, column `{name}`: found `{text}`; allowed: a positive finite number")
            })
        });
        points.push((w?, load?));
    }
    if points.is_empty() {
        return Err("no points: the table has no rows".to_owned());
    }
    Ok(points)
}
