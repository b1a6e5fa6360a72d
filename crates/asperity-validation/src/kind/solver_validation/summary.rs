//! Summary of `[solver-validation]`.

use serde::Serialize;
use serde_json::{Map, Value};

use super::findings::{Beside, PUBLISHED_WITHIN};
use super::run::SolverResults;
use crate::solver::Problem;
use crate::solver::ensemble::Mean;
use asperity_framework::fields;

#[derive(Serialize)]
struct Summary {
    solver_validation: SolverSummary,
}

#[derive(Serialize)]
struct SolverSummary {
    problems: Vec<ProblemSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    order_of_indentation: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ensemble: Option<EnsembleSummary>,
    most_convolutions: Option<usize>,
}

#[derive(Serialize)]
struct ProblemSummary {
    problem: &'static str,
    comparisons: usize,
    within_bounds: bool,
}

#[derive(Serialize)]
struct EnsembleSummary {
    surfaces: usize,
    rms_gradient: f64,
    rms_height_m: f64,
    rms_height_standard_error_m: f64,
    allowed_difference: f64,
    areas: Vec<AreaSummary>,
    kappa: Vec<KappaSummary>,
}

#[derive(Serialize)]
struct AreaSummary {
    pressure_over_modulus: f64,
    difference: f64,
    standard_error: f64,
    within: bool,
}

#[derive(Serialize)]
struct KappaSummary {
    reduced_pressure: f64,
    kappa: f64,
    standard_error: f64,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &SolverResults) -> serde_json::Result<Map<String, Value>> {
    let problems = Problem::ALL.into_iter().filter_map(|problem| {
        let of_problem: Vec<_> = results.measured.iter().filter(|one| one.problem == problem).collect();
        let within_bounds = of_problem.iter().all(|one| one.holds());
        let comparisons = of_problem.len();
        (comparisons > 0).then(|| ProblemSummary { problem: problem.name(), comparisons, within_bounds })
    });
    let area = |one: &Beside| AreaSummary {
        pressure_over_modulus: one.pressure,
        difference: one.difference.mean,
        standard_error: one.difference.error,
        within: one.holds(),
    };
    let kappa = |&(reduced_pressure, Mean { mean, error }): &(f64, Mean)| KappaSummary {
        reduced_pressure,
        kappa: mean,
        standard_error: error,
    };
    let ensemble = results.ensemble.as_ref().map(|found| EnsembleSummary {
        surfaces: found.realisations,
        rms_gradient: found.gradient,
        rms_height_m: found.height.mean,
        rms_height_standard_error_m: found.height.error,
        allowed_difference: PUBLISHED_WITHIN,
        areas: results.findings.beside.iter().map(area).collect(),
        kappa: results.findings.kappa.iter().map(kappa).collect(),
    });
    fields(&Summary {
        solver_validation: SolverSummary {
            problems: problems.collect(),
            order_of_indentation: results.findings.order,
            ensemble,
            most_convolutions: results.work.iter().map(|point| point.convolutions).max(),
        },
    })
}
