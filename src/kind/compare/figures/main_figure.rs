//! What a page is opened for: of a spec that reproduces a figure of Pasaribu and Schipper (2005) that one; of one case both models
//! against load with their differences, and of a measured map the contacts on it; of several cases the verdict map.

use asperity::compare::{ComparedQuantity, Comparison};
use asperity::spot::Correlation;
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::input_quantity;
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Colour, Dash, Figure, Layer, Plot};

use super::super::correlations;
use super::super::results::{CompareResults, SurfaceResults};
use super::super::rows::SurfaceCase;
use super::super::series::{Series, stem};
use super::curves::{Setting, Units, all_loads};
use super::differences::{between_models, shown_loads};
use super::layers::panels_by_load;
use super::{contact, curves, verdict_map};
use crate::paper::title;
use crate::surface::section::radii_against_heights;

/// Adds the main figure of one case: that of the paper, or the models against load, and of a measured map the contacts on it.
pub fn of_case_or_paper(page: &mut Page, results: &CompareResults, case: SurfaceCase, series: &[Series]) {
    if !results.figures_of_paper.is_empty() {
        return of_paper(page, results, series);
    }
    of_case_with_map(page, results, case);
}

/// Both models against load, and of a measured map what is in contact on it.
pub(crate) fn of_case_with_map(page: &mut Page, results: &CompareResults, case: SurfaceCase) {
    of_case(page, results, case);
    if let Some(map) = case.surface.contact_map(case.case) {
        contact::add(page, &case.surface.surface.name, map);
    }
}

/// Adds the figures of Pasaribu and Schipper (2005) that a spec reproduces.
pub fn of_paper(page: &mut Page, results: &CompareResults, series: &[Series]) {
    if !results.figures_of_paper.is_empty() {
        figures(page, results, series);
    }
}

/// Adds the verdict map of several cases; of layers one for each series.
pub fn verdict_maps(page: &mut Page, results: &CompareResults, series: &[Series]) {
    let mut draw = |file: &str, title: &str, cases: &[(String, &Verdicts)]| {
        if let Some(figure) = verdict_map::figure(cases, title) {
            let caption = "May the integral replace the sum, by load? Blank: not admissible. In the table yes/? is within where it can be told, outside has no admissible load, (here) holds on the compared surface alone.";
            page.figure(file, figure.headed(title), caption);
        }
    };
    if series.is_empty() {
        let named: Vec<(String, &Verdicts)> =
            SurfaceCase::all(results).map(|case| (case.name(results), case.verdicts())).collect();
        draw("verdicts.svg", "Verdict map", &named);
    }
    for series in series {
        let title = format!("Verdict map: {}", series.subject);
        draw(&format!("{}-verdicts.svg", series.stem), &title, &series.named_verdicts());
    }
}

/// Both models and the reference against load, and below the differences between the models; nothing of one load.
pub(crate) fn of_case(page: &mut Page, results: &CompareResults, case: SurfaceCase) {
    if case.first().is_single() {
        return;
    }
    let name = case.name(results);
    let figure = figure(results, case).headed(format!("{name}: both models at equal load"));
    let below = if case.verdicts().differences.is_empty() {
        ""
    } else {
        "; below, statistical minus deterministic (green: accepted)"
    };
    let marked =
        if case.case.reported_load().is_some() { "; vertical line: load of the results above" } else { "" };
    page.figure(
        &format!("{}-models.svg", stem(case.surface, &case.first().law)),
        figure,
        &format!(
            "{name}: both models against load{below}. Bands: 95 % intervals; grey: not admissible{marked}."
        ),
    );
}

/// The correlations of a conductance against load.
fn correlations(case: SurfaceCase, quantity: ComparedQuantity, setting: &Setting) -> Vec<Layer> {
    let line = |correlation: Correlation| {
        let value = correlations::conductance(case, quantity, correlation)?;
        let points = curves::dense(&setting.shown).into_iter().filter_map(|load| {
            Some((setting.loads.per_pascal * load, curves::scale(quantity) * value(load)?))
        });
        let points: Vec<(f64, f64)> = points.collect();
        let dash = if correlation == Correlation::Mikic { Dash::Dotted } else { Dash::Dashed };
        let line = Layer::line(points.iter().copied()).coloured(Colour::Neutral).dashed(dash).thin();
        (!points.is_empty()).then(|| line.named(correlation.label()))
    };
    Correlation::ALL.into_iter().filter_map(line).collect()
}

/// Cells of a row of a grid, with empty ones at its end; none of none.
fn filled(cells: &[Plot], columns: usize) -> Vec<Plot> {
    let blank = if cells.is_empty() { 0 } else { columns - cells.len() };
    cells.iter().cloned().chain((0..blank).map(|_| Plot::blank())).collect()
}

const COLUMNS: usize = 3;

fn figure(results: &CompareResults, case: SurfaceCase) -> Figure {
    let verdicts = case.verdicts();
    let units = Units::new(results, case.surface);
    let tested: Vec<f64> = verdicts.differences.iter().map(|at| at.load).collect();
    let shown = if tested.is_empty() {
        shown_loads(&verdicts.admissible, all_loads(case.first()))
    } else {
        shown_loads(&verdicts.admissible, tested.into_iter())
    };
    let loads = units.pressures();
    let setting = Setting { case: case.first(), valid: &verdicts.admissible, units, loads, shown };
    let others: Vec<&Comparison> =
        case.case.realisations.iter().skip(1).map(|other| &other.comparison).collect();
    let [mut beside_separation, mut beside_area] = curves::layers(results, case.surface, case.first());
    let reported = case.case.reported_load().map(|at| at.load);
    let marked = |plot: Plot, label: &str| match reported {
        Some(load) => plot.with(Layer::at_x(setting.loads.per_pascal * load, label)),
        None => plot,
    };
    let label = reported.map_or_else(String::new, |load| input_quantity(load, "Pa"));
    let (quantities, differences): (Vec<ComparedQuantity>, Vec<Plot>) =
        between_models(verdicts, &units).into_iter().unzip();
    let quantities =
        if quantities.is_empty() { ComparedQuantity::REPORTED[..2].to_vec() } else { quantities };
    let curves = quantities.iter().map(|&quantity| {
        let (others, beside): (&[&Comparison], Vec<Layer>) = match quantity {
            ComparedQuantity::Separation => (&others, std::mem::take(&mut beside_separation)),
            ComparedQuantity::Area => (&[], std::mem::take(&mut beside_area)),
            other => (&[], correlations(case, other, &setting)),
        };
        marked(setting.plot(quantity, others, beside).height(190.0), &label)
    });
    let curves: Vec<Plot> = curves.collect();
    let below: Vec<Plot> = differences.into_iter().map(|plot| marked(plot, "")).collect();
    let title = format!("{}: both models against load, and their differences", case.name(results));
    // Quantities that are asked for beyond the first three are below these.
    let columns = quantities.len().min(COLUMNS);
    let rows = curves.chunks(columns).enumerate().flat_map(|(index, row)| {
        let below = below.chunks(columns).nth(index).unwrap_or(&[]);
        [row, below].map(|cells| filled(cells, columns)).concat()
    });
    Figure::grid(title, columns, rows.collect())
}

/// Adds those that the spec reproduces.
pub fn figures(page: &mut Page, results: &CompareResults, series: &[Series]) {
    for &number in &results.figures_of_paper {
        let (figure, what, how) = match number {
            3 => (radii(results), "radii against heights of the asperities", "Colour: asperities per cell"),
            4 => (
                separations(results),
                "separation against load",
                "Bands: 95 % intervals; grey: not admissible",
            ),
            _ => (
                thicknesses(series),
                "separation and real contact area against load by layer thickness",
                "Thin lines: not admissible",
            ),
        };
        let title = title(number, what);
        page.figure(
            &format!("figure-{number}-of-paper.svg"),
            figure.titled(title.as_str()),
            &format!("{title}. {how}."),
        );
    }
}

/// The surfaces whose radii differ, as the paper's do; all where those of none do.
fn rough(results: &CompareResults) -> Vec<&SurfaceResults> {
    let all: Vec<&SurfaceResults> = results.surfaces.iter().collect();
    let differ: Vec<&SurfaceResults> =
        all.iter().copied().filter(|results| results.surface.statistics.radius_cv > 0.0).collect();
    if differ.is_empty() { all } else { differ }
}

fn radii(results: &CompareResults) -> Figure {
    let panel = |results: &&SurfaceResults| {
        radii_against_heights(
            &results.surface,
            Some(&results.realisations[0].population),
            &results.surface.name,
        )
    };
    Figure::row("", rough(results).iter().map(panel).collect())
}

fn separations(results: &CompareResults) -> Figure {
    let surfaces = rough(results);
    let cases = surfaces.iter().flat_map(|surface| SurfaceCase::on_surface(surface));
    let panel = |case: SurfaceCase| -> Plot {
        let units = Units::new(results, case.surface);
        let valid = &case.verdicts().admissible;
        let shown = shown_loads(valid, all_loads(case.first()));
        let setting = Setting { case: case.first(), valid, units, loads: units.ratios(), shown };
        setting.plot(ComparedQuantity::Separation, &[], Vec::new()).titled(case.name(results)).height(300.0)
    };
    Figure::row("", cases.map(panel).collect())
}

fn thicknesses(series: &[Series]) -> Figure {
    let panels = series.iter().flat_map(|series| {
        panels_by_load(series).map(|plot| plot.titled(series.subject.as_str()).height(300.0))
    });
    Figure::grid("", 2, panels.collect())
}
