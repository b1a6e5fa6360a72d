//! The page of a sphere on layers: load, changes of regime, accuracy of the effective-modulus models.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusError};
use asperity::numeric::is_positive;
use asperity::sphere::{LARGEST_SLOPE, Point};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::input::{InputError, Source, Spanned};
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{count, input_quantity, listed, number, quantity};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Row, Table, Tables};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::Show;
use super::rows::{
    ChangeRow, DecreaseRow, IndentationResults, LawCurves, LawRow, LayerResults, LayerRow, OverlayRow,
    RuleRow, tables,
};
use crate::presentation::{SphereFigure, regime_colour, title};
use crate::surface::beside;

impl Outcome for IndentationResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let layers = self.distinct_layers();
        let inaccurate = layers.iter().filter(|layer| !layer.check.is_good()).count();
        let [from, to] = GOOD_RATIO;
        let moduli = (inaccurate > 0).then(|| {
            let not = match layers.len() {
                1 => "this one is not".to_owned(),
                all => format!("{inaccurate} of {all} are not"),
            };
            format!("Rule `gao` is accurate for layers {from} to {to} times as stiff as the substrate; {not}")
        });
        let slope = layers.iter().map(|layer| layer.largest_slope(self.radius)).fold(0.0, f64::max);
        let large = (slope > LARGEST_SLOPE).then(|| {
            format!(
                "The contact radius reaches {slope:.2} of the ball's; beyond {LARGEST_SLOPE} the ball is no paraboloid and strains are not \
                 small"
            )
        });
        moduli.into_iter().chain(large).collect()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(self));
        let layers = self.distinct_layers();
        let is_solved = layers.iter().any(|layer| !layer.errors.concat().is_empty());
        // Several layers are compared in the errors of their models.
        let models_first = self.layers.len() > 1 && is_solved;
        if models_first {
            page.figure("rules.svg", rules(&layers), RULES);
        } else if let Some(law) = self.layers.first().and_then(|layer| layer.laws.first()) {
            load_figure(&mut page, self, 0, law);
        }
        sections::warnings(&mut page, &self.warnings());
        page.heading(2, "Accuracy of the effective-modulus models");
        if is_solved && !models_first {
            page.figure("rules.svg", rules(&layers), RULES);
        }
        page.view(&tables.view::<LayerRow>().without(&["gao_indentation_ratio", "series_indentation_ratio"]));
        if is_solved {
            page.details(2, "Errors against a/t", |page| errors(page, &layers, tables));
        }
        for (k, layer) in self.layers.iter().enumerate() {
            for (n, law) in layer.laws.iter().enumerate() {
                page.details(
                    2,
                    &format!("{}, {}, law {}", layer.label(), layer.rule.name(), law.law),
                    |page| {
                        if models_first || (k, n) != (0, 0) {
                            load_figure(page, self, k, law);
                        }
                        page.figure(&file(layer, k, law, "ratios"), ratios(self, layer, law), RATIOS);
                    },
                );
            }
        }
        page.details(2, "Loads and changes of regime", |page| {
            view::<LawRow>(page, tables);
            view::<ChangeRow>(page, tables);
            view::<DecreaseRow>(page, tables);
            view::<OverlayRow>(page, tables);
        });
        sections::notes(&mut page, &self.metadata);
        set_up(&mut page, self);
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }
}

/// The load at the largest indentation of a single layer, and the largest errors of both effective-modulus models.
fn answer(results: &IndentationResults) -> String {
    let layers = results.distinct_layers();
    let load = match &results.layers[..] {
        [layer] => layer.laws.first().map(|law| load(layer, law)),
        _ => None,
    };
    let errors = largest_errors(&layers);
    if errors.is_none() {
        let none = "No contact is small enough for the exact elastic solution.".to_owned();
        return load.into_iter().chain([none]).collect::<Vec<_>>().join(" ");
    }
    let close = (layers.len() > 1).then(|| close(&layers));
    load.into_iter().chain(errors).chain(close).collect::<Vec<_>>().join(" ")
}

/// Regime and loads at the largest indentation.
fn load(layer: &LayerResults, law: &LawCurves) -> String {
    let [coated, uncoated, all_layer] = law.curves().map(|(_, curve)| curve.points.last());
    let load =
        |point: Option<&Point>| point.map_or_else(String::new, |point| quantity(point.contact.load, "N"));
    format!(
        "Under `{}`, {} carries {} at an indentation of {} (uncoated {}, bulk {}); the contact is {}.",
        law.law,
        escape(&layer.label()),
        load(coated),
        coated.map_or_else(String::new, |point| input_quantity(point.indentation, "m")),
        load(uncoated),
        load(all_layer),
        coated.map_or("", |point| point.contact.regime.name()),
    )
}

/// The largest errors of the effective-modulus models, the smaller one first; `None` where no layer has an exact solution.
fn largest_errors(layers: &[&LayerResults]) -> Option<String> {
    let worst = ModulusModel::ALL.into_iter().filter_map(|model| {
        let errors = layers.iter().filter_map(|layer| Some((layer, layer.check.worst_of(model)?)));
        let (layer, worst) = errors.max_by(|a, b| a.1.factor().total_cmp(&b.1.factor()))?;
        Some((model, layer.label(), worst))
    });
    let mut worst: Vec<_> = worst.collect();
    worst.sort_by(|a, b| a.2.factor().total_cmp(&b.2.factor()));
    let error = |(k, (model, layer, worst)): (usize, &(ModulusModel, String, &ModulusError))| {
        let direction = if worst.ratio > 1.0 { "overestimates" } else { "underestimates" };
        let load = if k == 0 { "the load" } else { "it" };
        let on = if layers.len() > 1 { format!(" ({})", escape(layer)) } else { String::new() };
        format!("`{}` {direction} {load} up to {}-fold{on}", model.name(), number(worst.factor()))
    };
    let errors: Vec<String> = worst.iter().enumerate().map(error).collect();
    (!errors.is_empty()).then(|| format!("Without yielding, {}.", listed(&errors)))
}

/// For how many layers each model is close to the exact solution.
fn close(layers: &[&LayerResults]) -> String {
    /// Factor between loads that are close.
    const CLOSE: f64 = 1.1;
    let counts = ModulusModel::ALL.map(|model| {
        let worst = layers.iter().filter_map(|layer| layer.check.worst_of(model));
        format!("`{}` for {}", model.name(), worst.filter(|worst| worst.factor() <= CLOSE).count())
    });
    format!("Loads within 10 %: {} of {} layers.", listed(&counts), layers.len())
}

const RULES: &str = "Elastic load by each model over the exact elastic load at equal indentation, against the exact contact radius \
                     over the layer thickness. One panel per model, one line per layer.";

const LOAD: &str = "Load and indentation: coated (coloured by regime), uncoated, bulk layer material, and the exact elastic solution \
                    for ball, layer and substrate. Left: logarithmic axes; right: linear axes.";

const RATIOS: &str = "The same curves normalised by Hertz without a layer: load over (4/3) E* R^½ w^(3/2) with E* of the uncoated pair, \
                      and real contact area over π R w.";

/// The errors of both models at round contact radii.
fn errors(page: &mut Page, layers: &[&LayerResults], tables: &Tables) {
    for layer in layers {
        for model in ModulusModel::ALL {
            page.heading(3, &format!("{}, model {}", layer.label(), model.name()));
            let view = tables.view::<RuleRow>().only("layer", layer.name.as_str());
            let view = view.only("layer_thickness_m", layer.thickness).only("rule", model.name());
            page.view(&view.without(&["indentation_m"]).each_decade("contact_radius_over_thickness", 3.0));
        }
    }
}

/// A table without the columns of the layer and the law where there is only one.
fn view<R: Row>(page: &mut Page, tables: &Tables) {
    let view = tables.view::<R>().without_constant(&["layer", "layer_thickness_m", "rule", "law"]);
    page.view(&view);
}

/// The file of a figure of layer `k` under a law.
fn file(layer: &LayerResults, k: usize, law: &LawCurves, what: &str) -> String {
    let name = format!("{}-{}-{}-{what}", k + 1, layer.name, law.law);
    let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    name.chars().map(plain).collect::<String>() + ".svg"
}

/// Load and indentation of layer `k` under a law.
fn load_figure(page: &mut Page, results: &IndentationResults, k: usize, law: &LawCurves) {
    let layer = &results.layers[k];
    page.figure(&file(layer, k, law, "load"), load_over_indentation(results, layer, law), LOAD);
}

fn set_up(page: &mut Page, results: &IndentationResults) {
    let IndentationResults { metadata, materials, ball, radius, flat, indentations, layers, .. } = results;
    page.heading(2, "Set-up");
    sections::materials(page, metadata, materials, [false; 2], |name| {
        let is_layer = layers.iter().any(|layer| layer.name == name);
        let roles = [("ball", name == ball), ("flat", name == flat), ("layer", is_layer)];
        let roles: Vec<&str> = roles.into_iter().filter(|role| role.1).map(|role| role.0).collect();
        if roles.is_empty() { "not used".to_owned() } else { roles.join(", ") }
    });
    page.paragraph(&format!(
        "Ball of radius {} on a flat of {}; {} indentations from {} to {}. {} Method: [theory](../../docs/theory.md#4-the-layered-flat).",
        input_quantity(*radius, "m"),
        escape(flat),
        count(indentations.len()),
        input_quantity(indentations[0], "m"),
        input_quantity(indentations[indentations.len() - 1], "m"),
        sections::provenance(metadata),
    ));
}

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
fn load_over_indentation(results: &IndentationResults, layer: &LayerResults, law: &LawCurves) -> Figure {
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
