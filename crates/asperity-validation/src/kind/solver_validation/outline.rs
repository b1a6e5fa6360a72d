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
use super::results::{
    Deviation, ERRORS, ErrorRow, LOWEST_ORDER, PUBLISHED_WITHIN, SolverResults, errors, growth, is_near,
    order, warnings,
};
use super::rows::{AreaRow, tables};
use crate::solver::ensemble::{EnsemblePoint, EnsembleResults, Mean, bush_gibson_thomas, persson};
use crate::solver::published::{ENSEMBLE, RMS_HEIGHT};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, Problem, Quantity};

impl Outcome for SolverResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.benchmarks, self.ensemble.as_ref())
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
        if let Some(order) = order(&self.benchmarks) {
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
    let largest = |problem: Problem, resolution: &'static str| {
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
        &largest(Problem::Hertz, "pixels per contact radius"),
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
        &largest(Problem::Sinusoid, "points per wavelength"),
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
    let benchmarks = results.benchmarks.as_slice();
    let finest = Problem::ALL.into_iter().filter_map(|problem| {
        errors(benchmarks).filter(|errors| errors.problem() == problem).max_by_key(ErrorRow::points)
    });
    let extrapolated = results.ensemble.as_ref().map_or(&[][..], |ensemble| &ensemble.extrapolated);
    let mut claims: Vec<String> = bounds_claim(benchmarks).into_iter().collect();
    claims.extend(finest.map(error_claim));
    claims.extend(order(benchmarks).map(order_claim));
    claims.extend(area_claim(extrapolated));
    claims.extend(extrapolated.first().map(kappa_claim));
    claims.extend(work_claim(&results.work));
    claims
}

fn bounds_claim(benchmarks: &[Benchmark]) -> Option<String> {
    let bounds = benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let exceeded = benchmarks.iter().filter(|benchmark| !benchmark.is_within()).count();
    match (bounds, exceeded) {
        (0, _) => None,
        (_, 0) => Some(format!("**Known solutions**: all {bounds} errors that have a bound are within it.")),
        _ => Some(format!("**Known solutions**: {exceeded} of {bounds} errors exceed their bound.")),
    }
}

/// The errors at one resolution that have a bound. Those near rounding differ between machines and are not told apart.
fn error_claim(errors: ErrorRow) -> String {
    const ROUNDING: f64 = 1e-12;
    let (problem, points) = match errors.problem() {
        Problem::Hertz => ("Hertz", "pixels per contact radius"),
        Problem::Sinusoid => ("Wavy surface", "points per wavelength"),
        Problem::FullContact => ("Full contact, with and without a layer", "points per wavelength"),
        Problem::LayeredSphere => ("Sphere on a layer", "pixels per contact radius"),
    };
    let claim = |quantity: Quantity| {
        let Benchmark { error, allowed, .. } = errors.largest(quantity)?;
        let (error, allowed) = (number(error.abs().max(ROUNDING)), number((*allowed)?));
        let quantity = quantity.words().trim_end_matches(" (r.m.s.)");
        Some(format!("{quantity} within {error} (allowed: {allowed})"))
    };
    let bounded = [Quantity::Indentation, Quantity::Area, Quantity::MeanGap, Quantity::Pressures];
    let claims: Vec<String> = bounded.into_iter().filter_map(claim).collect();
    format!("**{problem}** ({} {points}): {}.", errors.points(), listed(&claims))
}

fn order_claim(order: f64) -> String {
    let only = if order < LOWEST_ORDER { " only" } else { "" };
    let order = ratio(order);
    format!(
        "**Convergence**: Hertz's indentation with order {order}{only} (allowed: at least {LOWEST_ORDER})."
    )
}

/// How far extrapolated areas are from the published ones.
fn area_claim(extrapolated: &[EnsemblePoint]) -> Option<String> {
    let differences = || extrapolated.iter().filter_map(|point| Some((point.pressure, point.difference()?)));
    let count = |is_counted: fn(Mean) -> bool| differences().filter(|(_, it)| is_counted(*it)).count();
    let (pressure, largest) = differences().max_by(|(_, a), (_, b)| a.mean.abs().total_cmp(&b.mean.abs()))?;
    Some(format!(
        "**Published ensemble**: {} of {} extrapolated areas are within {} and two standard errors of the published ones; {} differ by \
         more than two standard errors. The largest difference is {} ± {} (at p/E\\* = {}).",
        count(is_near),
        differences().count(),
        percent(PUBLISHED_WITHIN),
        count(|it| it.mean.abs() > ERRORS * it.error),
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
    let WorkPoint { points, pressure, convolutions, error, .. } =
        work.iter().max_by_key(|point| point.convolutions)?;
    let growth = growth(work).map_or_else(String::new, |[low, high]| {
        let (low, high) = (ratio(low), ratio(high));
        format!("; their number grows with the points along a side to the power {low} to {high}")
    });
    Some(format!(
        "**Work**: at most {convolutions} convolutions to a dual gap of {}, on {points} x {points} points at p/(E\\* g) = {}{growth}.",
        number(*error),
        number(*pressure)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn benchmark(problem: Problem, quantity: Quantity, error: f64, allowed: Option<f64>) -> Benchmark {
        Benchmark {
            problem,
            case: String::new(),
            points: 64,
            quantity,
            exact: None,
            computed: None,
            error,
            allowed,
        }
    }

    #[test]
    fn errors_and_their_bounds() {
        let all = [
            benchmark(Problem::Hertz, Quantity::Indentation, -1e-5, Some(2e-5)),
            benchmark(Problem::Hertz, Quantity::RawArea, 0.01, None),
            benchmark(Problem::Hertz, Quantity::Pressures, 0.004, Some(0.003)),
        ];
        assert_eq!(
            error_claim(ErrorRow(&all)),
            "**Hertz** (64 pixels per contact radius): indentation within 1e-5 (allowed: 2e-5) and pressures within 0.004 (allowed: 0.003)."
        );
        let rounding = [benchmark(Problem::FullContact, Quantity::Pressures, 3e-15, Some(1e-12))];
        assert!(error_claim(ErrorRow(&rounding)).ends_with("pressures within 1e-12 (allowed: 1e-12)."));
        assert!(bounds_claim(&all).unwrap().contains("1 of 2 errors exceed"));
        assert!(bounds_claim(&all[..2]).unwrap().contains("all 1 errors"));
        assert_eq!(bounds_claim(&all[1..2]), None);
    }

    #[test]
    fn a_low_order_is_said() {
        assert!(order_claim(1.98).contains("order 1.98 (allowed"));
        assert!(order_claim(1.5).contains("order 1.50 only (allowed"));
    }

    #[test]
    fn areas_beside_the_published_ones() {
        let point = |pressure: f64, mean: f64, error: f64| {
            let area = Mean { mean, error };
            EnsemblePoint { points: None, pressure, raw_area: area, area, gap: None }
        };
        // Published: 0.077_926_64 and 0.185_244_2.
        let near = point(0.01, 0.0763, 1e-4);
        assert!(area_claim(&[near.clone(), point(0.025, 0.2, 1e-4)]).unwrap().starts_with(
            "**Published ensemble**: 1 of 2 extrapolated areas are within 5 % and two standard errors of the published ones; 2 differ"
        ));
        let claim = area_claim(std::slice::from_ref(&near)).unwrap();
        assert!(
            claim.ends_with("The largest difference is -2.09 % ± 0.128 % (at p/E\\* = 0.01)."),
            "{claim}"
        );
        assert_eq!(area_claim(&[point(0.02, 0.1, 0.0)]), None);
        assert!(
            kappa_claim(&near).contains("is 2.11 ± 0.0028 at p/(E\\* g) = 0.0362"),
            "{}",
            kappa_claim(&near)
        );
    }

    #[test]
    fn the_most_work() {
        let contact = |points: usize| WorkPoint {
            points,
            pressure: 0.02,
            area: 0.1,
            steps: 9,
            convolutions: points,
            error: 1e-8,
        };
        let work = [64, 128, 256].map(contact);
        let claim = work_claim(&work).unwrap();
        assert!(
            claim.contains("256 convolutions") && claim.ends_with("to the power 1.00 to 1.00."),
            "{claim}"
        );
        assert!(work_claim(&work[..2]).unwrap().ends_with("g) = 0.02."));
        assert_eq!(work_claim(&[]), None);
    }
}
