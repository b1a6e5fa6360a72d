//! `summary.json` and `timing.json`: what ran, on what, and what came out, for machines.

use indexmap::IndexMap;
use serde::Serialize;

use crate::asperity::Statistics;
use crate::compare::Gap;
use crate::experiment::results::{CompareResults, Head, LimitResults, SurfaceResults, Timing};
use crate::experiment::{MapFacts, PROGRAM};

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
    height_map: Option<MapSummary<'a>>,
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
struct MapSummary<'a> {
    points: [usize; 2],
    pixel_m: [f64; 2],
    missing_points: usize,
    tested_points: usize,
    level: &'static str,
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
    #[serde(skip)]
    _of: std::marker::PhantomData<&'a ()>,
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
