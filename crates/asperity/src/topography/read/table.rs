//! Tables of numbers in a text, without names of columns, numbers of columns and numbers of lines.

use super::Format;
use super::columns;
use super::content::{LeftOut, NamedUnits};
use super::error::{ReadError, shortened};
use super::labels::{self, Coordinates};
use super::separation::Separation;
use crate::progress::{Count, Progress};

/// Words for a missing point, in any case.
const MISSING: [&str; 14] =
    ["", "nan", "-nan", "bad", "na", "n/a", "null", "none", "-", "--", "---", "1.#qnan", "-1.#ind", "1.#inf"];

/// Numbers in lines of equal length.
pub(super) struct Table {
    pub rows: usize,
    pub columns: usize,
    /// The numbers line by line; NaN where missing.
    pub values: Vec<f64>,
    /// Units in the names of columns x, y and z.
    pub named: NamedUnits,
    /// What holds no numbers of the table.
    pub left_out: LeftOut,
    /// Relative precision of the numbers printed.
    pub precision: f64,
}

impl Table {
    /// Parses a text, skipping comments, a first line that names or numbers the columns, and a first column that numbers or
    /// names the lines: one unit of work.
    pub fn parse(text: &str, progress: &dyn Progress) -> Result<Self, ReadError> {
        let count = |work: f64| Count::new(progress, work, text.len());
        let numbered = || (1..).zip(text.lines()).filter(|(_, line)| !is_comment(line));
        // Counted first: a vector that grows takes three times the memory.
        let mut found = count(0.05);
        let filled = numbered().inspect(|(_, line)| found.add(line.len() + 1)).count();
        found.end();
        let mut lines: Vec<(usize, &str)> = Vec::with_capacity(filled);
        let mut found = count(0.05);
        lines.extend(numbered().inspect(|(_, line)| found.add(line.len() + 1)));
        found.end();
        let named = columns::units(text, lines.first().copied());
        let mut left_out = LeftOut::default();
        if let Some(&(_, line)) = lines.first()
            && columns::are_named(line)
        {
            left_out.index_column = columns::have_index(line);
            lines.remove(0);
        } else if let Some((number, has_corner)) = labels::names(&lines, count(0.1)) {
            left_out = LeftOut { header: Some(number), index_column: has_corner, ..LeftOut::default() };
            lines.remove(0);
        }
        // Reject prose before checking its commas.
        if let Some(&(number, line)) = lines.first()
            && let Some(word) = labels::first_name(line)
        {
            return Err(heading(&lines).unwrap_or_else(|| no_number(0, number, 1, word)));
        }
        let separation =
            Separation::new(&lines, count(0.1)).map_err(|error| heading(&lines).unwrap_or(error))?;
        if let Some((number, has_corner)) = labels::numbers(&lines, &separation) {
            left_out = LeftOut { header: Some(number), index_column: has_corner, ..LeftOut::default() };
            lines.remove(0);
        }
        let coordinates = labels::coordinates(&lines, &separation, left_out.header.is_some());
        if let Some(Coordinates { columns, index_column, lines: down }) = coordinates {
            if columns.is_some() {
                left_out.header = Some(lines.remove(0).0);
            }
            left_out.index_column |= index_column;
            left_out.spacing = [columns, down];
        }
        // From here on one line at a time: their index takes as much memory as the numbers.
        let rows = lines.len();
        drop(lines);
        let above = filled - rows;
        let lines = || numbered().skip(above);
        let (mut values, mut columns, mut digits) = (Vec::new(), 0, 0);
        let mut parsed = count(0.7);
        for (row, (number, line)) in lines().enumerate() {
            let begin = values.len();
            for (column, word) in separation.words(line).enumerate() {
                parsed.add(word.len() + 1);
                if left_out.index_column && column == 0 {
                    // It may be a name, and is left out with its column.
                    values.push(f64::NAN);
                    continue;
                }
                let Some(value) = separation.value(word) else {
                    let error = || no_number(row, number, column + 1, word);
                    return Err(if row == 0 {
                        heading(&lines().collect::<Vec<_>>()).unwrap_or_else(error)
                    } else {
                        error()
                    });
                };
                digits = digits.max(significant_digits(word));
                values.push(value);
            }
            let found = values.len() - begin;
            if row == 0 {
                columns = found;
                // A number takes two bytes.
                values.reserve_exact(columns.saturating_mul(rows - 1).min(text.len() / 2));
            } else if found > columns
                && row + 1 < rows
                && lines().skip(row).all(|(_, line)| separation.words(line).count() == found)
                && let Some((line, text)) = lines().next()
            {
                return Err(ReadError::Heading { line, found: shortened(text), begin: number });
            } else if found != columns {
                return Err(ReadError::Corrupt(format!(
                    "is ragged: line {number} holds {found} numbers; allowed: {columns}, as in its first line",
                )));
            }
        }
        parsed.end();
        if rows == 0 {
            return Err(ReadError::Corrupt("holds no number".to_owned()));
        }
        left_out.index_column |= labels::number_lines(&values, columns);
        if left_out.index_column {
            let mut at = 0..;
            values.retain(|_| at.next().is_some_and(|at: usize| !at.is_multiple_of(columns)));
            columns -= 1;
        }
        if values.iter().all(|value| value.is_nan()) {
            return Err(ReadError::Corrupt("holds no number".to_owned()));
        }
        Ok(Self { rows, columns, values, named, left_out, precision: precision(digits) })
    }
}

/// Whether a word marks a missing point.
pub(super) fn is_missing(word: &str) -> bool {
    MISSING.contains(&word.to_ascii_lowercase().as_str())
}

fn is_comment(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

/// The error of lines above a table of numbers, where there is one below them.
fn heading(lines: &[(usize, &str)]) -> Option<ReadError> {
    /// So many lines of numbers, or all to the end, are a table.
    const ENOUGH: usize = 3;
    let is_row = |(_, line): &&(usize, &str)| {
        let mut words = line.split([' ', '\t', ';']).filter(|word| !word.is_empty()).peekable();
        words.peek().is_some()
            && words.all(|word| {
                let is_part = |part: &str| is_missing(part) || part.parse::<f64>().is_ok();
                is_part(word) || word.split(',').all(is_part)
            })
    };
    let begin = lines.iter().position(|line| is_row(&line)).filter(|&begin| begin > 0)?;
    let rows = lines[begin..].iter().take(ENOUGH).take_while(is_row).count();
    let (line, text) = *lines.first()?;
    (rows == ENOUGH.min(lines.len() - begin) && rows > 1).then(|| ReadError::Heading {
        line,
        found: shortened(text),
        begin: lines[begin].0,
    })
}

fn no_number(row: usize, line: usize, column: usize, word: &str) -> ReadError {
    let found = shortened(word);
    if row == 0 {
        return ReadError::Mismatch(format!(
            "is not a height map: line {line} has \"{found}\" for a number; allowed: {}",
            Format::names()
        ));
    }
    ReadError::Corrupt(format!(
        "line {line}, column {column}: found \"{found}\"; allowed: a number, or NaN, BAD or nothing for a \
         missing point"
    ))
}

/// The relative precision of numbers printed with `digits` significant digits; 0 for few digits, whose steps count as
/// quantisation.
fn precision(digits: usize) -> f64 {
    const MANY: usize = 6;
    if digits < MANY { f64::EPSILON } else { 0.5 * 0.1f64.powi(digits as i32 - 1) }.max(f64::EPSILON)
}

/// The significant digits of a number as it is written.
pub(super) fn significant_digits(word: &str) -> usize {
    let mantissa = word.split(['e', 'E']).next().unwrap_or_default();
    mantissa.chars().filter(char::is_ascii_digit).skip_while(|&digit| digit == '0').count()
}
