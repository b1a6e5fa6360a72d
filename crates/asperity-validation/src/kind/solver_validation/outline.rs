//! The page: what all tests show, then each with its figure and its errors.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{listed, quantity, ratio};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::report::view::View;
use asperity_plot::Figure;
use serde_json::{Map, Value, json};

use super::claims::answer;
use super::figures;
use super::results::{
    Deviation, ErrorRow, PUBLISHED_WITHIN, SolverResults, exceeded, fitted_order, grid_warnings, growth,
    order, warnings,
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
        page.lead(&answer(self));
        // The figure of the first part is on the page, the others are folded.
        let mut parts = parts(self, tables).into_iter().filter(|part| !part.view.is_empty());
        if let Some(first) = parts.next() {
            page.figure(first.file, first.figure, &first.caption);
            sections::warnings(&mut page, &self.warnings());
            page.details(2, first.title, |page| {
                page.view(&first.view);
            });
        }
        for Part { title, file, figure, caption, view } in parts {
            page.details(2, title, |page| {
                page.figure(file, figure, &caption).view(&view);
                if let Some(ensemble) = self.ensemble.as_ref().filter(|_| title == ENSEMBLE_TITLE) {
                    published_ensemble(page, ensemble, tables);
                }
            });
        }
        sections::notes(&mut page, &self.metadata);
        page.heading(2, "Set-up");
        page.paragraph("Method: [theory](../../docs/theory.md#how-the-reference-is-checked).");
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

/// A figure and its table.
struct Part<'a> {
    title: &'static str,
    file: &'static str,
    figure: Figure,
    caption: String,
    view: View<'a>,
}

const ENSEMBLE_TITLE: &str = "Published ensemble";

/// "Convergence: width with order 1.52 and mean gap with order 2.00. " Empty of fewer than three grids.
fn convergence(benchmarks: &[Benchmark], problem: Problem, named: &[(BenchmarkQuantity, &str)]) -> String {
    let order = |(quantity, name): &(BenchmarkQuantity, &str)| {
        Some(format!("{name} with order {}", ratio(fitted_order(benchmarks, problem, *quantity)?)))
    };
    let orders: Vec<String> = named.iter().filter_map(order).collect();
    if orders.is_empty() { String::new() } else { format!("Convergence: {}. ", listed(&orders)) }
}

fn parts<'a>(results: &SolverResults, tables: &'a Tables) -> Vec<Part<'a>> {
    use BenchmarkQuantity::{Area, Indentation, MeanGap, Pressures};
    let benchmarks = &results.benchmarks;
    let largest = |problem: Problem, resolution: &'static str| {
        let view = tables.view::<ErrorRow>().only("problem", problem.name());
        view.without(&["comparisons", "within_bounds"]).label("resolution", resolution)
    };
    let layered = tables.view::<&Benchmark>().only("problem", Problem::LayeredSphere.name());
    let indentation = layered.only("benchmark_quantity", BenchmarkQuantity::Indentation.name());
    let mut parts = vec![
        Part {
            title: "Hertz",
            file: "hertz.svg",
            figure: figures::hertz(results),
            caption: format!(
                "{}Left: pressure of each pixel over Hertz's peak p₀. Right: errors against resolution, with lines of orders 1 and 2.",
                convergence(
                    benchmarks,
                    Problem::Hertz,
                    &[(Indentation, "indentation"), (Area, "corrected area")]
                ),
            ),
            view: largest(Problem::Hertz, "pixels per contact radius"),
        },
        Part {
            title: "Wavy surface",
            file: "sinusoid.svg",
            figure: figures::sinusoid(results),
            caption: format!(
                "{}Left: computed (points) and exact pressures (lines). Right: the largest errors, with lines of orders 1 and 2.",
                convergence(
                    benchmarks,
                    Problem::Sinusoid,
                    &[(Area, "width"), (Pressures, "pressures"), (MeanGap, "mean gap")]
                ),
            ),
            view: largest(Problem::Sinusoid, "points per wavelength"),
        },
        Part {
            title: "Sphere on a bonded layer",
            file: "layered-sphere.svg",
            figure: figures::layered(results),
            caption: "Errors of the indentation against contact radius, by Young's modulus of the layer on that of the substrate."
                .to_owned(),
            view: indentation
                .columns(&["problem_case", "exact_value", "measured_error", "allowed_error"])
                .label("exact_value", "exact indentation")
                .label("measured_error", "relative error of the indentation"),
        },
    ];
    let areas = tables.view::<AreaRow>().without(&["reduced_pressure", "kappa", "kappa_standard_error"]);
    parts.extend(results.ensemble.as_ref().map(|ensemble| Part {
        title: ENSEMBLE_TITLE,
        file: "ensemble.svg",
        figure: figures::ensemble(ensemble),
        caption: "Above: area against pressure. Below: difference from the published area.".to_owned(),
        view: areas,
    }));
    parts.push(Part {
        title: "Bounds of the errors by the grid",
        file: "grid.svg",
        figure: figures::grid(&results.grid),
        caption: "Share of the contacts whose error exceeds the bound that the reference states, against points per shortest wave on the \
                  coarser axis; of all contacts 5 % may."
            .to_owned(),
        view: tables.view::<&GridPoint>(),
    });
    let growth = growth(&results.work).map_or_else(String::new, |[low, high]| {
        let (low, high) = (ratio(low), ratio(high));
        let power = if low == high { low } else { format!("{low} to {high}") };
        format!(" They grow with the points to the power {power}.")
    });
    parts.push(Part {
        title: "Work",
        file: "work.svg",
        figure: figures::work(&results.work),
        caption: format!("Convolutions against points along a side.{growth}"),
        view: tables.view::<&WorkPoint>(),
    });
    parts
}

/// What a published ensemble has besides its figure and its areas.
fn published_ensemble(page: &mut Page, ensemble: &EnsembleResults, tables: &Tables) {
    page.details(3, "Areas on each grid", |page| {
        let areas = tables.view::<&EnsemblePoint>().filter("grid_points", |points| !points.is_empty());
        page.view(&areas.without(&["points_per_shortest_wave", "reduced_pressure", "kappa"]));
    });
    page.details(3, "Effect of the grid", |page| {
        page.view(&tables.view::<Deviation>());
    });
    if !ensemble.extrapolated.is_empty() {
        page.heading(3, "Proportionality at light loads").figure(
            "kappa.svg",
            figures::kappa(ensemble),
            "κ, the area over the reduced pressure, beside two theories: each gives a constant at vanishing load, Persson's also a curve \
             for all loads.",
        );
        page.view(&tables.view::<AreaRow>().columns(&["reduced_pressure", "kappa", "kappa_standard_error"]));
    }
    page.table(
        ["r.m.s. height", "standard error", "surfaces", "published"],
        [vec![
            quantity(ensemble.height.mean, "m"),
            quantity(ensemble.height.error, "m"),
            ensemble.realisations.to_string(),
            quantity(RMS_HEIGHT, "m"),
        ]],
    );
}

#[cfg(test)]
mod tests {
    use super::super::results::{ERRORS, MOST_SAMPLING};
    use super::*;
    use crate::solver::DUAL_GAP;
    use crate::solver::grid::{CAP, ELONGATION, FINE, MAY_EXCEED};
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
    fn the_theory_states_the_constants() {
        let theory = include_str!("../../../../../docs/theory.md");
        let (_, method) = theory.split_once("\n### How the reference is checked\n").unwrap();
        assert!(method.contains(&format!("a relative dual gap of {DUAL_GAP:e}")));
        assert!(method.contains(&format!("to {POINTS_PER_WAVE} points, solved from")));
        assert!(method.contains(&format!("is at most {} %", 100.0 * MOST_SAMPLING)));
        assert!(method.contains(&format!("$g={}$", ENSEMBLE.gradient)));
        assert!(method.contains(&format!("{FINE} points per shortest wave")));
        // In the meanings of columns.
        assert_eq!((PUBLISHED_WITHIN, ERRORS), (0.05, 2.0));
        assert_eq!((CAP, ELONGATION, MAY_EXCEED), (0.2, 3.0, 0.05));
    }
}
