//! Tables of numbers in a text: separators and marks of missing numbers.
//!
//! The separator is the first of semicolon, tab, blank and comma that occurs. Commas are decimal commas if another
//! separator is used, every comma is between two digits, and there is no decimal point; ambiguous texts are rejected.

use super::error::{FORMATS, ReadError, shortened};

/// Words for a missing point, in any case.
const MISSING: [&str; 14] =
    ["", "nan", "-nan", "bad", "na", "n/a", "null", "none", "-", "--", "---", "1.#qnan", "-1.#ind", "1.#inf"];

/// Numbers in lines of equal length.
pub(super) struct Table {
    pub rows: usize,
    pub columns: usize,
    /// The numbers line by line; NaN where missing.
    pub values: Vec<f64>,
    /// Relative precision of the numbers printed.
    pub precision: f64,
}

/// The separator of numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    RoughnessParameters(char),
    Blanks,
}

struct Separation {
    separator: Separator,
    decimal_comma: bool,
    /// Whether every line ends with a separator, which then adds no number.
    trailing: bool,
}

impl Table {
    /// Parses a text, skipping comments and a first line that names the columns x, y, z.
    pub fn parse(text: &str) -> Result<Self, ReadError> {
        let mut lines: Vec<(usize, &str)> =
            (1..).zip(text.lines()).filter(|(_, line)| !is_comment(line)).collect();
        if let Some(&(number, line)) = lines.first()
            && names_columns(line)
        {
            if line.contains(['[', '(', '/']) {
                return Err(ReadError::UnitsInColumns { line: number, found: shortened(line) });
            }
            lines.remove(0);
        }
        // Reject prose before checking its commas.
        if let Some(&(number, line)) = lines.first() {
            let mut words = line.split([' ', '\t', ',', ';']).map(|word| word.trim_matches('"'));
            if let Some(word) =
                words.find(|word| !is_missing(word) && !word.contains(|c: char| c.is_ascii_digit()))
                && word.parse::<f64>().is_err()
            {
                return Err(no_number(0, number, 1, word));
            }
        }
        let separation = Separation::new(&lines)?;
        let mut table = Self { rows: lines.len(), columns: 0, values: Vec::new(), precision: 0.0 };
        let mut digits = 0;
        for (row, &(number, line)) in lines.iter().enumerate() {
            let begin = table.values.len();
            for word in separation.words(line) {
                let Some(value) = separation.value(word) else {
                    return Err(no_number(row, number, table.values.len() - begin + 1, word));
                };
                digits = digits.max(significant_digits(word));
                table.values.push(value);
            }
            let found = table.values.len() - begin;
            if row == 0 {
                table.columns = found;
            } else if found != table.columns {
                return Err(ReadError::Corrupt(format!(
                    "is ragged: line {number} holds {found} numbers; allowed: {}, as in its first line",
                    table.columns
                )));
            }
        }
        if table.values.iter().all(|value| value.is_nan()) {
            return Err(ReadError::Corrupt("holds no number".to_owned()));
        }
        table.precision = precision(digits);
        Ok(table)
    }
}

fn is_missing(word: &str) -> bool {
    MISSING.contains(&word.to_ascii_lowercase().as_str())
}

fn is_comment(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

/// Whether a line contains the names x, y and z in this order and no number.
fn names_columns(line: &str) -> bool {
    let initials = line
        .split([' ', '\t', ',', ';'])
        .filter_map(|word| word.trim_matches('"').chars().next())
        .map(|initial| initial.to_ascii_lowercase());
    let mut wanted = "xyz".chars().peekable();
    for initial in initials {
        if initial.is_ascii_digit() {
            return false;
        }
        wanted.next_if_eq(&initial);
    }
    wanted.next().is_none()
}

fn no_number(row: usize, line: usize, column: usize, word: &str) -> ReadError {
    let found = shortened(word);
    if row == 0 {
        return ReadError::Mismatch(format!(
            "is not a height map: line {line} has \"{found}\" for a number; allowed: {}",
            FORMATS
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

fn significant_digits(word: &str) -> usize {
    let mantissa = word.split(['e', 'E']).next().unwrap_or_default();
    mantissa.chars().filter(char::is_ascii_digit).skip_while(|&digit| digit == '0').count()
}

impl Separation {
    fn new(lines: &[(usize, &str)]) -> Result<Self, ReadError> {
        let (mut semicolon, mut blank_gap, mut tab_gap, mut point) = (false, false, false, false);
        let (mut commas, mut commas_in_digits, mut leading_zero) = (0u64, 0u64, false);
        for (_, line) in lines {
            let line = line.trim();
            point |= line.contains('.');
            semicolon |= line.contains(';');
            let (mut before, mut gap, mut tab) = (None::<char>, false, false);
            let mut rest = line.chars().peekable();
            while let Some(character) = rest.next() {
                if character == ' ' || character == '\t' {
                    (gap, tab) = (true, tab || character == '\t');
                    continue;
                }
                let beside_separator = matches!(character, ',' | ';') || matches!(before, Some(',' | ';'));
                if gap && !beside_separator {
                    (blank_gap, tab_gap) = (blank_gap || !tab, tab_gap || tab);
                }
                if character == ',' {
                    commas += 1;
                    let follows_digit = !gap && before.is_some_and(|before| before.is_ascii_digit());
                    if follows_digit && rest.peek().is_some_and(char::is_ascii_digit) {
                        commas_in_digits += 1;
                    }
                }
                leading_zero |= before == Some(',')
                    && !gap
                    && character == '0'
                    && rest.peek().is_some_and(char::is_ascii_digit);
                (before, gap, tab) = (Some(character), false, false);
            }
        }
        let other = semicolon || blank_gap || tab_gap;
        let unclear = if commas == 0 {
            None
        } else if other && (point || commas_in_digits < commas) {
            Some("commas beside other separators or decimal points")
        } else if !other && !point && leading_zero {
            Some("commas that may separate numbers or decimals")
        } else {
            None
        };
        if let Some(found) = unclear {
            return Err(ReadError::Unsupported(format!(
                "has {found}; allowed: decimal points, or decimal commas with semicolons or tabs between \
                 the numbers"
            )));
        }
        let separator = if semicolon {
            Separator::RoughnessParameters(';')
        } else if tab_gap && !blank_gap {
            Separator::RoughnessParameters('\t')
        } else if other || commas == 0 {
            Separator::Blanks
        } else {
            Separator::RoughnessParameters(',')
        };
        let trailing = match separator {
            Separator::RoughnessParameters(character) => {
                lines.iter().all(|(_, line)| line.trim_end_matches(' ').ends_with(character))
            }
            Separator::Blanks => false,
        };
        Ok(Self { separator, decimal_comma: other && commas > 0, trailing })
    }

    fn words<'a>(&self, line: &'a str) -> Box<dyn Iterator<Item = &'a str> + 'a> {
        match self.separator {
            Separator::Blanks => Box::new(line.split_whitespace()),
            Separator::RoughnessParameters(character) => {
                let line = line.trim_matches(' ');
                let line = if self.trailing { line.strip_suffix(character).unwrap_or(line) } else { line };
                Box::new(line.split(character).map(|word| word.trim().trim_matches('"')))
            }
        }
    }

    fn value(&self, word: &str) -> Option<f64> {
        let parsed =
            if self.decimal_comma { word.replace(',', ".").parse::<f64>() } else { word.parse::<f64>() };
        parsed.ok().or_else(|| is_missing(word).then_some(f64::NAN))
    }
}
