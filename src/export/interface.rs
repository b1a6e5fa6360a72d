//! The joint of a comparison as a table over its closure.

use std::any::Any;

use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::spot::SpotQuantity;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::answer::CardLine;
use asperity_contact_framework::report::format::{range, thickness};
use asperity_contact_framework::report::store::plain;

use crate::kind::compare::card::Card;
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::rows::SurfaceCase;
use crate::model_tables::limits;

/// The model that a table is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableModel {
    /// The integral.
    Statistical,
    /// The sum.
    #[default]
    Deterministic,
    /// The boundary elements.
    Reference,
}

impl TableModel {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Statistical, Self::Deterministic, Self::Reference];

    fn kind(self) -> Option<ModelKind> {
        match self {
            Self::Statistical => Some(ModelKind::Statistical),
            Self::Deterministic => Some(ModelKind::Deterministic),
            Self::Reference => None,
        }
    }

    /// The name in specs and tables.
    pub fn name(self) -> &'static str {
        self.kind().map_or("reference", ModelKind::name)
    }
}

/// What a table holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct InterfaceOptions {
    /// The model.
    pub model: TableModel,
    /// Whether loads that are not admissible are in it, too, marked.
    pub beyond: bool,
}

/// A value with the ends of its 95 % interval, where there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterfaceValue {
    /// The value, SI.
    pub value: f64,
    /// The ends.
    pub interval: Option<[f64; 2]>,
}

/// A joint at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct TablePoint {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// By how much the bodies are closer than at the first load of the table, m.
    pub closure: InterfaceValue,
    /// Electrical conductance per nominal area, S/m^2, where it is asked for.
    pub electrical: Option<InterfaceValue>,
    /// Thermal conductance per nominal area, W/(m^2 K), where it is asked for.
    pub thermal: Option<InterfaceValue>,
    /// Coefficient of friction, where it is asked for.
    pub friction: Option<InterfaceValue>,
    /// Tangential stiffness of the sticking joint per nominal area, Pa/m, where it is asked for.
    pub tangential: Option<f64>,
    /// Limits of admissible loads that are exceeded.
    pub limits: String,
}

/// The joint of one case over its loads.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceTable {
    /// The case in a name of a file.
    pub case: String,
    /// Title, surface, law, loads, model and verdict: a line each.
    pub header: Vec<String>,
    /// By growing load; closures grow, too.
    pub points: Vec<TablePoint>,
    /// -dp/dd at the first load, Pa/m.
    pub first_stiffness: f64,
}

/// Relative to the whole closure, how far apart two points of a jump are.
const JUMP: f64 = 1e-6;

/// The tables of all cases of a comparison.
///
/// # Errors
/// Results of another kind; a model that was not run; loads of which none, or only one, is admissible.
pub fn interface_tables(
    results: &dyn Outcome,
    options: InterfaceOptions,
) -> Result<Vec<InterfaceTable>, String> {
    let Some(results) = (results as &dyn Any).downcast_ref::<CompareResults>() else {
        return Err(
            "found another kind of experiment; allowed: [compare], whose joints have loads".to_owned()
        );
    };
    SurfaceCase::all(results).map(|case| table(results, case, options)).collect()
}

/// A joint at one load before it is placed.
struct Found {
    separation: f64,
    interval: Option<[f64; 2]>,
    stiffness: Option<f64>,
    point: TablePoint,
}

fn table(
    results: &CompareResults,
    case: SurfaceCase,
    options: InterfaceOptions,
) -> Result<InterfaceTable, String> {
    let name = case.name(results);
    let mut loads: Vec<f64> =
        case.first().comparison.curves.iter().filter_map(|point| point.prescribed_pressure).collect();
    if let (TableModel::Reference, Some(curve)) = (options.model, &case.first().reference) {
        loads = curve.points.iter().map(|point| point.pressure).collect();
    }
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    let all: Vec<Found> = loads.iter().filter_map(|&load| at_load(case, load, options.model)).collect();
    if all.is_empty() {
        return Err(format!(
            "{name}: found no load of the {model} model; allowed: `pressure` or `force` in the spec, and \"{model}\" among its models",
            model = options.model.name()
        ));
    }
    let is_kept = |found: &&Found| options.beyond || found.point.limits.is_empty();
    let kept: Vec<&Found> = all.iter().filter(is_kept).collect();
    if kept.len() < 2 {
        let limits = all.iter().map(|found| found.point.limits.as_str()).find(|limits| !limits.is_empty());
        return Err(format!(
            "{name}: found {} admissible loads of {} (beyond: {}); allowed: two at least, or --beyond for a table whose loads are marked",
            kept.len(),
            all.len(),
            limits.unwrap_or("none")
        ));
    }
    let first = kept[0].separation;
    let whole = (first - kept[kept.len() - 1].separation).max(f64::MIN_POSITIVE);
    let mut least = f64::NEG_INFINITY;
    let place = |found: &&Found| {
        // Where the load jumps both loads have one separation.
        let closure = (first - found.separation).max(least + JUMP * whole).max(0.0);
        least = closure;
        let interval = found.interval.map(|[low, high]| [first - high, first - low]);
        TablePoint { closure: InterfaceValue { value: closure, interval }, ..found.point.clone() }
    };
    let points: Vec<TablePoint> = kept.iter().map(place).collect();
    let ends = [points[0].pressure, points[points.len() - 1].pressure];
    let card = Card::new(case).lines();
    let verdict = card.into_iter().find(|line| line.key == CardLine::ANSWER);
    let layer = case.first().thickness.map_or_else(String::new, |t| format!(", layer {}", thickness(t)));
    let beyond = points.iter().filter(|point| !point.limits.is_empty()).count();
    let mut header = vec![
        results.metadata.title.clone(),
        format!(
            "Surface {}, law {}{layer}; {} model.",
            case.key().surface,
            case.first().law,
            options.model.name()
        ),
        format!(
            "Nominal pressure {}; {} loads, {beyond} of them not admissible.",
            range(ends, "Pa"),
            points.len()
        ),
        "Closure 0: the separation of the first load.".to_owned(),
    ];
    header.extend(verdict.into_iter().flat_map(|line| {
        line.texts.into_iter().map(|text| format!("May the integral replace the sum? {text}"))
    }));
    let stiffness = kept[0].stiffness.unwrap_or_else(|| {
        // Without one, the secant to the next load.
        let rise = points[1].pressure - points[0].pressure;
        rise / (points[1].closure.value - points[0].closure.value)
    });
    Ok(InterfaceTable { case: plain(&name), header, points, first_stiffness: stiffness })
}

/// The model at a load; `None` where it was not run there, or has no separation.
fn at_load(case: SurfaceCase, load: f64, model: TableModel) -> Option<Found> {
    let at = case.case.results_at(load);
    let found = at.models.iter().find(|found| found.model == model.kind())?;
    let [separation, over_sigma] = found.point.separation?;
    let sigma = separation / over_sigma;
    let value = |quantity: ComparedQuantity| {
        let value = found.point.value(quantity)?;
        Some(InterfaceValue { value, interval: found.intervals[quantity as usize] })
    };
    let interval = found.intervals[ComparedQuantity::Separation as usize];
    let tangential = found.point.spots[SpotQuantity::TangentialStiffness as usize];
    Some(Found {
        separation,
        interval: interval.filter(|_| sigma.is_finite()).map(|ends| ends.map(|h| h * sigma)),
        stiffness: found.point.stiffness.filter(|stiffness| *stiffness > 0.0),
        point: TablePoint {
            pressure: load,
            closure: InterfaceValue { value: 0.0, interval: None },
            electrical: value(ComparedQuantity::ElectricalConductance),
            thermal: value(ComparedQuantity::ThermalConductance),
            friction: value(ComparedQuantity::Friction),
            tangential: (tangential > 0.0).then_some(tangential),
            limits: limits(at.exceeded),
        },
    })
}
