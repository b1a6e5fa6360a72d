//! Separators of numbers in a text.
//!
//! The separator is the first of semicolon, tab, blank and comma that occurs. Commas are decimal commas if another
//! separator is used, every comma is between two digits, and there is no decimal point; ambiguous texts are rejected.

use super::error::ReadError;
use super::table::is_missing;
use crate::progress::Count;

/// The separator of numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    Character(char),
    Blanks,
}

/// How lines are divided into numbers.
pub(super) struct Separation {
    separator: Separator,
    decimal_comma: bool,
    /// Whether every line ends with a separator, which then adds no number.
    trailing: bool,
}

impl Separation {
    /// That of lines, each with its number; `count` is of their bytes.
    pub fn new(lines: &[(usize, &str)], mut count: Count) -> Result<Self, ReadError> {
        let (mut semicolon, mut blank_gap, mut tab_gap, mut point) = (false, false, false, false);
        let (mut commas, mut commas_in_digits, mut leading_zero) = (0u64, 0u64, false);
        for (_, line) in lines {
            count.add(line.len() + 1);
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
        count.end();
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
            Separator::Character(';')
        } else if tab_gap && !blank_gap {
            Separator::Character('\t')
        } else if other || commas == 0 {
            Separator::Blanks
        } else {
            Separator::Character(',')
        };
        let trailing = match separator {
            Separator::Character(character) => {
                lines.iter().all(|(_, line)| line.trim_end_matches(' ').ends_with(character))
            }
            Separator::Blanks => false,
        };
        Ok(Self { separator, decimal_comma: other && commas > 0, trailing })
    }

    /// The words of a line, without quotes.
    pub fn words<'a>(&self, line: &'a str) -> Box<dyn Iterator<Item = &'a str> + 'a> {
        match self.separator {
            Separator::Blanks => Box::new(line.split_whitespace().map(|word| word.trim_matches('"'))),
            Separator::Character(character) => {
                let line = line.trim_matches(' ');
                let line = if self.trailing { line.strip_suffix(character).unwrap_or(line) } else { line };
                Box::new(line.split(character).map(|word| word.trim().trim_matches('"')))
            }
        }
    }

    /// The number of a word: NaN of a mark of a missing point, `None` of other words.
    pub fn value(&self, word: &str) -> Option<f64> {
        let parsed =
            if self.decimal_comma { word.replace(',', ".").parse::<f64>() } else { word.parse::<f64>() };
        parsed.ok().or_else(|| is_missing(word).then_some(f64::NAN))
    }
}
