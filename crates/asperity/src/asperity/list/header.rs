//! The columns of a list, and its header as text: their names, their units, and what separates them.

use super::{ListError, ListOptions, MOST_COLUMNS};
use crate::named_enum;
use crate::numeric::{LARGEST, is_positive};
use crate::units::Dimension;

/// What separates the cells of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// One character, which may also stand between quotes in a cell.
    Character(char),
    /// Any number of blanks and tabs.
    Blanks,
}

impl Separator {
    /// The first of semicolon, tab and comma that a header contains, else blanks.
    fn detect(header: &str) -> Self {
        let separator = [';', '\t', ','].into_iter().find(|&character| header.contains(character));
        separator.map_or(Self::Blanks, Self::Character)
    }

    /// The cells of a line, without blanks and quotes around them.
    pub fn cells(self, line: &str) -> Cells<'_> {
        Cells { rest: Some(line), separator: self }
    }
}

/// Iterator over the cells of a line.
pub(super) struct Cells<'a> {
    rest: Option<&'a str>,
    separator: Separator,
}

impl<'a> Iterator for Cells<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let rest = self.rest?;
        let Separator::Character(separator) = self.separator else {
            let rest = rest.trim_start();
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            self.rest = rest.get(end..);
            return rest.get(..end).filter(|cell| !cell.is_empty());
        };
        let mut is_quoted = false;
        let end = rest.find(|character| {
            is_quoted ^= character == '"';
            character == separator && !is_quoted
        });
        let (cell, after) = match end {
            Some(end) => (&rest[..end], rest.get(end + separator.len_utf8()..)),
            None => (rest, None),
        };
        self.rest = after;
        Some(cell.trim().trim_matches('"').trim())
    }
}

/// Where the needed columns are, and in which unit.
#[derive(Debug)]
pub(super) struct Header {
    pub separator: Separator,
    /// Number of columns of the file.
    pub width: usize,
    /// The number of the line, from 1.
    pub line: usize,
    /// The columns that are read: the needed ones, and the places of the asperities where the file has both.
    pub columns: Vec<ListColumn>,
    /// For each column of the file its place among those, and how many of its unit of length are a metre.
    pub places: Vec<Option<(usize, f64)>>,
    /// Whether a column is taken for metres because neither it nor its user names a unit.
    pub takes_metres: bool,
}

impl Header {
    /// Parses the header in `line`.
    pub fn parse(
        text: &str,
        line: usize,
        needed: &'static [ListColumn],
        options: ListOptions,
    ) -> Result<Self, ListError> {
        let separator = Separator::detect(text);
        let mut named = names(text, separator);
        if named.len() > MOST_COLUMNS {
            return Err(ListError::Wide { line });
        }
        while named.last().is_some_and(|(name, unit)| name.is_empty() && unit.is_none()) {
            named.pop();
        }
        let found = || {
            let names: Vec<&str> = named.iter().map(|(name, _)| name.as_str()).collect();
            names.join(", ")
        };
        let mut places: Vec<Option<(usize, f64)>> = vec![None; named.len()];
        let mut takes_metres = false;
        let is_there =
            |column: &ListColumn| named.iter().any(|(name, _)| ListColumn::named(name) == Some(*column));
        let mut columns = needed.to_vec();
        if ListColumn::PLACES.iter().all(is_there) {
            columns.extend(ListColumn::PLACES);
        }
        for (rank, &wanted) in columns.iter().enumerate() {
            let mut of_name = (0..named.len()).filter(|&k| ListColumn::named(&named[k].0) == Some(wanted));
            let Some(place) = of_name.next() else {
                return Err(ListError::Column { column: wanted, needed, found: found() });
            };
            if let Some(second) = of_name.next() {
                return Err(ListError::Duplicate { column: wanted, line, places: [place + 1, second + 1] });
            }
            let per_metre = match (&named[place].1, options.unit) {
                (Some(_), Some(_)) => return Err(ListError::UnitHeld { line }),
                (Some(unit), None) => wanted.per_metre(unit).ok_or_else(|| ListError::Unit {
                    column: wanted,
                    line,
                    unit: unit.clone(),
                })?,
                (None, Some(unit)) => per_metre(unit),
                (None, None) => {
                    takes_metres = true;
                    1.0
                }
            };
            places[place] = Some((rank, per_metre));
        }
        Ok(Self { separator, width: named.len(), line, columns, places, takes_metres })
    }

    /// Whether a line is a row of numbers rather than names.
    pub fn is_missing_before(line: &str) -> bool {
        let mut words = line.split([';', ',', '\t', ' ']).filter(|word| !word.is_empty());
        words.all(|word| word.trim_matches('"').parse::<f64>().is_ok())
    }
}

/// The names of columns with their units: `height`, `height [um]` or `height (um)`.
fn names(text: &str, separator: Separator) -> Vec<(String, Option<String>)> {
    let split = |cell: &str| {
        let (name, unit) =
            cell.split_once(['[', '(']).map_or((cell, None), |(name, unit)| (name, Some(unit)));
        let unit = unit.map(|unit| unit.trim_end_matches([']', ')']).trim().to_owned());
        (name.trim().to_owned(), unit)
    };
    let mut names: Vec<(String, Option<String>)> = Vec::new();
    // One more than is allowed.
    for cell in separator.cells(text).take(MOST_COLUMNS + 1) {
        let (name, unit) = split(cell);
        // Between blanks a unit is a cell of its own.
        match names.last_mut().filter(|_| separator == Separator::Blanks && name.is_empty()) {
            Some(last) => last.1 = unit,
            None => names.push((name, unit)),
        }
    }
    names
}

named_enum! {
    /// A column of a list, by its name in a header.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum ListColumn {
        /// Height, m.
        Height = "height",
        /// Radius, m.
        Radius = "radius",
        /// One principal curvature, 1/m.
        Kx = "kx",
        /// The other one, 1/m.
        Ky = "ky",
        /// Place along x, m.
        X = "x",
        /// Place along y, m.
        Y = "y",
    }
}

impl ListColumn {
    /// The columns of an array in their order; the first two suffice for spheres.
    pub(super) const OF_ARRAY: &'static [Self] = &[Self::Height, Self::Radius, Self::Kx, Self::Ky];

    /// Those that a text may have besides, both or neither.
    pub(super) const PLACES: [Self; 2] = [Self::X, Self::Y];

    /// The column of this name, in any case.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|column| column.name().eq_ignore_ascii_case(name))
    }

    const fn is_length(self) -> bool {
        !matches!(self, Self::Kx | Self::Ky)
    }

    const fn si_unit(self) -> &'static str {
        if self.is_length() { "m" } else { "1/m" }
    }

    /// Names and SI units of columns, for a message.
    pub(super) fn names(columns: &[Self]) -> String {
        let named: Vec<String> =
            columns.iter().map(|column| format!("{} [{}]", column.name(), column.si_unit())).collect();
        named.join(", ")
    }

    /// How many of the unit of length that `unit` names, or is the reciprocal of, are a metre; `None` of another unit.
    pub(super) fn per_metre(self, unit: &str) -> Option<f64> {
        let unit = unit.trim();
        let length = if self.is_length() {
            unit
        } else {
            let before = unit.strip_prefix("1/").or_else(|| unit.strip_prefix('/'));
            before.or_else(|| unit.strip_suffix("^-1")).or_else(|| unit.strip_suffix("⁻¹"))?
        };
        Dimension::Length.documented_factor(length.trim()).map(per_metre)
    }

    /// The units that a header may name.
    pub(super) fn allowed_units(self) -> String {
        let reciprocal = if self.is_length() { "" } else { "1/" };
        let units = Dimension::Length.documented().iter().map(|unit| format!("{reciprocal}{unit}"));
        units.collect::<Vec<_>>().join(", ")
    }

    /// A value in SI, given in units of which `per_metre` are a metre.
    pub(super) fn si(self, value: f64, per_metre: f64) -> f64 {
        if self.is_length() { value / per_metre } else { value * per_metre }
    }

    /// Whether an SI value is valid.
    pub(super) fn allows(self, value: f64) -> bool {
        match self {
            Self::Height | Self::X | Self::Y => value.abs() <= LARGEST,
            Self::Radius | Self::Kx | Self::Ky => is_positive(value),
        }
    }

    pub(super) const fn allowed(self) -> &'static str {
        match self {
            Self::Height | Self::X | Self::Y => "a finite number (at most 1e30 m)",
            Self::Radius => "a positive finite number (1e-30 to 1e30 m)",
            Self::Kx | Self::Ky => "a positive finite number (1e-30 to 1e30 per metre)",
        }
    }
}

/// How many of a unit of length (m) are a metre. Of a power of ten the result is exact, so that 50 nm, divided by it, is
/// 5e-8 m to the bit.
pub(super) fn per_metre(unit: f64) -> f64 {
    let (exact, whole) = (unit.recip(), unit.recip().round());
    if (exact / whole - 1.0).abs() < 1e-12 { whole } else { exact }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_every_unit_are_those_in_metres() {
        for unit in Dimension::Length.documented() {
            let per_metre = ListColumn::Height.per_metre(unit).unwrap();
            assert_eq!(ListColumn::Height.si(per_metre, per_metre), 1.0, "{unit}");
            assert_eq!(ListColumn::Kx.per_metre(&format!("1/{unit}")), Some(per_metre));
            assert_eq!(ListColumn::Kx.per_metre(&format!("{unit}^-1")), Some(per_metre));
        }
        assert_eq!(ListColumn::Height.si(50.0, per_metre(1e-9)), 5e-8);
        assert_eq!(ListColumn::Ky.si(0.5, per_metre(1e-6)), 5e5);
        assert_eq!(ListColumn::Kx.per_metre("um"), None);
        assert_eq!(ListColumn::Radius.per_metre("1/um"), None);
        assert_eq!(per_metre(0.0254), 0.0254f64.recip());
    }
}
