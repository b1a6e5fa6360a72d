//! What a page is opened for: of a spec that reproduces a figure of Pasaribu and Schipper (2005) that one; of one case both models
//! against load with their differences, and of a measured map the contacts on it; of several cases the verdict map.

use asperity::compare::{ComparedQuantity, Comparison, Difference, Verdict};
use asperity::spot::Correlation;
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::{capitalised, input_quantity, thickness};
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Plot};

use super::super::correlations;
use super::super::results::{CompareResults, SurfaceResults};
use super::super::rows::SurfaceCase;
use super::super::series::{Series, stem};
use super::curves::{Setting, Units, all_loads};
use super::differences::{MARGIN, between_models, megapascals, shown_loads};
use super::layers::panels_by_load;
use super::{contact, curves};
use crate::presentation::{quantity_name, title};
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
        figures_of_paper(page, results, series);
    }
}

/// Adds the verdict map of several cases; of layers one for each series.
pub fn verdict_maps(page: &mut Page, results: &CompareResults, series: &[Series]) {
    let mut draw = |file: &str, title: &str, cases: &[(String, &Verdicts)]| {
        if let Some(figure) = verdict_map(cases, title) {
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
        draw(
            &format!("{}-verdicts.svg", series.stem),
            &title,
            &series.verdicts().map(|(t, verdicts)| (thickness(t), verdicts)).collect::<Vec<_>>(),
        );
    }
}

/// Both models and the reference against load, and below the differences between the models; nothing of one load.
pub(crate) fn of_case(page: &mut Page, results: &CompareResults, case: SurfaceCase) {
    if case.first().is_single() {
        return;
    }
    let name = case.name(results);
    let figure = of_one_case(results, case).headed(format!("{name}: both models at equal load"));
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

fn of_one_case(results: &CompareResults, case: SurfaceCase) -> Figure {
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
fn figures_of_paper(page: &mut Page, results: &CompareResults, series: &[Series]) {
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

/// What a stretch of loads says: colour, name in the legend, and sign.
pub type Mark = (Colour, &'static str, &'static str);

const WITHIN: Mark = (Colour::Reference, "= within what is accepted", "=");
const TOO_LARGE: Mark = (Colour::Deterministic, "+ integral too large", "+");
const TOO_SMALL: Mark = (Colour::Statistical, "− integral too small", "−");
const OPEN: Mark = (Colour::Neutral, "? cannot be told", "?");
const UNFIT: Mark = (Colour::Others, "× map not fit", "×");

pub const MARKS: [Mark; 5] = [WITHIN, TOO_LARGE, TOO_SMALL, OPEN, UNFIT];

/// The verdicts on several cases at their admissible loads; blank where a load is not admissible. `None` where no load is admissible.
fn verdict_map(cases: &[(String, &Verdicts)], title: &str) -> Option<Figure> {
    /// Longer names leave too little room for panels side by side.
    const LONGEST: usize = 10;
    let of_quantity =
        |quantity| cases.iter().map(|(_, verdicts)| tiles(verdicts, quantity)).collect::<Vec<_>>();
    let panels: Vec<(ComparedQuantity, Vec<Tiles>)> = ComparedQuantity::REPORTED
        .map(|quantity| (quantity, of_quantity(quantity)))
        .into_iter()
        .filter(|(_, rows)| rows.iter().any(|tiles| !tiles.is_empty()))
        .collect();
    let is_shown =
        |mark: &Mark| panels.iter().flat_map(|(_, rows)| rows).flatten().any(|(_, shown)| shown == mark);
    let marks: Vec<Mark> = MARKS.into_iter().filter(is_shown).collect();
    let plots: Vec<Plot> =
        panels.iter().map(|(quantity, rows)| panel(cases, *quantity, rows, &marks)).collect();
    let is_narrow = cases.iter().all(|(name, _)| name.chars().count() <= LONGEST);
    let arranged = if is_narrow { Figure::row } else { Figure::column };
    (!plots.is_empty()).then(|| arranged(title, plots))
}

/// A panel, with a key for each of the `marks` of the figure.
fn panel(cases: &[(String, &Verdicts)], quantity: ComparedQuantity, rows: &[Tiles], marks: &[Mark]) -> Plot {
    const ROW: f64 = 24.0;
    let loads = cases.iter().flat_map(|(_, verdicts)| &verdicts.differences).map(|at| megapascals(at.load));
    let [low, high] = [loads.clone().fold(f64::INFINITY, f64::min), loads.fold(0.0, f64::max)];
    let mut plot = Plot::new(
        capitalised(quantity_name(quantity)),
        Axis::log("nominal pressure (MPa)").range(low / MARGIN, high * MARGIN),
        Axis::named(cases.iter().map(|(name, _)| name.clone())),
    )
    .height(ROW * cases.len() as f64)
    .legend(Legend::Below);
    for (colour, name, _) in marks {
        plot = plot.with(Layer::key().coloured(*colour).named(*name));
    }
    for (row, tiles) in rows.iter().enumerate() {
        let row = row as f64;
        for ([from, to], (colour, _, sign)) in tiles {
            plot = plot.with(Layer::tile((*from, row - 0.42), (*to, row + 0.42), *sign).coloured(*colour));
        }
    }
    plot
}

/// Stretches of loads, MPa, with what they say.
type Tiles = Vec<([f64; 2], Mark)>;

/// The stretches of admissible loads (MPa) that say the same, each to half way to its neighbours.
fn tiles(verdicts: &Verdicts, quantity: ComparedQuantity) -> Tiles {
    let mut sorted: Vec<&Difference> =
        verdicts.differences.iter().filter(|at| at.estimates[quantity as usize].is_some()).collect();
    sorted.sort_by(|a, b| a.load.total_cmp(&b.load));
    let half_way = |a: usize, b: usize| megapascals((sorted[a].load * sorted[b].load).sqrt());
    let ends = |k: usize| {
        let at = megapascals(sorted[k].load);
        let before = if k > 0 { half_way(k - 1, k) } else { at / MARGIN.sqrt() };
        let after = if k + 1 < sorted.len() { half_way(k, k + 1) } else { at * MARGIN.sqrt() };
        [before, after]
    };
    let mut tiles = Tiles::new();
    for (k, at) in sorted.iter().enumerate() {
        let Some(mark) = mark(at, verdicts, quantity) else { continue };
        let [from, to] = ends(k);
        match tiles.last_mut() {
            Some((last, same)) if *same == mark && last[1] == from => last[1] = to,
            _ => tiles.push(([from, to], mark)),
        }
    }
    tiles
}

/// What one load says; `None` where it is not admissible.
fn mark(at: &Difference, verdicts: &Verdicts, quantity: ComparedQuantity) -> Option<Mark> {
    let estimate = at.estimates[quantity as usize].filter(|_| at.exceeded().is_none())?;
    if verdicts.is_blocked {
        return Some(UNFIT);
    }
    Some(of_verdict(Verdict::from_estimate(&estimate, verdicts.accepted.band(quantity)), estimate.contrast))
}

fn of_verdict(verdict: Verdict, difference: f64) -> Mark {
    match verdict {
        Verdict::Within | Verdict::VeryLikelyWithin => WITHIN,
        Verdict::Beyond | Verdict::VeryLikelyBeyond if difference > 0.0 => TOO_LARGE,
        Verdict::Beyond | Verdict::VeryLikelyBeyond => TOO_SMALL,
        Verdict::CannotTell => OPEN,
    }
}

/// What a verdict as tables name it says of a difference; `None` where there is none.
pub fn named(verdict: &str, difference: f64) -> Option<Mark> {
    match verdict {
        "blocked" => Some(UNFIT),
        name => {
            let known = Verdict::ALL.into_iter().find(|one| one.name() == name)?;
            Some(of_verdict(known, difference))
        }
    }
}
