//! The page: each test with its claim, its figure, and its errors.

use asperity_framework::Outcome;
use asperity_framework::metadata::Metadata;
use asperity_framework::report::format::{
    input_number, listed, mean_and_deviation, number, percent, quantity, ratio,
};
use asperity_framework::report::page::Page;
use asperity_framework::report::sections;
use asperity_framework::report::table::{Table, Tables};
use asperity_framework::report::view::View;
use asperity_plot::Figure;
use serde_json::{Map, Value, json};

use super::figures;
use super::results::{Deviation, ErrorRow, LOWEST_ORDER, PUBLISHED_WITHIN, SolverResults, growth, is_near};
use super::rows::{AreaRow, tables};
use crate::solver::ensemble::{EnsemblePoint, EnsembleResults, bush_gibson_thomas, persson};
use crate::solver::published::{ENSEMBLE, RMS_HEIGHT};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, Problem, Quantity};

impl Outcome for SolverResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        sections::findings(&mut page, claims(self));
        sections::warnings(&mut page, &self.warnings());
        known_solutions(&mut page, self, tables);
        if let Some(ensemble) = &self.ensemble {
            published_ensemble(&mut page, ensemble, tables);
        }
        section(
            &mut page,
            "Work",
            include_str!("notes/work.md"),
            ("work.svg", || figures::work(&self.work), "Convolutions against points along a side."),
            &tables.view::<&WorkPoint>(),
        );
        page.heading(2, "Method").note(include_str!("notes/method.md"));
        sections::notes(&mut page, &self.metadata);
        page.paragraph(&sections::provenance(&self.metadata));
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = Map::new();
        if let Some(order) = self.order() {
            facts.insert("order_of_indentation".to_owned(), json!(order));
        }
        if let Some(EnsembleResults { realisations, height, .. }) = &self.ensemble {
            let ensemble = json!({
                "surfaces": realisations,
                "rms_gradient": ENSEMBLE.gradient,
                "rms_height_m": height.mean,
                "rms_height_standard_error_m": height.error,
                "allowed_difference": PUBLISHED_WITHIN,
            });
            facts.insert("ensemble".to_owned(), ensemble);
        }
        let most = self.work.iter().map(|point| point.convolutions).max();
        facts.insert("most_convolutions".to_owned(), json!(most));
        Ok(Map::from_iter([("solver_validation".to_owned(), Value::Object(facts))]))
    }
}

/// What a section says of its method, a figure and a table; nothing without rows.
fn section(
    page: &mut Page,
    title: &str,
    note: &'static str,
    (file, figure, caption): (&str, impl FnOnce() -> Figure, &str),
    view: &View,
) {
    if !view.is_empty() {
        page.heading(2, title).note(note).figure(file, figure(), caption).view(view);
    }
}

fn known_solutions(page: &mut Page, results: &SolverResults, tables: &Tables) {
    let errors = |problem: Problem, resolution: &'static str| {
        let view = tables.view::<ErrorRow>().only("problem", problem.name());
        view.without(&["comparisons", "within_bounds"]).label("resolution", resolution)
    };
    section(
        page,
        "Hertz",
        include_str!("notes/hertz.md"),
        (
            "hertz.svg",
            || figures::hertz(results),
            "Left: pressure of each pixel over Hertz's peak p₀. Right: errors against resolution, with lines of orders 1 and 2.",
        ),
        &errors(Problem::Hertz, "pixels per contact radius"),
    );
    section(
        page,
        "Wavy surface",
        include_str!("notes/sinusoid.md"),
        (
            "sinusoid.svg",
            || figures::sinusoid(results),
            "Left: pressures (points) and the exact ones (lines) over their maximum in full contact. Right: the largest errors over the \
             loads, with lines of orders 1 and 2.",
        ),
        &errors(Problem::Sinusoid, "points per wavelength"),
    );
    let layered = tables.view::<&Benchmark>().only("problem", Problem::LayeredSphere.name());
    let indentation = layered.only("benchmark_quantity", Quantity::Indentation.name());
    section(
        page,
        "Sphere on a bonded layer",
        include_str!("notes/layered.md"),
        (
            "layered-sphere.svg",
            || figures::layered(results),
            "Errors of the indentation against contact radius, by Young's modulus of the layer on that of the substrate.",
        ),
        &indentation.columns(&["problem_case", "exact_value", "measured_error", "allowed_error"]),
    );
}

fn published_ensemble(page: &mut Page, ensemble: &EnsembleResults, tables: &Tables) {
    page.heading(2, "Published ensemble").note(include_str!("notes/ensemble.md"));
    page.paragraph(&format!(
        "The r.m.s. height becomes {} ± {} (standard error over {} surfaces; published: {}).",
        quantity(ensemble.height.mean, "m"),
        quantity(ensemble.height.error, "m"),
        ensemble.realisations,
        quantity(RMS_HEIGHT, "m"),
    ));
    page.figure(
        "ensemble.svg",
        figures::ensemble(ensemble),
        "Above: area against pressure. Below: difference from the published area.",
    );
    page.view(&tables.view::<AreaRow>().without(&["reduced_pressure", "kappa", "kappa_standard_error"]));
    page.details(3, "Areas on each grid", |page| {
        let areas = tables.view::<&EnsemblePoint>().filter("grid_points", |points| !points.is_empty());
        page.view(&areas.without(&[
            "points_per_shortest_wave",
            "reduced_pressure",
            "kappa",
            "published_deviation",
        ]));
    });
    let deviations = tables.view::<Deviation>();
    if !deviations.is_empty() {
        page.heading(3, "Effect of the grid").note(include_str!("notes/deviations.md")).view(&deviations);
    }
    if !ensemble.extrapolated.is_empty() {
        page.heading(3, "Proportionality at light loads").figure(
            "kappa.svg",
            figures::kappa(ensemble),
            "κ, the area over the reduced pressure, beside two theories: each gives a constant at vanishing load, Persson's also a curve \
             for all loads.",
        );
        page.view(&tables.view::<AreaRow>().columns(&["reduced_pressure", "kappa", "kappa_standard_error"]));
    }
}

/// What each test shows, a line each.
fn claims(results: &SolverResults) -> Vec<String> {
    let mut claims = Vec::new();
    let bounds = results.benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let exceeded = results.errors().map(|errors| errors.exceeded()).sum();
    claims.extend((bounds > 0).then(|| bounds_claim(exceeded, bounds)));
    let finest = Problem::ALL.into_iter().filter_map(|problem| {
        results.errors().filter(|errors| errors.problem() == problem).max_by_key(ErrorRow::points)
    });
    claims.extend(finest.map(error_claim));
    claims.extend(results.order().map(order_claim));
    if let Some(ensemble) = &results.ensemble {
        claims.extend(area_claim(&ensemble.extrapolated));
        claims.extend(ensemble.extrapolated.first().map(kappa_claim));
    }
    claims.extend(work_claim(&results.work));
    claims
}

fn bounds_claim(exceeded: usize, bounds: usize) -> String {
    match exceeded {
        0 => format!("**Known solutions**: all {bounds} errors that have a bound are within it."),
        several => format!("**Known solutions**: {several} of {bounds} errors exceed their bound."),
    }
}

/// The errors at the finest resolution that have a bound. Those near rounding differ between machines and are not told apart.
fn error_claim(errors: ErrorRow) -> String {
    const ROUNDING: f64 = 1e-12;
    let (problem, points) = match errors.problem() {
        Problem::Hertz => ("Hertz", "pixels per contact radius"),
        Problem::Sinusoid => ("Wavy surface", "points per wavelength"),
        Problem::FullContact => ("Full contact", "points per wavelength"),
        Problem::LayeredSphere => ("Sphere on a layer", "pixels per contact radius"),
    };
    let claim = |quantity: Quantity| {
        let Benchmark { error, allowed, .. } = errors.largest(quantity)?;
        let (error, allowed) = (number(error.abs().max(ROUNDING)), number((*allowed)?));
        Some(format!("{} within {error} (allowed: {allowed})", quantity.words()))
    };
    let bounded = [Quantity::Indentation, Quantity::Area, Quantity::MeanGap, Quantity::Pressures];
    let claims: Vec<String> = bounded.into_iter().filter_map(claim).collect();
    format!("**{problem}**: at {} {points} {}.", errors.points(), listed(&claims))
}

fn order_claim(order: f64) -> String {
    let is_lower = if order < LOWEST_ORDER { " only" } else { "" };
    format!(
        "**Convergence**: Hertz's indentation with order {}{is_lower} (allowed: at least {LOWEST_ORDER}).",
        ratio(order)
    )
}

/// How far extrapolated areas are from the published ones.
fn area_claim(extrapolated: &[EnsemblePoint]) -> Option<String> {
    let differences = || extrapolated.iter().filter_map(|point| Some((point.pressure, point.difference()?)));
    let near = differences().filter(|(_, difference)| is_near(*difference)).count();
    let (pressure, largest) = differences().max_by(|(_, a), (_, b)| a.mean.abs().total_cmp(&b.mean.abs()))?;
    Some(format!(
        "**Published ensemble**: extrapolated areas are within {} and two standard errors of the published ones at {near} of {} loads; \
         the largest difference is {} ± {} (at p/E\\* = {}).",
        percent(PUBLISHED_WITHIN),
        differences().count(),
        percent(largest.mean),
        percent(largest.error),
        input_number(pressure),
    ))
}

/// kappa at the lightest load.
fn kappa_claim(lightest: &EnsemblePoint) -> String {
    let kappa = lightest.kappa();
    format!(
        "**Light loads**: κ = A E\\* g/(A₀ p) is {} at p/(E\\* g) = {}; Bush, Gibson and Thomas's is {}, Persson's {}.",
        mean_and_deviation(kappa.mean, kappa.error),
        number(lightest.reduced_pressure()),
        number(bush_gibson_thomas()),
        number(persson()),
    )
}

fn work_claim(work: &[WorkPoint]) -> Option<String> {
    let most = work.iter().max_by_key(|point| point.convolutions)?;
    let growth = growth(work).map_or_else(String::new, |[low, high]| {
        format!(
            "; their number grows with the points along a side to the power {} to {}",
            ratio(low),
            ratio(high)
        )
    });
    Some(format!(
        "**Work**: at most {} convolutions to a dual gap of {}, on {} x {} points at p/(E\\* g) = {}{growth}.",
        most.convolutions,
        number(most.error),
        most.points,
        most.points,
        number(most.pressure)
    ))
}
