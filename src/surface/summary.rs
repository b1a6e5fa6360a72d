//! Surfaces in `summary.json`.

use serde::Serialize;

use crate::surface::found::{GenerationFacts, MapFacts, Surface};
use asperity::topography::Moments;
use asperity::topography::generate::{Process, SigmaOf};
use asperity::topography::spectrum::SpectrumShape;
use asperity::topography::theory::Expected;
use asperity::{Ellipticity, Population, Statistics};
use asperity_framework::input::heights::written;

/// One surface.
#[derive(Serialize)]
pub struct SurfaceSummary<'a> {
    asperities: usize,
    nominal_area_m2: f64,
    density_per_m2: f64,
    #[serde(flatten)]
    statistics: StatisticsSummary,
    offset_to_mean_plane_m: Option<f64>,
    /// Where it is not the mean height of the asperities.
    #[serde(skip_serializing_if = "Option::is_none")]
    separations_from: Option<&'static str>,
    /// Greenwood and Williamson's plasticity index under the first law of a comparison.
    pub plasticity_index: Option<f64>,
    #[serde(flatten)]
    ellipticity: Option<EllipticitySummary>,
    /// The population of the statistical model of a comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statistical_model: Option<PopulationSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height_map: Option<MapSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    generation: Option<GenerationSummary>,
    /// Where there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub realisations: Vec<RealisationSummary>,
    warnings: &'a [String],
}

/// The mean shape of asperities that a law treats as ellipses.
#[derive(Serialize)]
struct EllipticitySummary {
    mean_curvature_per_m: f64,
    /// The larger principal curvature over the smaller one, as in a spec: one over the mean of the smaller over the larger.
    mean_smaller_over_larger_curvature: f64,
}

impl From<Ellipticity> for EllipticitySummary {
    fn from(mean: Ellipticity) -> Self {
        Self {
            mean_curvature_per_m: mean.mean_curvature,
            mean_smaller_over_larger_curvature: mean.mean_ratio,
        }
    }
}

#[derive(Serialize)]
struct StatisticsSummary {
    mean_height_m: f64,
    sigma_m: f64,
    skewness: Option<f64>,
    kurtosis: Option<f64>,
    mean_radius_m: f64,
    radius_of_mean_curvature_m: f64,
    radius_cv: f64,
    height_radius_correlation: Option<f64>,
}

impl From<&Statistics> for StatisticsSummary {
    fn from(statistics: &Statistics) -> Self {
        Self {
            mean_height_m: statistics.mean_height,
            sigma_m: statistics.sigma,
            skewness: statistics.skewness,
            kurtosis: statistics.kurtosis,
            mean_radius_m: statistics.mean_radius,
            radius_of_mean_curvature_m: statistics.radius_of_mean_curvature,
            radius_cv: statistics.radius_cv,
            height_radius_correlation: statistics.height_radius_correlation,
        }
    }
}

/// Inputs of the statistical model.
#[derive(Serialize)]
pub struct PopulationSummary {
    heights: String,
    radius_m: f64,
    sigma_m: f64,
    density_per_m2: f64,
}

impl From<&Population> for PopulationSummary {
    fn from(population: &Population) -> Self {
        Self {
            heights: written(&population.heights),
            radius_m: population.radius,
            sigma_m: population.sigma,
            density_per_m2: population.density,
        }
    }
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
    m0_m2: f64,
    m2: f64,
    m4_per_m2: f64,
    m2_along_x_y: [f64; 2],
    m4_along_x_y_per_m2: [f64; 2],
    nayak_alpha: Option<f64>,
    rms_slope: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    autocorrelation_length_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    texture_aspect_ratio: Option<f64>,
    summit_definition: &'static str,
    summits: usize,
    summits_with_a_saddle: usize,
    plateaus: usize,
    dropped_plateaus: usize,
    five_point_theory: Option<ExpectedSummary>,
    nayak_theory: Option<ExpectedSummary>,
    #[serde(flatten)]
    quantisation: Option<QuantisationSummary>,
}

#[derive(Serialize)]
struct QuantisationSummary {
    height_step_m: Option<f64>,
    height_levels: usize,
    distinct_curvatures: usize,
    median_summit_drop_m: f64,
}

#[derive(Serialize)]
struct ExpectedSummary {
    density_per_m2: f64,
    mean_curvature_per_m: f64,
    mean_height_above_mean_plane_m: f64,
    height_variance_m2: f64,
}

impl From<Expected> for ExpectedSummary {
    fn from(expected: Expected) -> Self {
        Self {
            density_per_m2: expected.density,
            mean_curvature_per_m: expected.curvature,
            mean_height_above_mean_plane_m: expected.height,
            height_variance_m2: expected.height_variance,
        }
    }
}

impl From<&MapFacts> for MapSummary {
    fn from(map: &MapFacts) -> Self {
        let roughness = &map.roughness;
        let [m0, m2, m4] = roughness.spectral_moments();
        let correlation = map.whole.autocorrelation.as_ref();
        Self {
            points: map.points,
            pixel_m: map.pixel,
            missing_points: roughness.missing,
            tested_points: map.tested,
            level: map.level.name(),
            filter: map.filter.map(|filter| filter.to_string()),
            sa_m: roughness.moments.sa,
            sq_m: roughness.moments.sq,
            ssk: roughness.moments.ssk,
            sku: roughness.moments.sku,
            m0_m2: m0,
            m2,
            m4_per_m2: m4,
            m2_along_x_y: roughness.m2,
            m4_along_x_y_per_m2: roughness.m4,
            nayak_alpha: roughness.alpha(),
            rms_slope: roughness.rms_slope(),
            autocorrelation_length_m: correlation.and_then(|correlation| correlation.length),
            texture_aspect_ratio: correlation.and_then(|correlation| correlation.aspect),
            summit_definition: map.neighbours.name(),
            summits: map.summits,
            summits_with_a_saddle: map.saddles,
            plateaus: map.plateaus,
            dropped_plateaus: map.dropped,
            five_point_theory: map.expected.map(ExpectedSummary::from),
            nayak_theory: map.nayak.map(ExpectedSummary::from),
            quantisation: map.quantisation.map(|steps| QuantisationSummary {
                height_step_m: steps.step,
                height_levels: steps.levels,
                distinct_curvatures: steps.distinct_curvatures,
                median_summit_drop_m: steps.median_drop,
            }),
        }
    }
}

/// Generator of a random surface.
#[derive(Serialize)]
struct GenerationSummary {
    process: ProcessSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    plateau: Option<ProcessSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plateau_height_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    summits_asked: Option<TargetSummary>,
}

#[derive(Serialize)]
struct TargetSummary {
    mean_radius_m: f64,
    sigma_m: f64,
    /// Where they are not those of the summits.
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_of: Option<&'static str>,
    density_per_m2: f64,
    surfaces_tried: usize,
}

#[derive(Serialize)]
struct ProcessSummary {
    spectrum: &'static str,
    hurst: Option<f64>,
    roll_off_m: Option<f64>,
    cut_off_m: Option<f64>,
    correlation_length_m: Option<f64>,
    elongation: f64,
    angle_rad: f64,
    sigma_m: f64,
    heights: String,
    skewness: f64,
    kurtosis: f64,
}

impl From<&Process> for ProcessSummary {
    fn from(process: &Process) -> Self {
        let (spectrum, [hurst, roll_off_m, cut_off_m, correlation_length_m]) = match process.spectrum.shape()
        {
            SpectrumShape::SelfAffine { hurst, roll_off, cut_off } => {
                ("self-affine", [Some(hurst), Some(roll_off), Some(cut_off), None])
            }
            SpectrumShape::Gaussian(length) => ("gaussian", [None, None, None, Some(length)]),
            SpectrumShape::Exponential(length) => ("exponential", [None, None, None, Some(length)]),
        };
        Self {
            spectrum,
            hurst,
            roll_off_m,
            cut_off_m,
            correlation_length_m,
            elongation: process.spectrum.lay().elongation,
            angle_rad: process.spectrum.lay().angle,
            sigma_m: process.sigma,
            heights: process.heights.to_string(),
            skewness: process.heights.skewness(),
            kurtosis: process.heights.kurtosis(),
        }
    }
}

impl From<&GenerationFacts> for GenerationSummary {
    fn from(made: &GenerationFacts) -> Self {
        let plateau = made.generator.plateau.as_ref();
        Self {
            process: ProcessSummary::from(&made.generator.process),
            plateau: plateau.map(|plateau| ProcessSummary::from(&plateau.process)),
            plateau_height_m: plateau.map(|plateau| plateau.height),
            summits_asked: made.target.map(|(target, surfaces_tried)| TargetSummary {
                mean_radius_m: target.radius,
                sigma_m: target.sigma,
                sigma_of: (target.sigma_of == SigmaOf::Surface).then_some("surface heights"),
                density_per_m2: target.density,
                surfaces_tried,
            }),
        }
    }
}

/// One of several realisations.
#[derive(Serialize)]
pub struct RealisationSummary {
    realisation: usize,
    asperities: usize,
    nominal_area_m2: f64,
    #[serde(flatten)]
    statistics: StatisticsSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    sq_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ssk: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sku: Option<f64>,
}

impl RealisationSummary {
    /// Realisation `realisation` (from 1) of a surface.
    pub fn new(
        realisation: usize,
        asperities: usize,
        nominal_area: f64,
        statistics: &Statistics,
        moments: Option<Moments>,
    ) -> Self {
        Self {
            realisation,
            asperities,
            nominal_area_m2: nominal_area,
            statistics: StatisticsSummary::from(statistics),
            sq_m: moments.map(|moments| moments.sq),
            ssk: moments.and_then(|moments| moments.ssk),
            sku: moments.and_then(|moments| moments.sku),
        }
    }
}

/// A surface by itself.
pub fn summary(surface: &Surface) -> SurfaceSummary<'_> {
    SurfaceSummary {
        asperities: surface.set.count(),
        nominal_area_m2: surface.set.nominal_area(),
        density_per_m2: surface.set.density(),
        statistics: StatisticsSummary::from(&surface.reported_statistics()),
        offset_to_mean_plane_m: surface.offset_to_mean_plane(),
        separations_from: (surface.separations_of() == SigmaOf::Surface)
            .then_some("mean plane of the surface"),
        plasticity_index: None,
        ellipticity: surface.ellipticity.map(EllipticitySummary::from),
        statistical_model: None,
        height_map: surface.map.as_ref().map(MapSummary::from),
        generation: surface.map.as_ref().and_then(|map| map.generation.as_ref()).map(GenerationSummary::from),
        realisations: Vec::new(),
        warnings: &surface.warnings,
    }
}
