//! Tables of numbers in a text, without the lines above them, names of columns, numbers of columns and numbers of lines.

use std::borrow::Cow;

use super::Format;
use super::content::{LeftOut, NamedUnits};
use super::error::{ReadError, shortened};
use super::labels::{self, Coordinates};
use crate::progress::{Count, Progress};

/// Words for a missing point, in any case; besides what C prints for NaN, such as 1.#QNAN, and stars, strokes or question marks alone.
const MISSING: &str = "|nan|-nan|nan(ind)|-nan(ind)|bad|na|n/a|n.a.|null|none|nil|void|no data|nodata|no_data|missing|invalid|masked|#n/a|#nv|\
     #num!|#value!|#div/0!|";

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
    /// The lines above it that hold no row of it, but for comments.
    pub heading: Vec<String>,
    /// The number of the first line below them.
    begin: usize,
    /// Relative precision of the numbers printed.
    pub precision: f64,
}

impl Table {
    /// Parses a text, skipping comments, lines above the table, a first line that names or numbers the columns, and a first column that numbers or
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
        let above = begin(&lines).map_or(0, |begin| {
            let is_label = |above: &usize| {
                labels::are_named(lines[*above].1) || labels::names(&lines[*above..], count(0.0)).is_some()
            };
            let label = begin.checked_sub(1).filter(is_label);
            label.unwrap_or_else(|| first_like(&lines[..begin], cells(lines[begin].1).len()))
        });
        let heading = lines.drain(..above).map(|(_, line)| line.to_owned()).collect();
        let begin = lines.first().map_or(0, |(line, _)| *line);
        let named = labels::units(text, lines.first().copied());
        let mut left_out = LeftOut::default();
        if let Some(&(_, line)) = lines.first()
            && labels::are_named(line)
        {
            left_out.index_column = labels::have_index(line);
            lines.remove(0);
        } else if let Some((number, has_corner)) = labels::names(&lines, count(0.1)) {
            left_out = LeftOut { header: Some(number), index_column: has_corner, ..LeftOut::default() };
            lines.remove(0);
        }
        // Reject prose before checking its commas.
        if let Some(&(number, line)) = lines.first()
            && let Some(word) = labels::first_name(line).filter(|_| !is_row(&cells(line)))
        {
            return Err(mismatch!(
                "is not a height map: line {number} has \"{}\" for a number; {}",
                shortened(word),
                Format::allowed()
            ));
        }
        let separation = Separation::new(&lines, count(0.1))?;
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
                    // Of several words in a line of blanks the blanks between them are no separators.
                    let rest = separation.words(line).skip(column + 1);
                    let rest = rest.take_while(|next| *next != word && separation.value(next).is_none());
                    let rest = rest.take_while(|_| !line.contains([',', ';', '\t']));
                    let word = rest.fold(word.to_owned(), |words, word| words + " " + word);
                    return Err(ReadError::Word { line: number, column: column + 1, word });
                };
                digits = digits.max(significant_digits(word));
                values.push(value);
            }
            let found = values.len() - begin;
            if row == 0 {
                columns = found;
                // A number takes two bytes.
                values.reserve_exact(columns.saturating_mul(rows - 1).min(text.len() / 2));
            } else if found != columns {
                return Err(corrupt!(
                    "is ragged: line {number} holds {found} numbers; allowed: {columns}, as in its first line"
                ));
            }
        }
        parsed.end();
        if rows == 0 {
            return Err(corrupt!("holds no number"));
        }
        left_out.index_column |= labels::number_lines(&values, columns);
        if left_out.index_column {
            let mut at = 0..;
            values.retain(|_| at.next().is_some_and(|at: usize| !at.is_multiple_of(columns)));
            columns -= 1;
        }
        if values.iter().all(|value| value.is_nan()) {
            return Err(corrupt!("holds no number"));
        }
        Ok(Self { rows, columns, values, named, left_out, heading, begin, precision: precision(digits) })
    }

    /// What a reader should know of the lines above the table.
    pub fn note(&self) -> Option<String> {
        let tells = |line: &&String| {
            let line = line.to_lowercase();
            ["pixel", "unit", "scale", "spacing", "size", "factor"].iter().any(|word| line.contains(word))
        };
        let above = shortened(self.heading.iter().find(tells).or(self.heading.first())?);
        Some(format!(
            "is read from line {} on: what stands above (\"{above}\") is no row of its table, and a pixel, a unit or a factor there is not known",
            self.begin
        ))
    }
}

/// Whether a word marks a missing point.
pub(super) fn is_missing(word: &str) -> bool {
    let is_repeated = |mark: char| word.chars().all(|c| c == mark);
    word.strip_prefix('-').unwrap_or(word).starts_with("1.#")
        || ['*', '-', '?'].into_iter().any(is_repeated)
        || MISSING.contains(&format!("|{}|", word.to_ascii_lowercase()))
}

/// The text with NaN for words that mark missing points: those of its user, and "No Data", which is two.
pub(super) fn with_marks<'a>(text: &'a str, marks: &[String]) -> Cow<'a, str> {
    let usual = ["No Data", "no data", "NO DATA"];
    let mut text = Cow::Borrowed(text);
    for mark in marks.iter().map(String::as_str).chain(usual) {
        if mark.is_empty() || !text.contains(mark) {
            continue;
        }
        let is_end = |c: Option<char>| c.is_none_or(|c| c.is_whitespace() || matches!(c, ',' | ';' | '"'));
        let mut replaced = String::with_capacity(text.len());
        let mut end = 0;
        for (place, _) in text.match_indices(mark) {
            let behind = place + mark.len();
            if is_end(text[..place].chars().next_back()) && is_end(text[behind..].chars().next()) {
                replaced.extend([&text[end..place], "NaN"]);
                end = behind;
            }
        }
        replaced.push_str(&text[end..]);
        text = Cow::Owned(replaced);
    }
    text
}

fn is_comment(line: &str) -> bool {
    let line = line.trim();
    // A line may begin with a missing point as Excel writes it.
    let is_missing = || cells(line).first().is_some_and(|cell| is_missing(cell));
    line.is_empty() || line.starts_with('#') && !is_missing()
}

/// The cells of a line by itself, before the separator of the table is known.
fn cells(line: &str) -> Vec<&str> {
    let line = line.trim_matches(' ');
    // Tabs may stand before numbers between blanks.
    let inner = line.trim();
    let line = if inner.contains(' ') && !inner.contains('\t') { inner } else { line };
    let separated = |by: char| line.split(by).map(|cell| cell.trim().trim_matches('"').trim()).collect();
    if line.contains(';') {
        separated(';')
    } else if line.contains('\t') {
        separated('\t')
    } else if line.contains(char::is_whitespace) && !line.contains(", ") {
        line.split_whitespace().map(|cell| cell.trim_matches('"')).collect()
    } else {
        separated(',')
    }
}

fn is_number(cell: &str) -> bool {
    cell.parse::<f64>().is_ok() || cell.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// The place of the first row: of the first lines that follow each other and have equally many cells, all of them numbers or missing points.
fn begin(lines: &[(usize, &str)]) -> Option<usize> {
    /// So many such lines, or all to the end, are a table.
    const ENOUGH: usize = 3;
    // The number of cells, 0 of another line.
    let width = |(_, line): &(usize, &str)| {
        let cells = cells(line);
        let is_row = cells.iter().all(|cell| is_number(cell) || is_missing(cell));
        if is_row { cells.len() } else { 0 }
    };
    let mut run = (0, 0);
    for (place, line) in lines.iter().enumerate() {
        let (width, is_last) = (width(line), place + 1 == lines.len());
        if width == 0 {
            run = (0, 0);
            continue;
        }
        run = if width == run.0 { (width, run.1 + 1) } else { (width, 1) };
        if run.1 == ENOUGH || is_last && (run.1 > 1 || place == 0) {
            return Some(place + 1 - run.1);
        }
    }
    None
}

/// The place of the first of the lines above a table of so many columns that is a row, but for a word, a number or its separators.
fn first_like(lines: &[(usize, &str)], columns: usize) -> usize {
    /// Fewer numbers may stand in a line above a table by chance.
    const FEWEST: usize = 4;
    let numbers = |line: &str| {
        line.split([' ', '\t', ',', ';']).filter(|part| is_number(part.trim_matches('"'))).count()
    };
    let is_like = |(_, line): &(usize, &str)| {
        let cells = cells(line);
        columns >= FEWEST && numbers(line) + 1 >= columns || cells.len() == columns && is_row(&cells)
    };
    lines.iter().position(is_like).unwrap_or(lines.len())
}

/// Whether cells with words are a row of a table: numbers for the most part, the first ones of three, or one word several times.
fn is_row(cells: &[&str]) -> bool {
    let is_word = |cell: &&&str| !is_number(cell) && !is_missing(cell);
    let words: Vec<&&str> = cells.iter().filter(is_word).collect();
    let numbers = cells.iter().filter(|cell| is_number(cell)).count();
    numbers > 1
        && 2 * numbers >= cells.len()
        && (cells.len() > 3 || is_number(cells[0]) && is_number(cells[1]))
        || words.windows(2).any(|pair| pair[0] == pair[1])
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

/// The separator of numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    Character(char),
    Blanks,
}

/// How lines are divided into numbers. The separator is the first of semicolon, tab, blank and comma that occurs. Commas are decimal commas
/// if another separator is used, every comma is between two digits, and there is no decimal point; ambiguous texts are rejected.
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
            return Err(unsupported!(
                "has {found}; allowed: decimal points, or decimal commas with semicolons or tabs between \
                 the numbers"
            ));
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
