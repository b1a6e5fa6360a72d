//! `summary.json` of a surface in tiles.

use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use indexmap::IndexMap;
use serde::Serialize;
use serde_json::{Map, Value};

use super::results::{LawResults, TiledResults, TiledSurface};

#[derive(Serialize)]
struct TiledSummary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    surfaces: IndexMap<&'a str, SurfaceSummary>,
    laws: Vec<LawSummary<'a>>,
}

#[derive(Serialize)]
struct SurfaceSummary {
    tiles: usize,
    asperities: usize,
    nominal_area_m2: f64,
    mean_height_m: f64,
    sigma_m: f64,
    skewness: Option<f64>,
    kurtosis: Option<f64>,
    mean_radius_m: f64,
    radius_of_mean_curvature_m: f64,
    radius_cv: f64,
    height_radius_correlation: Option<f64>,
}

#[derive(Serialize)]
struct LawSummary<'a> {
    law: &'a str,
    layer_thickness_m: Option<f64>,
    at_separations: Vec<PairSummary>,
}

/// Both models at equal separation.
#[derive(Serialize)]
struct PairSummary {
    separation_over_sigma: f64,
    statistical_over_deterministic_pressure: Option<f64>,
    relative_standard_error_from_tiles: Option<f64>,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &TiledResults) -> serde_json::Result<Map<String, Value>> {
    let TiledSurface { name, tiles, count, nominal_area, origin, statistics, .. } = &results.surface;
    fields(&TiledSummary {
        contact: ContactSummary::of(&results.contact),
        surfaces: IndexMap::from([(
            name.as_str(),
            SurfaceSummary {
                tiles: *tiles,
                asperities: *count,
                nominal_area_m2: *nominal_area,
                mean_height_m: origin + statistics.mean_height,
                sigma_m: statistics.sigma,
                skewness: statistics.skewness,
                kurtosis: statistics.kurtosis,
                mean_radius_m: statistics.mean_radius,
                radius_of_mean_curvature_m: statistics.radius_of_mean_curvature,
                radius_cv: statistics.radius_cv,
                height_radius_correlation: statistics.height_radius_correlation,
            },
        )]),
        laws: results.laws.iter().map(of_law).collect(),
    })
}

fn of_law(law: &LawResults) -> LawSummary<'_> {
    let pairs = law.at_separations().map(|(pair, error)| {
        let [statistical, deterministic] =
            [pair.statistical, pair.deterministic].map(|response| response.pressure.total());
        let over = |value: f64| Some(value / deterministic).filter(|ratio| ratio.is_finite());
        PairSummary {
            separation_over_sigma: pair.target,
            statistical_over_deterministic_pressure: over(statistical),
            relative_standard_error_from_tiles: error.and_then(over),
        }
    });
    LawSummary { law: &law.law, layer_thickness_m: law.thickness, at_separations: pairs.collect() }
}
