//! The header of a list as text: names of columns, their units, and what separates them.

use super::{ListColumn, ListError, ListOptions, MOST_COLUMNS, column};

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
                (None, Some(unit)) => column::per_metre(unit),
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
