//! A table of a joint as programs for finite elements read it.

use std::fmt::Write;

use super::ExportedFile;
use super::interface::{InterfaceTable, InterfaceValue, TablePoint};

/// A format of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Columns separated by commas, with the ends of the intervals.
    Csv,
    /// Keywords of Abaqus.
    Abaqus,
    /// Keywords of CalculiX.
    Calculix,
    /// Functions of MOOSE.
    Moose,
    /// Interpolation functions of COMSOL.
    Comsol,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Csv, Self::Abaqus, Self::Calculix, Self::Moose, Self::Comsol];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Abaqus => "abaqus",
            Self::Calculix => "calculix",
            Self::Moose => "moose",
            Self::Comsol => "comsol",
        }
    }

    /// How its files end.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Abaqus | Self::Calculix => "inp",
            Self::Moose => "i",
            Self::Comsol => "txt",
        }
    }

    /// Whether its files were run in the program that they are for.
    const fn is_tested(self) -> bool {
        matches!(self, Self::Csv | Self::Calculix)
    }
}

/// Units of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UnitSystem {
    /// m, N, Pa, W, S.
    #[default]
    Si,
    /// mm, N, MPa, mW, mA, V: consistent with t, s and mJ.
    Mm,
}

impl UnitSystem {
    /// All of them.
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
    let of_end = |&(end, ending): &(IntervalEnd, &str)| match format {
        Format::Comsol => comsol(table, &format!("{name}{ending}"), units, end),
        Format::Moose => {
            vec![ExportedFile { name: format!("{name}{ending}.i"), text: moose(table, units, end) }]
        }
        _ => vec![ExportedFile {
            name: format!("{name}{ending}.inp"),
            text: keywords(table, &format!("{name}{ending}"), format, units, end),
        }],
    };
    IntervalEnd::all_of(table).iter().flat_map(of_end).collect()
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
    if !format.is_tested() {
        let _ = writeln!(
            text,
            "{comment} Untested: written from the description of the format, not run in its program."
        );
    }
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
fn keywords(
    table: &InterfaceTable,
    name: &str,
    format: Format,
    units: UnitSystem,
    end: IntervalEnd,
) -> String {
    let mut text = header(table, "**", format, units, end);
    let name = name.to_uppercase();
    if format == Format::Calculix {
        let _ = writeln!(text, "** For contact pairs of TYPE=NODE TO SURFACE:");
    }
    let _ = writeln!(text, "*SURFACE INTERACTION, NAME={name}");
    text.push_str("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n");
    for [closure, pressure] in curve(table, units, end) {
        let _ = writeln!(text, "{pressure:.10e}, {closure:.10e}");
    }
    let thermal = over_pressure(table, units, end, |point| point.thermal);
    let electrical = over_pressure(table, units, end, |point| point.electrical);
    let friction = over_pressure(table, units, end, |point| point.friction);
    if format == Format::Abaqus {
        let scale = [UnitSystem::thermal, UnitSystem::electrical];
        let keys = ["*GAP CONDUCTANCE, PRESSURE", "*GAP ELECTRICAL CONDUCTANCE, PRESSURE"];
        for ((values, scale), key) in [thermal, electrical].iter().zip(scale).zip(keys) {
            conductance(&mut text, key, &without_load(table, values), &|value| scale(units, value));
        }
        if !friction.is_empty() {
            text.push_str("*FRICTION\n");
        }
        for [pressure, value] in friction {
            let _ = writeln!(text, "{value:.10e}, 0., {pressure:.10e}");
        }
        return text;
    }
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
        conductance(&mut text, "*GAP CONDUCTANCE", &without_load(table, &thermal), &|value| {
            units.thermal(value)
        });
        text.extend(stick);
    }
    if !electrical.is_empty() {
        text.push_str("** CalculiX has no electrical conductance of a contact: none is written.\n");
    }
    text
}

/// The lines of a conductance: value and pressure, from no load on.
fn conductance(text: &mut String, key: &str, values: &[[f64; 2]], scale: &dyn Fn(f64) -> f64) {
    if values.is_empty() {
        return;
    }
    let _ = writeln!(text, "{key}");
    for &[pressure, value] in values {
        let _ = writeln!(text, "{:.10e}, {pressure:.10e}", scale(value));
    }
}

/// The same from no load on, at which nothing conducts but a medium in the gap: with one the values begin at the first load.
fn without_load(table: &InterfaceTable, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if table.has_medium || points.is_empty() { points.to_vec() } else { [&[[0.0, 0.0]], points].concat() }
}

/// Piecewise linear functions.
fn moose(table: &InterfaceTable, units: UnitSystem, end: IntervalEnd) -> String {
    let mut text = header(table, "#", Format::Moose, units, end);
    text.push_str("[Functions]\n");
    let mut function = |name: &str, points: &[[f64; 2]]| {
        if points.is_empty() {
            return;
        }
        let values = |place: usize| {
            points.iter().map(|point| format!("{:.10e}", point[place])).collect::<Vec<_>>().join(" ")
        };
        let _ = writeln!(
            text,
            "  [{name}]\n    type = PiecewiseLinear\n    x = '{}'\n    y = '{}'\n  []",
            values(0),
            values(1)
        );
    };
    function("pressure_over_closure", &curve(table, units, end));
    for (name, points) in of_pressure(table, units, end) {
        function(&format!("{name}_over_pressure"), &points);
    }
    text.push_str("[]\n");
    text
}

/// Conductances and friction over the pressure, in the units of the table.
fn of_pressure(
    table: &InterfaceTable,
    units: UnitSystem,
    end: IntervalEnd,
) -> [(&'static str, Vec<[f64; 2]>); 3] {
    let scaled = |points: Vec<[f64; 2]>, scale: &dyn Fn(f64) -> f64| {
        without_load(table, &points).into_iter().map(|[pressure, value]| [pressure, scale(value)]).collect()
    };
    let electrical = over_pressure(table, units, end, |point| point.electrical);
    let thermal = over_pressure(table, units, end, |point| point.thermal);
    [
        ("electrical_conductance", scaled(electrical, &|value| units.electrical(value))),
        ("thermal_conductance", scaled(thermal, &|value| units.thermal(value))),
        ("friction", over_pressure(table, units, end, |point| point.friction)),
    ]
}

/// A text of two columns for each interpolation function.
fn comsol(table: &InterfaceTable, name: &str, units: UnitSystem, end: IntervalEnd) -> Vec<ExportedFile> {
    let file = |function: &str, points: &[[f64; 2]]| {
        let mut text = header(table, "%", Format::Comsol, units, end);
        for [x, y] in points {
            let _ = writeln!(text, "{x:.10e} {y:.10e}");
        }
        ExportedFile { name: format!("{name}-{function}.txt"), text }
    };
    let first = file("pressure_over_closure", &curve(table, units, end));
    let others = of_pressure(table, units, end).into_iter().filter(|(_, points)| !points.is_empty());
    let others = others.map(|(name, points)| file(&format!("{name}_over_pressure"), &points));
    std::iter::once(first).chain(others).collect()
}
