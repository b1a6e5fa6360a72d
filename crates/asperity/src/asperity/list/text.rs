//! Rows of a list as text.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::header::{Header, Separator};
use super::{ListColumn, ListError, ListOptions};
use crate::progress::{Count, Progress};

/// Reads each row in SI, with the columns of its values (those `needed`, and the places where the file has them), and returns the number of
/// rows: one unit of work.
///
/// # Errors
/// See [`ListError`].
pub(super) fn rows(
    path: &Path,
    needed: &'static [ListColumn],
    options: ListOptions,
    progress: &dyn Progress,
    mut keep: impl FnMut(&Header, &[f64]),
) -> Result<usize, ListError> {
    let file = File::open(path)?;
    let mut counted = Count::new(progress, 1.0, file.metadata()?.len() as usize);
    let mut file = BufReader::with_capacity(1 << 16, file);
    let mut bytes = Vec::new();
    let mut header: Option<Header> = None;
    let mut comment: Option<(usize, String)> = None;
    let mut marks = DecimalMarks::default();
    let mut values = vec![0.0; ListColumn::ALL.len()];
    let mut count = 0;
    for line in 1.. {
        bytes.clear();
        if file.read_until(b'\n', &mut bytes)? == 0 {
            break;
        }
        counted.add(bytes.len());
        if line == 1 && (bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")) {
            return Err(ListError::Encoding);
        }
        let text = decoded(&bytes);
        let text = text.trim_start_matches('\u{feff}').trim_end_matches(['\r', '\n']);
        if text.trim().is_empty() {
            continue;
        }
        if let Some(words) = text.trim_start().strip_prefix('#') {
            if header.is_none() {
                comment = Some((line, words.to_owned()));
            }
            continue;
        }
        let header = match &mut header {
            Some(header) => header,
            None if Header::is_missing_before(text) => {
                // As numpy.savetxt writes it, the header is a comment.
                let named = comment
                    .take()
                    .and_then(|(line, words)| Header::parse(&words, line, needed, options).ok());
                header.insert(named.ok_or(ListError::NoHeader { line, needed })?)
            }
            None => {
                header = Some(Header::parse(text, line, needed, options)?);
                continue;
            }
        };
        row(text, line, header, &mut marks, &mut values)?;
        keep(header, &values);
        count += 1;
    }
    counted.end();
    match (header, count) {
        (None, _) => Err(ListError::Column {
            column: ListColumn::Height,
            needed,
            found: "no line besides comments".to_owned(),
        }),
        (Some(_), 0) => Err(ListError::Empty),
        (Some(_), count) => Ok(count),
    }
}

/// Some programs write µ in Latin-1.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect::<String>().into(),
    }
}

/// Lines of the first decimal point and of the first decimal comma.
#[derive(Default)]
struct DecimalMarks {
    point: Option<usize>,
    comma: Option<usize>,
}

impl DecimalMarks {
    /// The number in a cell of `line`.
    fn number(&mut self, cell: &str, line: usize, separator: Separator) -> Option<f64> {
        if let Ok(value) = cell.parse() {
            if self.point.is_none() && cell.contains('.') {
                self.point = Some(line);
            }
            return Some(value);
        }
        if separator == Separator::Character(',') || cell.contains('.') {
            return None;
        }
        let value = cell.replacen(',', ".", 1).parse().ok()?;
        self.comma.get_or_insert(line);
        Some(value)
    }
}

fn row(
    text: &str,
    line: usize,
    header: &Header,
    marks: &mut DecimalMarks,
    values: &mut [f64],
) -> Result<(), ListError> {
    let (mut found, mut bad) = (0, None);
    for (k, cell) in header.separator.cells(text).enumerate() {
        // A separator after the last cell adds none.
        if k < header.width || !cell.is_empty() {
            found = k + 1;
        }
        let Some(Some((rank, per_metre))) = header.places.get(k) else { continue };
        let column = header.columns[*rank];
        let value = marks.number(cell, line, header.separator).map(|value| column.si(value, *per_metre));
        match value.filter(|&value| column.allows(value)) {
            Some(value) => values[*rank] = value,
            None => bad = bad.or(Some((column, cell))),
        }
    }
    if found != header.width {
        return Err(ragged(text, line, found, header));
    }
    if let Some((column, cell)) = bad {
        let found = if cell.is_empty() { "nothing".to_owned() } else { format!("`{}`", shortened(cell)) };
        return Err(ListError::Cell { place: format!("line {line}"), column, found });
    }
    match (marks.point, marks.comma) {
        (Some(point), Some(comma)) => Err(ListError::DecimalMarks { point, comma }),
        _ => Ok(()),
    }
}

fn ragged(text: &str, line: usize, found: usize, header: &Header) -> ListError {
    ListError::Ragged {
        line,
        found,
        allowed: header.width,
        header: header.line,
        text: shortened(text),
        may_be_decimal_commas: header.separator == Separator::Character(',') && found == 2 * header.width,
    }
}

fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}
