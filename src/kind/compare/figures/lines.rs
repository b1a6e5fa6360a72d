//! Axes of a comparison, each in the units in which a reader may want it, and closed results beside the models.

use asperity::analytical::{AnalyticalLine, mean_deflection};
use asperity::compare::{ModelKind, ReferencePoint};
use asperity::study::CaseResults;
use asperity_plot::{Axis, Colour, Dash, Layer, Marker};

use super::curves::{all_loads, curve};
use super::differences::megapascals;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// What the lines of one surface are computed from.
pub(crate) struct Rough {
    /// r.m.s. gradient of the prepared map.
    pub(crate) gradient: f64,
    /// Of the map, m.
    pub(crate) sides: [f64; 2],
    /// E*, Pa.
    pub(crate) modulus: f64,
    /// What d is measured in, m.
    sigma: f64,
    /// Height of the plane of separations above the mean plane of the map, m.
    offset: Option<f64>,
}

impl Rough {
    pub(crate) fn new(results: &CompareResults, found: &SurfaceResults) -> Option<Self> {
        let map = found.surface.map.as_ref()?;
        Some(Self {
            gradient: map.roughness.rms_slope(),
            sides: [0, 1].map(|axis| map.points[axis] as f64 * map.pixel[axis]),
            modulus: results.contact.reduced_modulus,
            sigma: found.surface.plane.sigma,
            offset: found.surface.plane_above_mean_plane(),
        })
    }

    /// d/sigma of a model at a nominal pressure (Pa), with the deflection of the patch.
    pub(crate) fn interacting(&self, separation: f64, pressure: f64) -> f64 {
        separation - mean_deflection(pressure / self.modulus, self.sides) / self.sigma
    }

    /// d/sigma of the reference, to the undeformed heights.
    pub(crate) fn undeformed(&self, point: &ReferencePoint) -> Option<f64> {
        Some((point.undeformed_gap - self.offset?) / self.sigma)
    }
}

pub(crate) const KINDS: [ModelKind; 2] = [ModelKind::Statistical, ModelKind::Deterministic];

/// The name of an area line.
pub(crate) fn name(line: AnalyticalLine) -> &'static str {
    match line {
        AnalyticalLine::Persson => "Persson",
        AnalyticalLine::BushGibsonThomas => "Bush-Gibson-Thomas",
        AnalyticalLine::GreenwoodWilliamsonInteracting => "with interaction",
    }
}

/// The lines beside d/sigma and the area against load (MPa).
pub fn layers(results: &CompareResults, found: &SurfaceResults, case: &CaseResults) -> [Vec<Layer>; 2] {
    let Some(rough) = Rough::new(results, found) else { return [Vec::new(), Vec::new()] };
    let loads = dense(&loads(case));
    let area = |&line: &AnalyticalLine| {
        let at = |&load: &f64| {
            let ratio = load / rough.modulus;
            Some((megapascals(load), line.area_ratio(ratio, rough.gradient)?))
        };
        let points: Option<Vec<(f64, f64)>> = loads.iter().map(at).collect();
        let dash = if line == AnalyticalLine::Persson { Dash::Solid } else { Dash::Dotted };
        Some(Layer::line(points?).coloured(Colour::Neutral).dashed(dash).thin().named(name(line)))
    };
    let areas = results.lines.iter().filter_map(area).collect();
    if !results.lines.contains(&AnalyticalLine::GreenwoodWilliamsonInteracting) {
        return [Vec::new(), areas];
    }
    let mut separations = Vec::new();
    for kind in KINDS {
        let points: Vec<(f64, f64)> = curve(&case.comparison, kind)
            .iter()
            .map(|point| {
                let (load, d) = (point.response.pressure.total(), point.response.separation_over_sigma);
                (megapascals(load), rough.interacting(d, load))
            })
            .collect();
        if points.is_empty() {
            continue;
        }
        let colour = if kind == ModelKind::Statistical { Colour::Statistical } else { Colour::Deterministic };
        let dash = if kind == ModelKind::Statistical { Dash::DashDot } else { Dash::Dotted };
        let line = Layer::line(points).coloured(colour).dashed(dash).thin();
        separations.push(line.named(format!("{}, with interaction", kind.name())));
    }
    let solved = case.reference.iter().flat_map(|curve| &curve.points);
    let solved: Vec<(f64, f64)> =
        solved.filter_map(|point| Some((megapascals(point.pressure), rough.undeformed(point)?))).collect();
    if !solved.is_empty() {
        let points = Layer::points(solved, Marker::Triangle).coloured(Colour::Reference);
        separations.push(points.named("reference, to the undeformed mean plane"));
    }
    [separations, areas]
}

/// Loads (Pa) of the reference, else of the models, ascending, each once.
pub(crate) fn loads(case: &CaseResults) -> Vec<f64> {
    let mut loads: Vec<f64> = all_loads(case).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    loads
}

/// Loads between the ends of `loads`, close enough for a smooth line.
pub(super) fn dense(loads: &[f64]) -> Vec<f64> {
    const STEPS: usize = 100;
    let [Some(first), Some(last)] = [loads.first(), loads.last()] else { return Vec::new() };
    let at = |k: usize| first * (last / first).powf(k as f64 / STEPS as f64);
    (0..=STEPS).map(at).collect()
}

/// What one unit is in another.
#[derive(Clone, Copy)]
pub struct Units {
    /// E*, Pa.
    pub modulus: f64,
    /// Nominal area, m².
    pub area: f64,
    /// What separations are measured in, m.
    pub sigma: f64,
}

impl Units {
    pub fn new(results: &CompareResults, found: &SurfaceResults) -> Self {
        Self {
            modulus: results.contact.reduced_modulus,
            area: found.surface.set.nominal_area(),
            sigma: found.surface.plane.sigma,
        }
    }

    pub fn load_ratio(&self) -> Axis {
        Axis::log("load ratio P/(A_nom E*)")
            .or_in("nominal pressure (MPa)", 1e-6 * self.modulus)
            .or_in("load (N)", self.modulus * self.area)
    }

    pub fn pressure(&self) -> Axis {
        Axis::log("nominal pressure (MPa)")
            .or_in("load ratio P/(A_nom E*)", 1e6 / self.modulus)
            .or_in("load (N)", 1e6 * self.area)
    }

    pub fn separation(&self) -> Axis {
        Axis::linear("separation d/σ").or_in("separation d (nm)", 1e9 * self.sigma)
    }

    /// Differences of separations, called `what`.
    pub fn separation_difference(&self, what: &str) -> Axis {
        Axis::linear(format!("{what} (σ)")).or_in(format!("{what} (nm)"), 1e9 * self.sigma)
    }
}

pub struct Loads {
    pub axis: Axis,
    /// What 1 Pa is on it.
    pub per_pascal: f64,
}

impl Units {
    pub fn ratios(&self) -> Loads {
        Loads { axis: self.load_ratio(), per_pascal: self.modulus.recip() }
    }

    pub fn pressures(&self) -> Loads {
        Loads { axis: self.pressure(), per_pascal: 1e-6 }
    }
}
