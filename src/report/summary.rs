//! `summary.json` and `timing.json`: what ran, on what, and what came out, for machines.

use indexmap::IndexMap;
use serde::Serialize;

use super::limit::Slope;
use crate::asperity::Population;
use crate::experiment::MapFacts;
use crate::experiment::results::{CompareResults, Head, LimitResults, SurfaceResults};

/// The name by which a report says that this program wrote it.
pub const PROGRAM: &str = "asperity";

#[derive(Serialize)]
struct Summary<'a> {
    program: &'static str,
    version: &'static str,
    title: &'a str,
    spec_sha256: &'a str,
    seed: u64,
    reduced_modulus_pa: f64,
    hardness_pa: Option<f64>,
    surfaces: IndexMap<&'a str, SurfaceSummary<'a>>,
    largest_gaps: Vec<GapSummary<'a>>,
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    slopes: Vec<SlopeSummary<'a>>,
    papers: Vec<&'static str>,
    files: &'a [String],
}

#[derive(Serialize)]
struct SurfaceSummary<'a> {
    asperities: usize,
    nominal_area_m2: f64,
    density_per_m2: f64,
    mean_height_m: f64,
    offset_to_mean_plane_m: Option<f64>,
    sigma_m: f64,
    skewness: Option<f64>,
    kurtosis: Option<f64>,
    mean_radius_m: f64,
    radius_of_mean_curvature_m: f64,
    radius_cv: f64,
    height_radius_correlation: Option<f64>,
    plasticity_index: Option<f64>,
    statistical_model: PopulationSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_map: Option<MapSummary>,
    warnings: &'a [String],
}

/// What the statistical model stood on.
#[derive(Serialize)]
struct PopulationSummary {
    heights: &'static str,
    radius_m: f64,
    sigma_m: f64,
    density_per_m2: f64,
}

#[derive(Serialize)]
struct MapSummary {
    points: [usize; 2],
    pixel_m: [f64; 2],
    missing_points: usize,
    tested_points: usize,
    level: &'static str,
    filter: Option<String>,
    sa_m: f64,
    sq_m: f64,
    ssk: Option<f64>,
    sku: Option<f64>,
    summits: usize,
    plateaus: usize,
    dropped_plateaus: usize,
    height_step_m: Option<f64>,
    height_levels: usize,
    distinct_curvatures: usize,
    median_summit_drop_m: f64,
}

#[derive(Serialize)]
struct GapSummary<'a> {
    surface: &'a str,
    realisation: usize,
    law: &'a str,
    quantity: &'static str,
    pairing: &'static str,
    target: f64,
    statistical: f64,
    deterministic: f64,
    difference: f64,
    over_sampling_error: Option<f64>,
}

#[derive(Serialize)]
struct SlopeSummary<'a> {
    law: &'a str,
    quantity: &'static str,
    heights: &'static str,
    separation_over_sigma: f64,
    slope: f64,
    standard_error: f64,
    points: usize,
}

impl<'a> Summary<'a> {
    fn new(head: &'a Head, files: &'a [String]) -> Self {
        Self {
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: &head.title,
            spec_sha256: &head.spec_sha256,
            seed: head.seed,
            reduced_modulus_pa: head.reduced_modulus,
            hardness_pa: head.hardness,
            surfaces: IndexMap::new(),
            largest_gaps: Vec::new(),
            warnings: Vec::new(),
            slopes: Vec::new(),
            papers: head.papers.iter().map(|paper| paper.full).collect(),
            files,
        }
    }
}

/// `summary.json` of a comparison; `files` are the names of all files of the report.
///
/// # Errors
/// None that a result can cause.
pub fn compare(results: &CompareResults, files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = Summary::new(&results.head, files);
    summary.warnings = results.warnings();
    for found in &results.surfaces {
        summary.surfaces.insert(&found.surface.name, surface(found));
        for case in &found.cases {
            summary.largest_gaps.extend(case.gaps.largest.iter().map(|gap| GapSummary {
                surface: &found.surface.name,
                realisation: 1,
                law: &case.law,
                quantity: gap.quantity,
                pairing: gap.pairing.name(),
                target: gap.target,
                statistical: gap.statistical,
                deterministic: gap.deterministic,
                difference: gap.difference(),
                over_sampling_error: gap.over_sampling_error,
            }));
        }
    }
    serde_json::to_vec_pretty(&summary)
}

/// `summary.json` of a limit.
///
/// # Errors
/// None that a result can cause.
pub fn limit(results: &LimitResults, slopes: &[Slope], files: &[String]) -> serde_json::Result<Vec<u8>> {
    let mut summary = Summary::new(&results.head, files);
    summary.slopes = slopes
        .iter()
        .map(|slope| SlopeSummary {
            law: slope.law,
            quantity: slope.quantity.name(),
            heights: slope.heights.name(),
            separation_over_sigma: slope.separation,
            slope: slope.fit.slope,
            standard_error: slope.fit.standard_error,
            points: slope.fit.points,
        })
        .collect();
    serde_json::to_vec_pretty(&summary)
}

fn surface(found: &SurfaceResults) -> SurfaceSummary<'_> {
    let (surface, statistics) = (&found.surface, &found.surface.statistics);
    SurfaceSummary {
        asperities: surface.set.count(),
        nominal_area_m2: surface.set.nominal_area(),
        density_per_m2: surface.set.density(),
        mean_height_m: statistics.mean_height,
        offset_to_mean_plane_m: surface.offset_to_mean_plane(),
        sigma_m: statistics.sigma,
        skewness: statistics.skewness,
        kurtosis: statistics.kurtosis,
        mean_radius_m: statistics.mean_radius,
        radius_of_mean_curvature_m: statistics.radius_of_mean_curvature,
        radius_cv: statistics.radius_cv,
        height_radius_correlation: statistics.height_radius_correlation,
        plasticity_index: found.cases.first().and_then(|case| case.plasticity_index),
        statistical_model: population(&found.population),
        height_map: surface.map.as_ref().map(map),
        warnings: &surface.warnings,
    }
}

fn population(population: &Population) -> PopulationSummary {
    PopulationSummary {
        heights: population.heights.name(),
        radius_m: population.radius,
        sigma_m: population.sigma,
        density_per_m2: population.density,
    }
}

fn map(map: &MapFacts) -> MapSummary {
    MapSummary {
        points: map.points,
        pixel_m: map.pixel,
        missing_points: map.missing,
        tested_points: map.tested,
        level: map.level.name(),
        filter: map.filter.clone(),
        sa_m: map.moments.sa,
        sq_m: map.moments.sq,
        ssk: map.moments.ssk,
        sku: map.moments.sku,
        summits: map.summits,
        plateaus: map.plateaus,
        dropped_plateaus: map.dropped,
        height_step_m: map.quantisation.step,
        height_levels: map.quantisation.levels,
        distinct_curvatures: map.quantisation.distinct_curvatures,
        median_summit_drop_m: map.quantisation.median_drop,
    }
}

#[derive(Serialize)]
struct Times {
    read_s: f64,
    generate_s: f64,
    summits_s: f64,
    statistical_s: f64,
    deterministic_s: f64,
    report_s: f64,
    total_s: f64,
}

/// `timing.json`, given the time that pages, tables and pictures took.
///
/// # Errors
/// None that a result can cause.
pub fn timing(head: &Head, report: std::time::Duration) -> serde_json::Result<Vec<u8>> {
    let timing = &head.timing;
    serde_json::to_vec_pretty(&Times {
        read_s: timing.read.as_secs_f64(),
        generate_s: timing.generate.as_secs_f64(),
        summits_s: timing.summits.as_secs_f64(),
        statistical_s: timing.statistical.as_secs_f64(),
        deterministic_s: timing.deterministic.as_secs_f64(),
        report_s: report.as_secs_f64(),
        total_s: (timing.total + report).as_secs_f64(),
    })
}
