//! Summary of run times and errors.

use std::collections::BTreeMap;

use serde::Serialize;

use super::findings::Winner;
use super::names::candidate_name;
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::grid::{GridFindings, Statistic};
use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use serde_json::{Map, Value};

/// Run time against error. Reports are compared here for their shape only.
#[derive(Serialize)]
struct PrecisionSummary<'a> {
    full: bool,
    threads: usize,
    winners: Vec<WinnerSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    curves: Vec<CurveSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    lists: Vec<ListSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    attributions: Vec<AttributionSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tenfold_asperities: Vec<TenfoldSummary<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<SurfaceSummary>,
}

#[derive(Serialize)]
struct WinnerSummary<'a> {
    case: &'a str,
    of: &'static str,
    largest_error: f64,
    fastest: Option<String>,
    error: Option<f64>,
    seconds_per_separation: Option<f64>,
    shipped_over_fastest: Option<f64>,
}

/// Cost of a curve within a tolerance and of the exact curve.
#[derive(Serialize)]
struct CurveSummary<'a> {
    case: &'a str,
    model: &'static str,
    tolerance: f64,
    separations: usize,
    asked: usize,
    error: f64,
    time_over_exact: f64,
}

/// The difference of the largest set divided among its causes.
#[derive(Serialize)]
struct AttributionSummary<'a> {
    case: &'a str,
    asperities: usize,
    loads: usize,
    attribution_s: f64,
    time_over_both_models: f64,
    /// Law by law.
    relative_errors: BTreeMap<&'a str, f64>,
}

/// The longest list from a file.
#[derive(Serialize)]
struct ListSummary<'a> {
    case: &'a str,
    asperities: usize,
    separations: usize,
    read_s: f64,
    sum_s: f64,
    peak_bytes: Option<u64>,
}

/// What ten times the asperities do.
#[derive(Serialize)]
struct TenfoldSummary<'a> {
    case: &'a str,
    time: Option<f64>,
    error: Option<f64>,
}

/// Powers by which errors and time follow points a length, summits and points.
#[derive(Serialize)]
struct SurfaceSummary {
    radius_bias_slope: Option<f64>,
    density_scatter_slope: Option<f64>,
    time_slope: Option<f64>,
}

#[derive(Serialize)]
struct Summary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    precision: PrecisionSummary<'a>,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &PrecisionResults) -> serde_json::Result<Map<String, Value>> {
    let tenfold = results.cases.iter().filter_map(|case| {
        let found = case.sampling.as_ref()?.tenfold();
        Some(TenfoldSummary {
            case: &case.name,
            time: found.map(|tenfold| tenfold.time),
            error: found.map(|tenfold| tenfold.error),
        })
    });
    let precision = PrecisionSummary {
        full: results.full,
        threads: results.threads,
        winners: results.cases.iter().flat_map(winners).collect(),
        curves: results.cases.iter().flat_map(curves).collect(),
        lists: results.cases.iter().filter_map(longest_list).collect(),
        attributions: results.cases.iter().filter_map(largest_attribution).collect(),
        tenfold_asperities: tenfold.collect(),
        surface: results.grid.as_ref().map(surface),
    };
    fields(&Summary { contact: ContactSummary::of(&results.contact), precision })
}

fn winners(case: &CasePrecision) -> impl Iterator<Item = WinnerSummary<'_>> {
    case.findings.winners.iter().map(|&Winner { of, level, fastest, shipped_over_fastest, .. }| {
        WinnerSummary {
            case: &case.name,
            of: of.name(),
            largest_error: level,
            fastest: fastest.map(|(candidate, _)| candidate_name(&candidate)),
            error: fastest.map(|(_, cost)| cost.error),
            seconds_per_separation: fastest.map(|(_, cost)| cost.seconds),
            shipped_over_fastest,
        }
    })
}

fn curves(case: &CasePrecision) -> impl Iterator<Item = CurveSummary<'_>> {
    case.curve.iter().flat_map(|found| {
        found.points.iter().filter_map(|point| {
            Some(CurveSummary {
                case: &case.name,
                model: point.kind.name(),
                tolerance: point.tolerance?,
                separations: point.separations,
                asked: point.evaluated,
                error: point.error(),
                time_over_exact: found.time_ratio(point),
            })
        })
    })
}

fn longest_list(case: &CasePrecision) -> Option<ListSummary<'_>> {
    let longest = case.lists.last()?;
    Some(ListSummary {
        case: &case.name,
        asperities: longest.asperities,
        separations: longest.separations,
        read_s: longest.read_seconds,
        sum_s: longest.sum_seconds,
        peak_bytes: longest.peak_bytes,
    })
}

fn largest_attribution(case: &CasePrecision) -> Option<AttributionSummary<'_>> {
    let found = case.attribution.as_ref()?;
    let largest = found.points.last()?;
    Some(AttributionSummary {
        case: &case.name,
        asperities: largest.asperities,
        loads: largest.loads,
        attribution_s: largest.attribution_seconds,
        time_over_both_models: largest.time_ratio(),
        relative_errors: found.products.iter().map(|product| (&*product.law, product.error)).collect(),
    })
}

fn surface(found: &GridFindings) -> SurfaceSummary {
    SurfaceSummary {
        radius_bias_slope: found.bias_slope(Statistic::Radius),
        density_scatter_slope: found.scatter_slope(Statistic::Density),
        time_slope: found.time_slope(),
    }
}
