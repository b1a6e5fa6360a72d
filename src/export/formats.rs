//! A table of a joint as programs for finite elements read it.

use std::fmt::Write;

use super::ExportedFile;
use super::interface::{InterfaceTable, InterfaceValue, TablePoint};

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
