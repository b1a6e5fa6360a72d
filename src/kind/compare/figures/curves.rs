//! The figures of a comparison.

use super::axes::Units;
use super::differences::invalid;
use crate::presentation::regime_colour;
use asperity::compare::{AdmissibleRange, Comparison, CurvePoint, ModelKind, ReferencePoint};
use asperity::study::CaseResults;
use asperity::{INTERACTION, Limit, Regime};
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

/// Half-width of a band in standard errors: 95 % of all samples lie within.
const BAND: f64 = 1.96;

/// The load axis shared by all figures of one comparison.
fn load_axis(case: &CaseResults, units: &Units) -> Axis {
    /// Margin at both ends, as a ratio.
    const ROOM: f64 = 1.3;
    let loads = || {
        let of_models = case.comparison.curves.iter().map(|point| point.response.pressure.total());
        let of_reference = case.reference.iter().flat_map(|curve| &curve.points).map(|point| point.pressure);
        of_models.chain(of_reference).map(|load| load / units.modulus).filter(|&load| load > 0.0)
    };
    let (low, high) = (loads().fold(f64::INFINITY, f64::min), loads().fold(0.0, f64::max));
    units.load_ratio().range(low / ROOM, high * ROOM)
}

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

/// What figures of one law and thickness have in common.
pub struct Setting<'a> {
    /// The surface, and the law where there are several.
    pub name: &'a str,
    /// Both models and the reference.
    pub case: &'a CaseResults,
    /// The loads that are admissible.
    pub valid: &'a AdmissibleRange,
    /// Of the axes.
    pub units: Units,
    /// What the figures show, in words.
    pub finding: &'a str,
}

impl Setting<'_> {
    fn plot(&self, what: &str, y: Axis) -> Plot {
        let mut plot = Plot::new(format!("{}: {what}", self.name), load_axis(self.case, &self.units), y);
        for region in invalid(self.valid, self.units.modulus.recip()) {
            plot = plot.with(region);
        }
        plot
    }

    fn figure(&self, what: &str, plot: Plot) -> Figure {
        Figure::column(format!("{}: {what}. {}", self.name, self.finding), vec![plot])
    }

    fn load(&self, point: &CurvePoint) -> f64 {
        point.response.pressure.total() / self.units.modulus
    }

    /// A quantity of one model over the load, with its band (half-width) where there is one; dotted where few contacts carry
    /// the load.
    fn with_model(
        &self,
        plot: Plot,
        kind: ModelKind,
        value: impl Fn(&CurvePoint) -> f64,
        half: impl Fn(&CurvePoint) -> Option<f64>,
    ) -> Plot {
        let points = curve(&self.case.comparison, kind);
        let band = points.iter().filter_map(|point| {
            let half = half(point)?;
            Some((self.load(point), value(point) - half, value(point) + half))
        });
        let plot = plot.with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(kind)));
        let few: Vec<bool> = points.iter().map(|point| has_few_contacts(point)).collect();
        let line = |is_shown: &dyn Fn(usize) -> bool| {
            let at = |(k, point): (usize, &&CurvePoint)| {
                (self.load(point), if is_shown(k) { value(point) } else { f64::NAN })
            };
            Layer::line(points.iter().enumerate().map(at).collect::<Vec<_>>()).coloured(colour(kind))
        };
        let dash = if kind == ModelKind::Statistical { Dash::Dashed } else { Dash::Solid };
        let plot = plot.with(line(&|k| !few[k]).dashed(dash).named(kind.name()));
        if !few.contains(&true) {
            return plot;
        }
        // The dotted line reaches the other one.
        let is_dotted = |k: usize| few[k.saturating_sub(1)..(k + 2).min(few.len())].contains(&true);
        plot.with(line(&is_dotted).dashed(Dash::Dotted).named(FEW))
    }
}

/// Lines where a model has few contacts.
const FEW: &str = "fewer than 30 effective contacts";

fn has_few_contacts(point: &CurvePoint) -> bool {
    point.response.exceeded().limits().any(|limit| limit == Limit::FewContacts)
}

/// d/sigma against load (Pasaribu and Schipper 2005, Fig. 4), with `lines` beside the models; the deterministic results of other
/// realisations are thin.
pub fn separation(setting: &Setting, others: &[&Comparison], lines: Vec<Layer>) -> Figure {
    const OTHERS: &str = "deterministic, other realisations";
    let what = "separation against load";
    let mut plot = setting.plot(what, setting.units.separation());
    for other in others {
        let points = curve(other, ModelKind::Deterministic);
        let line = points.iter().map(|point| (setting.load(point), point.response.separation_over_sigma));
        let line = Layer::line(line.collect::<Vec<_>>()).coloured(Colour::Others).thin();
        plot = plot.with(line.named(OTHERS));
    }
    let sigma = setting.units.sigma;
    for kind in [ModelKind::Deterministic, ModelKind::Statistical] {
        let half = |point: &CurvePoint| Some(BAND * point.response.separation_error(sigma)?);
        plot = setting.with_model(plot, kind, |point| point.response.separation_over_sigma, half);
    }
    let plot = lines.into_iter().fold(plot, Plot::with);
    let plot = with_reference(plot, setting.case, setting.units.modulus, |point| point.separation_over_sigma);
    setting.figure(what, plot)
}

/// Adds the line of the reference, where it was run.
fn with_reference(
    plot: Plot,
    case: &CaseResults,
    modulus: f64,
    value: fn(&ReferencePoint) -> Option<f64>,
) -> Plot {
    let points = reference_line(case, modulus, value);
    if points.is_empty() {
        return plot;
    }
    let line = Layer::line(points.iter().copied()).coloured(Colour::Reference).dashed(Dash::DashDot);
    let places = Layer::points(points, Marker::Triangle).coloured(Colour::Reference);
    plot.with(line.named("reference")).with(places.named("reference"))
}

/// Load ratio and a value of the reference, by increasing load.
pub fn reference_line(
    case: &CaseResults,
    modulus: f64,
    value: fn(&ReferencePoint) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let points = case.reference.iter().flat_map(|curve| &curve.points);
    let mut line: Vec<(f64, f64)> =
        points.filter_map(|point| Some((point.pressure / modulus, value(point)?))).collect();
    line.sort_by(|a, b| a.0.total_cmp(&b.0));
    line
}

/// Real over nominal area against load, with `lines` beside the models.
pub fn area(setting: &Setting, lines: Vec<Layer>) -> Figure {
    let what = "real contact area against load";
    let mut plot = setting
        .plot(what, Axis::log("area ratio A/A_nom"))
        .with(Layer::at_y(INTERACTION, "asperities interact above"));
    for kind in [ModelKind::Deterministic, ModelKind::Statistical] {
        let half = |point: &CurvePoint| Some(BAND * point.response.sampling?.area_ratio);
        plot = setting.with_model(plot, kind, |point| point.response.area_ratio.total(), half);
    }
    let plot = lines.into_iter().fold(plot, Plot::with);
    let plot = with_reference(plot, setting.case, setting.units.modulus, |point| Some(point.area_ratio));
    setting.figure(what, plot)
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

/// Each regime's share of the load, one panel per model, where enough contacts carry it. Nothing where one regime carries all.
pub fn regimes(setting: &Setting) -> Option<Figure> {
    /// Over load.
    type Shares = Vec<(f64, [f64; 3])>;
    let shares = |kind: ModelKind| -> Shares {
        let points = curve(&setting.case.comparison, kind);
        let enough = points.into_iter().filter(|point| !has_few_contacts(point));
        enough.filter_map(|point| Some((setting.load(point), point.response.pressure.shares()?))).collect()
    };
    let present: Vec<(ModelKind, Shares)> = [ModelKind::Statistical, ModelKind::Deterministic]
        .into_iter()
        .map(|kind| (kind, shares(kind)))
        .filter(|(_, shares)| shares.len() > 1)
        .collect();
    /// A smaller share of the load is not seen.
    const LEAST: f64 = 2e-3;
    let all = || present.iter().flat_map(|(_, shares)| shares);
    let seen =
        Regime::ALL.into_iter().filter(|&regime| all().any(|(_, shares)| shares[regime as usize] > LEAST));
    if seen.count() < 2 {
        return None;
    }
    let ends = [all().map(|at| at.0).fold(f64::INFINITY, f64::min), all().map(|at| at.0).fold(0.0, f64::max)];
    let panel = |(kind, shares): (ModelKind, Shares)| {
        let axis = setting.units.load_ratio().range(ends[0], ends[1]);
        let plot = shares_of_load(&format!("{} model", capitalised(kind.name())), axis, shares.into_iter());
        // Regions lie below the shares: the edges of the admissible range are lines.
        let edges = setting.valid.stretches.iter().flatten().map(|load| load / setting.units.modulus);
        let edges = edges.filter(|edge| (ends[0] * 1.01..ends[1] / 1.01).contains(edge));
        edges.fold(plot, |plot, edge| plot.with(Layer::at_x(edge, "")))
    };
    let title = format!("{}: share of the load by contact regime", setting.name);
    Some(Figure::row(title.clone(), present.into_iter().map(panel).collect()).headed(title))
}
