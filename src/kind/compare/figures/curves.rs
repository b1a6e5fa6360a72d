//! Results of the models and the reference against load, with analytical lines beside them.

use asperity::analytical::{AnalyticalLine, mean_deflection};
use asperity::compare::{
    AdmissibleRange, ComparedQuantity, Comparison, CurvePoint, ModelKind, ReferencePoint,
};
use asperity::study::CaseResults;
use asperity::{Limit, Regime};
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use super::super::results::{CompareResults, SurfaceResults};
use super::differences::{NOT_ADMISSIBLE, invalid, megapascals};
use crate::presentation::regime_colour;

/// Half-width of a band in standard errors: 95 % of all samples lie within.
const BAND: f64 = 1.96;

fn colour(kind: ModelKind) -> Colour {
    match kind {
        ModelKind::Statistical => Colour::Statistical,
        ModelKind::Deterministic => Colour::Deterministic,
    }
}

/// The points of one model that carry load, by increasing load.
pub fn curve(comparison: &Comparison, kind: ModelKind) -> Vec<&CurvePoint> {
    let mut points: Vec<&CurvePoint> = comparison
        .curves
        .iter()
        .filter(|point| point.kind == kind && point.response.pressure.total() > 0.0)
        .collect();
    points.sort_by(|a, b| a.response.pressure.total().total_cmp(&b.response.pressure.total()));
    points
}

/// The loads of models and reference (Pa), in any order.
pub fn all_loads(case: &CaseResults) -> impl Iterator<Item = f64> + Clone {
    let of_models = case.comparison.curves.iter().map(|point| point.response.pressure.total());
    let of_reference = case.reference.iter().flat_map(|curve| &curve.points).map(|point| point.pressure);
    of_models.chain(of_reference).filter(|&load| load > 0.0)
}

/// What figures of one law and thickness have in common.
pub struct Setting<'a> {
    pub case: &'a CaseResults,
    pub valid: &'a AdmissibleRange,
    pub units: Units,
    pub loads: Loads,
    /// First and last load that is shown, Pa.
    pub shown: [f64; 2],
}

/// How a quantity of the models and the reference is shown.
struct Curves {
    title: &'static str,
    axis: Axis,
    /// From SI.
    scale: f64,
    /// Standard error of a sum; with the unit of separations, m.
    error: fn(&CurvePoint, f64) -> Option<f64>,
}

impl Curves {
    fn new(quantity: ComparedQuantity, units: &Units) -> Self {
        let none: fn(&CurvePoint, f64) -> Option<f64> = |_, _| None;
        let (title, axis, error) = match quantity {
            ComparedQuantity::Separation => {
                let error: fn(&CurvePoint, f64) -> Option<f64> =
                    |point, sigma| point.response.separation_error(sigma);
                ("Separation", units.separation(), error)
            }
            ComparedQuantity::Area => {
                let error: fn(&CurvePoint, f64) -> Option<f64> =
                    |point, _| Some(point.response.sampling?.area_ratio);
                ("Real contact area", Axis::log("area ratio A/A_nom"), error)
            }
            ComparedQuantity::Stiffness => ("Stiffness", Axis::log("stiffness (MPa/µm)"), none),
            ComparedQuantity::ElectricalConductance => {
                ("Electrical conductance", Axis::log("conductance (S/mm²)"), none)
            }
            ComparedQuantity::ThermalConductance => {
                ("Thermal conductance", Axis::log("conductance (kW/(m² K))"), none)
            }
            ComparedQuantity::Friction => ("Coefficient of friction", Axis::linear("coefficient"), none),
        };
        Self { title, axis, scale: scale(quantity), error }
    }
}

/// The factor from SI to the unit of a quantity in figures.
pub const fn scale(quantity: ComparedQuantity) -> f64 {
    match quantity {
        ComparedQuantity::Stiffness => 1e-12,
        ComparedQuantity::ElectricalConductance => 1e-6,
        ComparedQuantity::ThermalConductance => 1e-3,
        ComparedQuantity::Separation | ComparedQuantity::Area | ComparedQuantity::Friction => 1.0,
    }
}

impl Setting<'_> {
    fn place(&self, load: f64) -> f64 {
        load * self.loads.per_pascal
    }

    /// The axis of loads over those that are shown.
    pub fn axis(&self) -> Axis {
        let [from, to] = self.shown.map(|load| self.place(load));
        self.loads.axis.clone().range(from, to)
    }

    /// Whether a load lies in the figure or just beside it.
    fn is_near(&self, load: f64) -> bool {
        const ROOM: f64 = 1.5;
        (self.shown[0] / ROOM..=self.shown[1] * ROOM).contains(&load)
    }

    /// A quantity of both models, with 95 % bands of the sum for independent asperities, and of the reference; the sums of `others`,
    /// other realisations, are thin. Loads that are not admissible are shaded.
    pub fn plot(&self, quantity: ComparedQuantity, others: &[&Comparison], lines: Vec<Layer>) -> Plot {
        const OTHERS: &str = "deterministic, other realisations";
        let curves = Curves::new(quantity, &self.units);
        let mut plot = Plot::new(curves.title, self.axis(), curves.axis);
        for region in invalid(self.valid, self.loads.per_pascal, NOT_ADMISSIBLE) {
            plot = plot.with(region);
        }
        let near = |comparison, kind| {
            let mut points = curve(comparison, kind);
            points.retain(|point| self.is_near(point.response.pressure.total()));
            points
        };
        let at = |point: &CurvePoint| {
            let value = quantity.value(&point.response)?;
            Some((self.place(point.response.pressure.total()), curves.scale * value))
        };
        for other in others {
            let points = near(other, ModelKind::Deterministic);
            let line = Layer::line(points.into_iter().filter_map(at)).coloured(Colour::Others).thin();
            plot = plot.with(line.named(OTHERS));
        }
        for kind in [ModelKind::Deterministic, ModelKind::Statistical] {
            let points = near(&self.case.comparison, kind);
            let band = points.iter().filter_map(|point| {
                let ((load, value), half) = (at(point)?, BAND * (curves.error)(point, self.units.sigma)?);
                Some((load, value - half, value + half))
            });
            let dash = if kind == ModelKind::Statistical { Dash::Dashed } else { Dash::Solid };
            let line = Layer::line(points.iter().copied().filter_map(at)).coloured(colour(kind)).dashed(dash);
            plot = plot.with(Layer::band(band).coloured(colour(kind))).with(line.named(kind.name()));
        }
        plot = lines.into_iter().fold(plot, Plot::with);
        let solved: Vec<(f64, f64)> =
            reference_line(self.case, |point| Some(curves.scale * point.value(quantity)?))
                .into_iter()
                .filter(|(load, _)| self.is_near(*load))
                .map(|(load, value)| (self.place(load), value))
                .collect();
        if solved.is_empty() {
            return plot;
        }
        let line = Layer::line(solved.iter().copied()).coloured(Colour::Reference).dashed(Dash::DashDot);
        let places = Layer::points(solved, Marker::Triangle).coloured(Colour::Reference);
        plot.with(line.named("reference")).with(places.named("reference"))
    }
}

/// Load (Pa) and a value of the reference, by increasing load.
pub fn reference_line(case: &CaseResults, value: impl Fn(&ReferencePoint) -> Option<f64>) -> Vec<(f64, f64)> {
    let points = case.reference.iter().flat_map(|curve| &curve.points);
    let mut line: Vec<(f64, f64)> =
        points.filter_map(|point| Some((point.pressure, value(point)?))).collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    line
}

/// Each regime's share of the load against something.
pub fn shares_of_load(title: &str, x: Axis, shares: impl Iterator<Item = (f64, [f64; 3])>) -> Plot {
    let (x_values, shares): (Vec<f64>, Vec<[f64; 3]>) = shares.unzip();
    let share = Regime::ALL.map(|regime| shares.iter().map(|s| s[regime as usize]).collect::<Vec<f64>>());
    let stacked = Regime::ALL.into_iter().zip(&share);
    Plot::new(title, x, Axis::linear("share of the load").range(0.0, 1.0)).with_stacked(
        &x_values,
        stacked.map(|(regime, share)| (regime.name(), regime_colour(regime), &share[..])),
    )
}

/// Whether more than one regime carries a share of the load that is seen.
pub fn has_regimes<'a>(shares: impl Iterator<Item = &'a [f64; 3]> + Clone) -> bool {
    Regime::ALL.into_iter().filter(|&regime| is_seen(regime, shares.clone())).count() > 1
}

/// Whether a regime carries a share of the load that is seen in a figure.
pub fn is_seen<'a>(regime: Regime, mut shares: impl Iterator<Item = &'a [f64; 3]>) -> bool {
    const LEAST: f64 = 2e-3;
    shares.any(|shares| shares[regime as usize] > LEAST)
}

/// Each regime's share of the load on the case `name`, one panel per model, where enough contacts carry it. Nothing where one regime
/// carries all.
pub fn regimes(setting: &Setting, name: &str) -> Option<Figure> {
    /// Over load.
    type Shares = Vec<(f64, [f64; 3])>;
    let has_few =
        |point: &CurvePoint| point.response.exceeded().limits().any(|limit| limit == Limit::FewContacts);
    let shares = |kind: ModelKind| -> Shares {
        let points = curve(&setting.case.comparison, kind).into_iter();
        let enough = points.filter(|point| !has_few(point));
        let at = |point: &CurvePoint| {
            Some((setting.place(point.response.pressure.total()), point.response.pressure.shares()?))
        };
        enough.filter_map(at).collect()
    };
    let present: Vec<(ModelKind, Shares)> = [ModelKind::Statistical, ModelKind::Deterministic]
        .into_iter()
        .map(|kind| (kind, shares(kind)))
        .filter(|(_, shares)| shares.len() > 1)
        .collect();
    let all = || present.iter().flat_map(|(_, shares)| shares);
    if !has_regimes(present.iter().flat_map(|(_, shares)| shares).map(|(_, shares)| shares)) {
        return None;
    }
    let ends = [all().map(|at| at.0).fold(f64::INFINITY, f64::min), all().map(|at| at.0).fold(0.0, f64::max)];
    let panel = |(kind, shares): (ModelKind, Shares)| {
        let axis = setting.loads.axis.clone().range(ends[0], ends[1]);
        let plot = shares_of_load(&format!("{} model", capitalised(kind.name())), axis, shares.into_iter());
        // Regions lie below the shares: the edges of the admissible range are lines.
        let edges = setting.valid.stretches.iter().flatten().map(|&load| setting.place(load));
        let edges = edges.filter(|edge| (ends[0] * 1.01..ends[1] / 1.01).contains(edge));
        edges.fold(plot, |plot, edge| plot.with(Layer::at_x(edge, "")))
    };
    let title = format!("{name}: share of the load by contact regime");
    Some(Figure::row(title.clone(), present.into_iter().map(panel).collect()).headed(title))
}

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
