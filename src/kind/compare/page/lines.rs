//! Closed results beside the models: in the figures, and load by load.

use asperity::analytical::{AnalyticalLine, mean_deflection};
use asperity::compare::{Kind, ReferencePoint, of_each_decade};
use asperity_framework::report::format::{input_quantity, number, quantity};
use asperity_framework::report::page::Page;
use asperity_plot::{Colour, Dash, Layer, Marker};

use super::figures::curve;
use super::reference::of_model;
use crate::kind::compare::answers::CaseResults;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// What the lines of one surface are computed from.
struct Rough {
    /// r.m.s. gradient of the prepared map.
    gradient: f64,
    /// Of the map, m.
    sides: [f64; 2],
    /// E*, Pa.
    modulus: f64,
    /// What d is measured in, m.
    sigma: f64,
    /// Height of the plane of separations above the mean plane of the map, m.
    offset: Option<f64>,
}

impl Rough {
    fn of(results: &CompareResults, found: &SurfaceResults) -> Option<Self> {
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
    fn interacting(&self, separation: f64, pressure: f64) -> f64 {
        separation - mean_deflection(pressure / self.modulus, self.sides) / self.sigma
    }

    /// d/sigma of the reference, to the undeformed heights.
    fn undeformed(&self, point: &ReferencePoint) -> Option<f64> {
        Some((point.undeformed_gap - self.offset?) / self.sigma)
    }
}

const KINDS: [Kind; 2] = [Kind::Statistical, Kind::Deterministic];

/// The name of an area line.
fn name(line: AnalyticalLine) -> &'static str {
    match line {
        AnalyticalLine::Persson => "Persson",
        AnalyticalLine::BushGibsonThomas => "Bush-Gibson-Thomas",
        AnalyticalLine::GreenwoodWilliamsonInteracting => "with interaction",
    }
}

/// The lines in the figures of d/sigma and of the area against load.
pub fn layers(results: &CompareResults, found: &SurfaceResults, case: &CaseResults) -> [Vec<Layer>; 2] {
    let Some(rough) = Rough::of(results, found) else { return [Vec::new(), Vec::new()] };
    let loads = dense(&loads(case));
    let area = |&line: &AnalyticalLine| {
        let at = |&load: &f64| {
            let ratio = load / rough.modulus;
            Some((ratio, line.area_ratio(ratio, rough.gradient)?))
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
                (load / rough.modulus, rough.interacting(d, load))
            })
            .collect();
        if points.is_empty() {
            continue;
        }
        let colour = if kind == Kind::Statistical { Colour::Statistical } else { Colour::Deterministic };
        let dash = if kind == Kind::Statistical { Dash::DashDot } else { Dash::Dotted };
        let line = Layer::line(points).coloured(colour).dashed(dash).thin();
        separations.push(line.named(format!("{}, with interaction", kind.name())));
    }
    let solved = case.reference.iter().flat_map(|curve| &curve.points);
    let solved: Vec<(f64, f64)> =
        solved.filter_map(|point| Some((point.pressure / rough.modulus, rough.undeformed(point)?))).collect();
    if !solved.is_empty() {
        let points = Layer::points(solved, Marker::Triangle).coloured(Colour::Reference);
        separations.push(points.named("reference, to the undeformed mean plane"));
    }
    [separations, areas]
}

/// Loads (Pa) of the reference, else of the models, ascending, each once.
fn loads(case: &CaseResults) -> Vec<f64> {
    let of_reference = case.reference.iter().flat_map(|curve| &curve.points).map(|point| point.pressure);
    let of_models = case.comparison.curves.iter().map(|point| point.response.pressure.total());
    let mut loads: Vec<f64> = of_reference.chain(of_models).filter(|&load| load > 0.0).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    loads
}

/// Loads between the ends of `loads`, close enough for a smooth line.
fn dense(loads: &[f64]) -> Vec<f64> {
    const STEPS: usize = 100;
    let [Some(first), Some(last)] = [loads.first(), loads.last()] else { return Vec::new() };
    let at = |k: usize| first * (last / first).powf(k as f64 / STEPS as f64);
    (0..=STEPS).map(at).collect()
}

/// What the lines are, and their values; nothing where none are asked for.
pub fn section(page: &mut Page, results: &CompareResults, found: &SurfaceResults, case: &CaseResults) {
    let Some(rough) = Rough::of(results, found).filter(|_| !results.lines.is_empty()) else { return };
    page.paragraph(&method(results, &rough));
    let areas: Vec<AnalyticalLine> =
        results.lines.iter().copied().filter(|line| line.area_ratio(0.0, 1.0).is_some()).collect();
    let is_interacting = areas.len() < results.lines.len();
    let kinds: Vec<Kind> = KINDS
        .into_iter()
        .filter(|&kind| is_interacting && !curve(&case.comparison, kind).is_empty())
        .collect();
    let points: Vec<&ReferencePoint> = case.reference.iter().flat_map(|curve| &curve.points).collect();
    let mut header = vec!["p".to_owned()];
    header.extend(areas.iter().map(|&line| format!("A/A_nom {}", name(line))));
    if !points.is_empty() && !areas.is_empty() {
        header.push("A/A_nom ref.".to_owned());
    }
    header.extend(kinds.iter().map(|kind| format!("d/σ {} with interaction", kind.name())));
    if is_interacting {
        header.push("d/σ ref., undeformed".to_owned());
    }
    let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
    let row = |load: f64, point: Option<&ReferencePoint>| {
        let ratio = load / rough.modulus;
        let mut cells = vec![input_quantity(load, "Pa")];
        cells.extend(areas.iter().map(|line| shown(line.area_ratio(ratio, rough.gradient))));
        cells.extend(point.filter(|_| !areas.is_empty()).map(|point| number(point.area_ratio)));
        cells.extend(kinds.iter().map(|&kind| {
            shown(of_model(case, kind, load).map(|[_, separation]| rough.interacting(separation, load)))
        }));
        cells.extend(point.filter(|_| is_interacting).map(|point| shown(rough.undeformed(point))));
        cells
    };
    if points.is_empty() {
        /// Loads per decade.
        const STEPS: f64 = 2.0;
        let loads = of_each_decade(loads(case), |&load| load, STEPS);
        page.table(header, loads.into_iter().map(|load| row(load, None)));
        return;
    }
    let mut points = points;
    points.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
    points.dedup_by_key(|point| point.pressure);
    page.table(header, points.into_iter().map(|point| row(point.pressure, Some(point))));
}

/// The equations with their numbers.
fn method(results: &CompareResults, rough: &Rough) -> String {
    let mut equations: Vec<String> = Vec::new();
    let has_areas = results.lines.iter().any(|line| line.area_ratio(0.0, 1.0).is_some());
    for line in &results.lines {
        equations.push(match line {
            AnalyticalLine::Persson => "A/A_nom = erf(√2 p/(E* g)) (Persson 2001)".to_owned(),
            AnalyticalLine::BushGibsonThomas => {
                "A/A_nom = √(2π) p/(E* g), at most 1 (Bush, Gibson and Thomas 1975, the limit of light load)".to_owned()
            }
            AnalyticalLine::GreenwoodWilliamsonInteracting => {
                let [a, b] = rough.sides;
                let constant = mean_deflection(1.0, rough.sides) / (a * b).sqrt();
                format!(
                    "the separation of both models less the mean deflection {constant:.4} p √A_nom/E* of the patch of {} × {} under \
                     the nominal pressure (after the idea of Ciavarella, Greenwood and Paggi 2008; the constant is that of a uniform \
                     pressure on a rectangle), beside the distance of the flat from the undeformed mean plane in the reference",
                    quantity(a, "m"),
                    quantity(b, "m"),
                )
            }
        });
    }
    let gradient = if has_areas {
        format!(
            "; g = {} is the r.m.s. gradient of the prepared map, from first differences along both axes. It depends on the pixel: g grows, \
             and the area falls, as pixels or the S filter become finer",
            number(rough.gradient),
        )
    } else {
        String::new()
    };
    format!(
        "Analytical lines, for elastic bodies of E* = {} under any law: {}{gradient}.",
        quantity(rough.modulus, "Pa"),
        equations.join("; "),
    )
}
