//! Pressure, conductance and friction of a joint as a table over its closure, as programs for finite elements read it.

use std::any::Any;
use std::fmt::Write;

use asperity::bem::Boundary;
use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::spot::SpotQuantity;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::answer::CardLine;
use asperity_contact_framework::report::format::{input_quantity, range, thickness};

use super::ExportedFile;
use crate::kind::compare::card::Card;
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::rows::SurfaceCase;
use crate::model_tables::limits;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Columns separated by commas, with the ends of the intervals.
    Csv,
    Calculix,
}

impl Format {
    pub const ALL: [Self; 2] = [Self::Csv, Self::Calculix];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Calculix => "calculix",
        }
    }

    /// How its files end.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Calculix => "inp",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UnitSystem {
    /// m, N, Pa, W, S.
    #[default]
    Si,
    /// mm, N, MPa, mW, mA, V: consistent with t, s and mJ.
    Mm,
}

impl UnitSystem {
    pub const ALL: [Self; 2] = [Self::Si, Self::Mm];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Si => "si",
            Self::Mm => "mm",
        }
    }

    const fn note(self) -> &'static str {
        match self {
            Self::Si => "Units: m, Pa, S/m^2, W/(m^2 K)",
            Self::Mm => "Units: mm, MPa, mA/(V mm^2), mW/(mm^2 K)",
        }
    }

    fn length(self, value: f64) -> f64 {
        if self == Self::Si { value } else { 1e3 * value }
    }

    fn pressure(self, value: f64) -> f64 {
        if self == Self::Si { value } else { 1e-6 * value }
    }

    fn stiffness(self, value: f64) -> f64 {
        if self == Self::Si { value } else { 1e-9 * value }
    }

    fn electrical(self, value: f64) -> f64 {
        if self == Self::Si { value } else { 1e-3 * value }
    }

    fn thermal(self, value: f64) -> f64 {
        if self == Self::Si { value } else { 1e-3 * value }
    }
}

/// Which value of a table: itself, or an end of its interval.
#[derive(Clone, Copy, PartialEq)]
enum IntervalEnd {
    Value,
    Low,
    High,
}

impl IntervalEnd {
    /// The value, and the ends where there are intervals.
    fn all_of(table: &InterfaceTable) -> &'static [(Self, &'static str)] {
        let has_intervals = table.points.iter().all(|point| point.closure.interval.is_some());
        let all = &[(Self::Value, ""), (Self::Low, "-low"), (Self::High, "-high")];
        if has_intervals { all } else { &all[..1] }
    }

    fn take(self, value: InterfaceValue) -> f64 {
        match (self, value.interval) {
            (Self::Low, Some([low, _])) => low,
            (Self::High, Some([_, high])) => high,
            _ => value.value,
        }
    }
}

/// The files of a table, whose names begin with `name`.
pub(super) fn files(
    table: &InterfaceTable,
    name: &str,
    format: Format,
    units: UnitSystem,
) -> Vec<ExportedFile> {
    if format == Format::Csv {
        return vec![ExportedFile { name: format!("{name}.csv"), text: csv(table, units) }];
    }
    let of_end = |&(end, ending): &(IntervalEnd, &str)| ExportedFile {
        name: format!("{name}{ending}.inp"),
        text: calculix(table, &format!("{name}{ending}"), units, end),
    };
    IntervalEnd::all_of(table).iter().map(of_end).collect()
}

/// The header, each line after `comment`.
fn header(
    table: &InterfaceTable,
    comment: &str,
    format: Format,
    units: UnitSystem,
    end: IntervalEnd,
) -> String {
    let mut text = String::new();
    let which = match end {
        IntervalEnd::Value => "",
        IntervalEnd::Low => " Lower ends of the pointwise 95 % intervals.",
        IntervalEnd::High => " Upper ends of the pointwise 95 % intervals.",
    };
    for line in table.header.iter().flat_map(|line| line.lines()) {
        let _ = writeln!(text, "{comment} {line}");
    }
    let _ = writeln!(text, "{comment} {}.{which}", units.note());
    let _ = match format {
        Format::Csv => writeln!(text, "{comment} Closure 0: the separation of the first load."),
        _ => writeln!(
            text,
            "{comment} Closure 0 is {:.3e} further out than the separation of the first load; a line of its stiffness leads there.",
            units.length(lead(table))
        ),
    };
    text
}

/// All columns with the ends of their intervals.
fn csv(table: &InterfaceTable, units: UnitSystem) -> String {
    type Column = (&'static str, fn(&TablePoint) -> Option<InterfaceValue>, fn(UnitSystem, f64) -> f64);
    const COLUMNS: [Column; 4] = [
        ("closure", |point| Some(point.closure), UnitSystem::length),
        ("electrical_conductance", |point| point.electrical, UnitSystem::electrical),
        ("thermal_conductance", |point| point.thermal, UnitSystem::thermal),
        ("friction", |point| point.friction, |_, value| value),
    ];
    let mut text = header(table, "#", Format::Csv, units, IntervalEnd::Value);
    let shown: Vec<&Column> = COLUMNS
        .iter()
        .filter(|(_, value, _)| table.points.iter().any(|point| value(point).is_some()))
        .collect();
    text.push_str("pressure");
    for (name, ..) in &shown {
        let _ = write!(text, ",{name},{name}_low,{name}_high");
    }
    text.push_str(",limits\n");
    for point in &table.points {
        let _ = write!(text, "{}", units.pressure(point.pressure));
        for (_, value, scale) in &shown {
            let value = value(point);
            let end = |place: usize| value.and_then(|value| value.interval).map(|ends| ends[place]);
            for value in [value.map(|value| value.value), end(0), end(1)] {
                let _ = write!(text, ",{}", value.map_or_else(String::new, |v| scale(units, v).to_string()));
            }
        }
        let _ = writeln!(text, ",{}", point.limits);
    }
    text
}

/// How far the first load is from no load by its stiffness, m.
fn lead(table: &InterfaceTable) -> f64 {
    table.points[0].pressure / table.first_stiffness
}

/// Pairs of closure and pressure, strictly growing from 0 and 0. A line of the stiffness at the first load leads to it, so that closure 0 is
/// further out there.
fn curve(table: &InterfaceTable, units: UnitSystem, end: IntervalEnd) -> Vec<[f64; 2]> {
    let lead = lead(table);
    let mut points = vec![[0.0, 0.0]];
    for point in &table.points {
        let closure = lead + end.take(point.closure);
        let [last, _] = points[points.len() - 1];
        // Ends of intervals need not grow, nor stay above the first load.
        if closure > last {
            points.push([closure, point.pressure]);
        }
    }
    points.into_iter().map(|[closure, p]| [units.length(closure), units.pressure(p)]).collect()
}

/// Pairs of pressure and a value; empty where it is not asked for.
fn over_pressure(
    table: &InterfaceTable,
    units: UnitSystem,
    end: IntervalEnd,
    value: fn(&TablePoint) -> Option<InterfaceValue>,
) -> Vec<[f64; 2]> {
    let point = |point: &TablePoint| Some([units.pressure(point.pressure), end.take(value(point)?)]);
    table.points.iter().filter_map(point).collect()
}

/// Surface interactions in keywords. CalculiX reads numbers of at most 20 characters. Its version 2.20 knows a tabular overclosure with
/// TYPE=NODE TO SURFACE only, and there takes no pressure into a conductance: heat has an interaction of its own.
fn calculix(table: &InterfaceTable, name: &str, units: UnitSystem, end: IntervalEnd) -> String {
    let mut text = header(table, "**", Format::Calculix, units, end);
    let name = name.to_uppercase();
    let _ = writeln!(text, "** For contact pairs of TYPE=NODE TO SURFACE:");
    let _ = writeln!(text, "*SURFACE INTERACTION, NAME={name}");
    text.push_str("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n");
    for [closure, pressure] in curve(table, units, end) {
        let _ = writeln!(text, "{pressure:.10e}, {closure:.10e}");
    }
    let thermal = over_pressure(table, units, end, |point| point.thermal);
    let friction = over_pressure(table, units, end, |point| point.friction);
    let middle = &table.points[table.points.len() / 2];
    let stick = friction.get(friction.len() / 2).map(|&[_, coefficient]| {
        let (stick, kind) = match middle.tangential {
            Some(tangential) => (tangential, "the tangential stiffness"),
            None => (
                middle.stiffness.unwrap_or(table.first_stiffness),
                "the normal stiffness, since the tangential one is not known here",
            ),
        };
        format!(
            "** Coefficient and stick slope ({kind}) of the middle load: here they do not depend on the pressure.\n*FRICTION\n\
             {coefficient:.10e}, {:.10e}\n",
            units.stiffness(stick)
        )
    });
    text.extend(stick.clone());
    if !thermal.is_empty() {
        let secant = middle.pressure / (middle.closure.value + lead(table));
        let _ = writeln!(
            text,
            "** For contact pairs of TYPE=SURFACE TO SURFACE that conduct heat: the pressure is linear in the closure.\n\
             *SURFACE INTERACTION, NAME={name}-HEAT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{:.10e}",
            units.stiffness(secant)
        );
        text.push_str("*GAP CONDUCTANCE\n");
        for [pressure, value] in without_load(table, thermal) {
            let _ = writeln!(text, "{:.10e}, {pressure:.10e}", units.thermal(value));
        }
        text.extend(stick);
    }
    if table.points.iter().any(|point| point.electrical.is_some()) {
        text.push_str("** CalculiX has no electrical conductance of a contact: none is written.\n");
    }
    text
}

/// The same from no load on, at which nothing conducts but a medium in the gap: with one the values begin at the first load.
fn without_load(table: &InterfaceTable, points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if table.has_medium { points } else { [vec![[0.0, 0.0]], points].concat() }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableModel {
    Statistical,
    #[default]
    Deterministic,
    Reference,
}

impl TableModel {
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct InterfaceOptions {
    pub model: TableModel,
    /// Whether loads that are not admissible are in it, too, marked.
    pub beyond: bool,
}

/// A value with the ends of its 95 % interval, where there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterfaceValue {
    pub value: f64,
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
    /// -dp/dd, Pa/m, where it is known.
    pub stiffness: Option<f64>,
    /// Limits of admissible loads that are exceeded.
    pub limits: String,
}

/// The joint of one case over its loads.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceTable {
    /// The case as reports name it.
    pub case: String,
    /// Title, bodies, surface, law, loads, model and verdict: a line each.
    pub header: Vec<String>,
    /// By growing load; closures grow, too.
    pub points: Vec<TablePoint>,
    /// -dp/dd at the first load, Pa/m.
    pub first_stiffness: f64,
    /// Whether heat flows through a medium in the gap, too, also without a load.
    pub has_medium: bool,
}

/// The tables of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Interfaces {
    /// Of the cases that have one; at least one.
    pub tables: Vec<InterfaceTable>,
    /// Why others have none.
    pub left_out: Vec<String>,
}

/// Relative to the whole closure, how far apart two points of a jump are.
const JUMP: f64 = 1e-6;

/// The tables of the cases of a comparison.
pub fn interface_tables(results: &dyn Outcome, options: InterfaceOptions) -> Result<Interfaces, String> {
    let Some(results) = (results as &dyn Any).downcast_ref::<CompareResults>() else {
        return Err(
            "found another kind of experiment; allowed: [compare], whose joints have loads".to_owned()
        );
    };
    let (mut tables, mut left_out) = (Vec::new(), Vec::new());
    for case in SurfaceCase::all(results) {
        match table(results, case, options) {
            Ok(table) => tables.push(table),
            Err(reason) => left_out.push(reason),
        }
    }
    match left_out.first().filter(|_| tables.is_empty()) {
        Some(reason) => Err(reason.clone()),
        None => Ok(Interfaces { tables, left_out }),
    }
}

/// A joint at one load before it is placed.
struct LoadPoint {
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
    let all: Vec<LoadPoint> = loads.iter().filter_map(|&load| at_load(case, load, options.model)).collect();
    let curve = case.first().reference.as_ref().filter(|_| options.model == TableModel::Reference);
    if curve.is_some_and(|curve| curve.boundary == Boundary::Finite) {
        return Err(format!(
            "{name}: found a reference on a finite map, whose closure holds the deflection of the map as a whole; allowed: `boundary = \
             \"periodic\"` or `\"mirrored\"`, or another --model"
        ));
    }
    if all.is_empty() {
        return Err(format!(
            "{name}: found no load of the {model} model; allowed: `pressure` or `force` in the spec, and \"{model}\" among its models",
            model = options.model.name()
        ));
    }
    if all.len() == 1 {
        return Err(format!("{name}: found one load; allowed: a list of loads, or a sweep, for a curve"));
    }
    let is_kept = |found: &&LoadPoint| options.beyond || found.point.limits.is_empty();
    let kept: Vec<&LoadPoint> = all.iter().filter(is_kept).collect();
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
    let place = |found: &&LoadPoint| {
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
    let bodies = &results.contact.bodies;
    let mut header = vec![
        results.metadata.title.clone(),
        format!("Bodies: {} on {}.", bodies.rough, bodies.flat),
        format!(
            "Surface {}, law {}{layer}; {} model.",
            case.key().surface,
            case.first().law,
            options.model.name()
        ),
        format!("Nominal pressure {}; {} loads.", range(ends, "Pa"), points.len()),
    ];
    header.extend(not_admissible(&points));
    let verdict = verdict.filter(|_| options.model != TableModel::Reference);
    let at = case
        .case
        .reported_load()
        .map_or_else(String::new, |at| format!(" ({})", input_quantity(at.load, "Pa")));
    header.extend(verdict.into_iter().flat_map(|line| {
        line.texts
            .into_iter()
            .map(|text| format!("May the integral replace the sum{at}? {text}"))
            .collect::<Vec<_>>()
    }));
    let stiffness = kept[0].stiffness.unwrap_or_else(|| {
        // Without one, the secant to the next load.
        let rise = points[1].pressure - points[0].pressure;
        rise / (points[1].closure.value - points[0].closure.value)
    });
    let has_medium = case.surface.spots.medium.is_some();
    Ok(InterfaceTable { case: name, header, points, first_stiffness: stiffness, has_medium })
}

/// "Not admissible: 0.1 to 1 MPa (few-contacts), 30 MPa (interaction)."
fn not_admissible(points: &[TablePoint]) -> Option<String> {
    let stretches = points.chunk_by(|a, b| a.limits == b.limits).filter(|all| !all[0].limits.is_empty());
    let words = |all: &[TablePoint]| {
        let loads = match all {
            [one] => input_quantity(one.pressure, "Pa"),
            _ => range([all[0].pressure, all[all.len() - 1].pressure], "Pa"),
        };
        format!("{loads} ({})", all[0].limits)
    };
    let all: Vec<String> = stretches.map(words).collect();
    (!all.is_empty()).then(|| format!("Not admissible: {}.", all.join(", ")))
}

/// The model at a load; `None` where it was not run there, or has no separation.
fn at_load(case: SurfaceCase, load: f64, model: TableModel) -> Option<LoadPoint> {
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
    Some(LoadPoint {
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
            stiffness: found.point.stiffness.filter(|stiffness| *stiffness > 0.0),
            limits: limits(at.exceeded),
        },
    })
}
