//! The page: each test with its claim, its figure, and its errors.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{listed, quantity, ratio};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::report::view::View;
use asperity_plot::Figure;
use serde_json::{Map, Value, json};

use super::claims::claims;
use super::figures;
use super::results::{
    Deviation, ErrorRow, PUBLISHED_WITHIN, SolverResults, exceeded, fitted_order, grid_warnings, order,
    warnings,
};
use super::rows::{AreaRow, tables};
use crate::solver::ensemble::{EnsemblePoint, EnsembleResults};
use crate::solver::grid::GridPoint;
use crate::solver::published::{ENSEMBLE, RMS_HEIGHT};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity, Problem};

impl Outcome for SolverResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = warnings(&self.benchmarks, self.ensemble.as_ref());
        warnings.extend(grid_warnings(&self.grid));
        warnings
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
        let grid = tables.view::<&GridPoint>();
        if !grid.is_empty() {
            page.heading(2, "Bounds of the errors by the grid")
                .note(include_str!("notes/grid.md"))
                .view(&grid);
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
        let ensemble = self.ensemble.as_ref().map(|EnsembleResults { realisations, height, .. }| {
            json!({
                "surfaces": realisations,
                "rms_gradient": ENSEMBLE.gradient,
                "rms_height_m": height.mean,
                "rms_height_standard_error_m": height.error,
                "allowed_difference": PUBLISHED_WITHIN,
            })
        });
        let facts = json!({
            "order_of_indentation": order(&self.benchmarks),
            "ensemble": ensemble,
            "parts_beyond_grid_bounds": exceeded(&self.grid),
            "most_convolutions": self.work.iter().map(|point| point.convolutions).max(),
        });
        Ok(Map::from_iter([("solver_validation".to_owned(), facts)]))
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

/// "Convergence: width with order 1.52 and mean gap with order 2.00. " Empty of fewer than three grids.
fn convergence(benchmarks: &[Benchmark], problem: Problem, named: &[(BenchmarkQuantity, &str)]) -> String {
    let order = |(quantity, name): &(BenchmarkQuantity, &str)| {
        Some(format!("{name} with order {}", ratio(fitted_order(benchmarks, problem, *quantity)?)))
    };
    let orders: Vec<String> = named.iter().filter_map(order).collect();
    if orders.is_empty() { String::new() } else { format!("Convergence: {}. ", listed(&orders)) }
}

fn known_solutions(page: &mut Page, results: &SolverResults, tables: &Tables) {
    use BenchmarkQuantity::{Area, Indentation, MeanGap, Pressures};
    let benchmarks = &results.benchmarks;
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
            &format!(
                "{}Left: pressure of each pixel over Hertz's peak p₀. Right: errors against resolution, with lines of orders 1 and 2.",
                convergence(
                    benchmarks,
                    Problem::Hertz,
                    &[(Indentation, "indentation"), (Area, "corrected area")]
                ),
            ),
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
            &format!(
                "{}Left: pressures (points) and the exact ones (lines) over their maximum in full contact. Right: the largest errors over \
                 the loads, with lines of orders 1 and 2.",
                convergence(
                    benchmarks,
                    Problem::Sinusoid,
                    &[(Area, "width"), (Pressures, "pressures"), (MeanGap, "mean gap")]
                ),
            ),
        ),
        &largest(Problem::Sinusoid, "points per wavelength"),
    );
    let layered = tables.view::<&Benchmark>().only("problem", Problem::LayeredSphere.name());
    let indentation = layered.only("benchmark_quantity", BenchmarkQuantity::Indentation.name());
    section(
        page,
        "Sphere on a bonded layer",
        include_str!("notes/layered.md"),
        (
            "layered-sphere.svg",
            || figures::layered(results),
            "Errors of the indentation against contact radius, by Young's modulus of the layer on that of the substrate.",
        ),
        &indentation
            .columns(&["problem_case", "exact_value", "measured_error", "allowed_error"])
            .label("exact_value", "exact indentation")
            .label("measured_error", "relative error of the indentation"),
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
        page.view(&areas.without(&["points_per_shortest_wave", "reduced_pressure", "kappa"]));
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

#[cfg(test)]
mod tests {
    use super::super::results::{ERRORS, MOST_SAMPLING};
    use super::*;
    use crate::solver::DUAL_GAP;
    use crate::solver::grid::{CAP, ELONGATION, FINE};
    use crate::solver::work::POINTS_PER_WAVE;

    #[test]
    fn orders_need_three_grids() {
        let benchmark = |points: usize| Benchmark {
            problem: Problem::Hertz,
            case: String::new(),
            points,
            quantity: BenchmarkQuantity::Indentation,
            exact: None,
            computed: None,
            error: (points as f64).powi(-2),
            allowed: None,
        };
        let benchmarks = [16, 32, 64].map(benchmark);
        let named = [(BenchmarkQuantity::Indentation, "indentation"), (BenchmarkQuantity::Area, "area")];
        let caption = convergence(&benchmarks, Problem::Hertz, &named);
        assert_eq!(caption, "Convergence: indentation with order 2.00. ");
        assert_eq!(convergence(&benchmarks[..2], Problem::Hertz, &named), "");
        assert_eq!(convergence(&benchmarks, Problem::Sinusoid, &named), "");
    }

    #[test]
    fn the_notes_state_the_constants() {
        assert!(include_str!("notes/method.md").contains(&format!("a relative dual gap of {DUAL_GAP:e}:")));
        assert!(include_str!("notes/work.md").contains(&format!("to {POINTS_PER_WAVE} points")));
        assert!(
            include_str!("notes/deviations.md").contains(&format!("at most {} %", 100.0 * MOST_SAMPLING))
        );
        assert!(include_str!("notes/ensemble.md").contains(&format!("g = {} of", ENSEMBLE.gradient)));
        assert!(include_str!("notes/grid.md").contains(&format!("on {FINE} points per shortest wave")));
        // In the meanings of columns.
        assert_eq!((PUBLISHED_WITHIN, ERRORS), (0.05, 2.0));
        assert_eq!((CAP, ELONGATION), (0.2, 3.0));
    }
}
