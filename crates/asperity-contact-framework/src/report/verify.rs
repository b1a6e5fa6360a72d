//! Comparison of new reports with committed ones. Columns say how their cells are compared ([`Comparison`]); all other numbers of
//! `summary.json` are compared relative to themselves; pages and pictures by their text and their numbers, which may differ in the last
//! digit that is shown. Of contacts that were counted only whether there were any: the rounds of a search for a load end by the last
//! digits, which machines with other registers do not share.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::{fs, io};

use serde_json::Value;

use super::digest::DigestRow;
use super::table::{Comparison, Heading, Row, Schema};
use crate::folder::LONG;
use crate::kind::RegisteredKind;

/// Relative tolerance of a number.
const TOLERANCE: f64 = 1e-9;

const SUMMARY: &str = "summary.json";

/// Keys of a summary that are not compared: the hashes of files whose content is compared, those of sources, and the names of all files.
const NOT_COMPARED: [&str; 3] = ["committed", "library_sha256", "files"];

/// What a comparison of two folders found.
#[derive(Debug, Default)]
pub struct Verified {
    pub differences: Vec<String>,
    /// Committed reports of long runs that were not made again.
    pub not_run: Vec<String>,
}

/// Differences between the reports in `fresh` and those in `committed`; long runs need not have been made again.
pub fn verified(fresh: &Path, committed: &Path, kinds: &[RegisteredKind]) -> io::Result<Verified> {
    let (mut lines, mut not_run) = (Vec::new(), Vec::new());
    let (new, old) = (reports(fresh)?, reports(committed)?);
    for name in new.symmetric_difference(&old) {
        if new.contains(name) {
            lines.push(format!("{name}: is not committed"));
        } else if summary(&committed.join(name))?["run"] == LONG {
            not_run.push(name.clone());
        } else {
            lines.push(format!("{name}: was not made again"));
        }
    }
    for name in new.intersection(&old) {
        lines.extend(Report::read(&fresh.join(name), &committed.join(name), name, kinds)?.differences()?);
    }
    Ok(Verified { differences: lines, not_run })
}

fn summary(folder: &Path) -> io::Result<Value> {
    Ok(serde_json::from_slice(&fs::read(folder.join(SUMMARY))?)?)
}

/// Names of the folders that hold a `summary.json`.
fn reports(folder: &Path) -> io::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.path().join(SUMMARY).is_file() {
            names.insert(entry.file_name().to_string_lossy().into_owned());
        }
    }
    Ok(names)
}

/// A report made again, beside the committed one.
struct Report<'a> {
    name: &'a str,
    /// Folders: of the new one, of the committed one.
    folders: [&'a Path; 2],
    summaries: [Value; 2],
    schemas: Vec<Schema>,
    /// Whether its page holds measured times.
    is_timed: bool,
}

impl<'a> Report<'a> {
    fn read(new: &'a Path, old: &'a Path, name: &'a str, kinds: &[RegisteredKind]) -> io::Result<Self> {
        let folders = [new, old];
        let summaries = [summary(new)?, summary(old)?];
        let kind = kinds.iter().find(|kind| summaries[1]["kind"] == kind.name);
        let mut schemas = kind.map(|kind| (kind.tables)()).unwrap_or_default();
        schemas.push(Schema::of::<DigestRow>());
        let has_times = |schema: &Schema| {
            let is_there = summaries[1]["committed"].get(schema.file).is_some();
            is_there && schema.columns.iter().any(|heading| heading.unit == "s")
        };
        let is_timed = schemas.iter().any(has_times);
        Ok(Self { name, folders, summaries, schemas, is_timed })
    }

    fn differences(&self) -> io::Result<Vec<String>> {
        let mut lines = Vec::new();
        let names = |summary: &Value, key: &str| -> BTreeSet<String> {
            summary[key].as_object().into_iter().flat_map(|files| files.keys().cloned()).collect()
        };
        let [new, old] = [0, 1].map(|side| names(&self.summaries[side], "committed"));
        for file in new.union(&old) {
            let [new, old] = self.folders.map(|folder| folder.join(file));
            if !(new.is_file() && old.is_file()) {
                lines.push(format!("{}/{file}: is missing", self.name));
            } else if file.ends_with(".csv") {
                self.compare_tables(file, &new, &old, &mut lines)?;
            } else if !self.is_timed && (file.ends_with(".md") || file.ends_with(".svg")) {
                let [new, old] = [fs::read_to_string(new)?, fs::read_to_string(old)?];
                let place = format!("{}/{file}", self.name);
                lines.extend(first_difference(&new, &old).map(|difference| format!("{place}, {difference}")));
            }
        }
        let [new, old] = &self.summaries;
        self.compare_values(new, old, &Place::of(&format!("{}/{SUMMARY}", self.name)), &mut lines);
        Ok(lines)
    }

    fn heading(&self, file: &str, column: &str) -> Option<&Heading> {
        let schema = self.schemas.iter().find(|schema| schema.file == file)?;
        schema.columns.iter().find(|heading| heading.name == column)
    }

    fn compare_tables(&self, file: &str, new: &Path, old: &Path, lines: &mut Vec<String>) -> io::Result<()> {
        let place = format!("{}/{file}", self.name);
        let [new, old] = [Cells::read(new)?, Cells::read(old)?];
        if new.header != old.header || new.rows.len() != old.rows.len() {
            lines.push(format!("{place}: another header or number of rows"));
            return Ok(());
        }
        for (line, (a, b)) in new.rows.iter().zip(&old.rows).enumerate() {
            for (k, column) in old.header.iter().enumerate() {
                let comparison = if file == DigestRow::FILE {
                    self.digest_comparison(&old, b, column)
                } else {
                    let heading = self.heading(file, column);
                    heading.map_or(Comparison::Relative, |heading| match &heading.comparison {
                        Comparison::ScaleOf(other) => Comparison::Scale(old.number(b, other)),
                        comparison => comparison.clone(),
                    })
                };
                let (a, b) = (a.get(k).unwrap_or_default(), b.get(k).unwrap_or_default());
                if !same_cell(a, b, &comparison) {
                    lines.push(format!("{place}, line {}, {column}: now {a}, committed {b}", line + 2));
                }
            }
        }
        Ok(())
    }

    /// How a sum over a column is compared, which is a cell of a digest: as the cells of that column.
    fn digest_comparison(&self, digest: &Cells, row: &csv::StringRecord, cell: &str) -> Comparison {
        if matches!(cell, "table" | "column" | "rows" | "empty") {
            return Comparison::Relative;
        }
        let [table, column] = ["table", "column"].map(|name| digest.cell(row, name));
        let magnitude = |column: &str| {
            let is_of = |row: &&csv::StringRecord| {
                digest.cell(row, "table") == table && digest.cell(row, "column") == column
            };
            digest.rows.iter().find(is_of).map_or(0.0, |row| digest.number(row, "magnitude"))
        };
        match self.heading(table, column).map(|heading| &heading.comparison) {
            Some(Comparison::Ignored) => Comparison::Ignored,
            Some(Comparison::Scale(scale)) => {
                Comparison::Scale(magnitude(column).max(scale * digest.number(row, "rows")))
            }
            Some(Comparison::ScaleOf(other)) => Comparison::Scale(magnitude(column).max(magnitude(other))),
            Some(Comparison::Relative) | None if matches!(cell, "sum" | "weighted") => {
                Comparison::Scale(magnitude(column))
            }
            Some(Comparison::Relative) | None => Comparison::Relative,
        }
    }

    fn compare_values(&self, new: &Value, old: &Value, place: &Place, lines: &mut Vec<String>) {
        match (new, old) {
            (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
                for (key, value) in a.iter().filter(|(key, _)| !NOT_COMPARED.contains(&key.as_str())) {
                    self.compare_values(value, &b[key], &place.key(key, b), lines);
                }
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                for (k, (a, b)) in a.iter().zip(b).enumerate() {
                    self.compare_values(a, b, &place.item(k), lines);
                }
            }
            (Value::Number(a), Value::Number(b)) => {
                let comparison = self.comparison_of(place);
                let is_same = match (a.as_u64(), b.as_u64(), a.as_f64(), b.as_f64()) {
                    _ if comparison == Comparison::Ignored => true,
                    (Some(a), Some(b), ..) if place.counts_contacts() => (a == 0) == (b == 0),
                    (Some(a), Some(b), ..) => a == b,
                    (_, _, Some(a), Some(b)) => same_number(a, b, &comparison),
                    _ => false,
                };
                if !is_same {
                    lines.push(format!("{}: now {a}, committed {b}", place.path));
                }
            }
            _ if new == old => {}
            (Value::String(a), Value::String(b)) if self.is_timed || first_difference(a, b).is_none() => {}
            _ => lines.push(format!("{}: now {new}, committed {old}", place.path)),
        }
    }

    /// How a number of `summary.json` is compared: as the cell of its table, if it is one; not where a column of its name is not.
    fn comparison_of(&self, place: &Place) -> Comparison {
        let [key, column] = [place.keys.first(), place.keys.last()].map(|key| key.map_or("", String::as_str));
        let heading = |schema: &&Schema| schema.columns.iter().any(|heading| heading.name == column);
        let of_records = self.schemas.iter().filter(|schema| schema.records == Some(key)).find(heading);
        let schema = of_records.or_else(|| self.schemas.iter().find(heading));
        let heading = schema.and_then(|schema| schema.columns.iter().find(|heading| heading.name == column));
        match heading.map(|heading| &heading.comparison) {
            Some(Comparison::Ignored) => Comparison::Ignored,
            Some(Comparison::ScaleOf(other)) if of_records.is_some() => {
                Comparison::Scale(place.siblings.get(other.as_str()).copied().unwrap_or(0.0))
            }
            Some(Comparison::Scale(scale)) => Comparison::Scale(*scale),
            _ => Comparison::Relative,
        }
    }
}

/// The cells of a CSV file.
struct Cells {
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Cells {
    fn read(path: &Path) -> io::Result<Self> {
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path)?;
        Ok(Self { header: reader.headers()?.clone(), rows: reader.records().collect::<Result<_, _>>()? })
    }

    fn cell<'r>(&self, row: &'r csv::StringRecord, column: &str) -> &'r str {
        let place = self.header.iter().position(|name| name == column);
        place.and_then(|place| row.get(place)).unwrap_or_default()
    }

    fn number(&self, row: &csv::StringRecord, column: &str) -> f64 {
        self.cell(row, column).parse().unwrap_or(0.0)
    }
}

/// Where a value stands in a summary.
struct Place {
    path: String,
    keys: Vec<String>,
    /// The numbers beside it.
    siblings: BTreeMap<String, f64>,
}

impl Place {
    fn of(file: &str) -> Self {
        Self { path: file.to_owned(), keys: Vec::new(), siblings: BTreeMap::new() }
    }

    fn key(&self, key: &str, object: &serde_json::Map<String, Value>) -> Self {
        let numbers = object.iter().filter_map(|(key, value)| Some((key.clone(), value.as_f64()?)));
        let keys = self.keys.iter().cloned().chain([key.to_owned()]).collect();
        Self { path: format!("{}, {key}", self.path), keys, siblings: numbers.collect() }
    }

    fn item(&self, index: usize) -> Self {
        Self { path: format!("{}[{index}]", self.path), keys: self.keys.clone(), siblings: BTreeMap::new() }
    }

    fn counts_contacts(&self) -> bool {
        const ITEMS: [&str; 4] = ["asperities_touched", "nodes", "single_contacts", "coating_calls"];
        matches!(&self.keys[..], [work, item] if work == "work" && ITEMS.contains(&item.as_str()))
    }
}

fn same_cell(a: &str, b: &str, comparison: &Comparison) -> bool {
    if a == b {
        return true;
    }
    if *comparison == Comparison::Ignored {
        return a.is_empty() == b.is_empty();
    }
    let is_count = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    match (a.parse(), b.parse()) {
        (Ok(a_number), Ok(b_number)) if !(is_count(a) && is_count(b)) => {
            same_number(a_number, b_number, comparison)
        }
        _ => false,
    }
}

fn same_number(a: f64, b: f64, comparison: &Comparison) -> bool {
    let scale = match comparison {
        Comparison::Scale(scale) => scale.abs(),
        _ => 0.0,
    };
    a == b || (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()).max(scale)
}

/// The first line that differs in more than the last shown digit of its numbers; `None` where there is none.
pub fn first_difference(new: &str, old: &str) -> Option<String> {
    let (mut a, mut b) = (new.lines(), old.lines());
    for line in 1.. {
        match (a.next(), b.next()) {
            (None, None) => return None,
            (Some(new), Some(old)) if new == old || is_same(new, old) => {}
            (new, old) => {
                let [new, old] = [new, old].map(|line| excerpt(line.unwrap_or("nothing")));
                return Some(format!("line {line}: now {new}, committed {old}"));
            }
        }
    }
    None
}

fn excerpt(line: &str) -> String {
    const MOST: usize = 120;
    let text: String = line.chars().take(MOST).collect();
    if text.len() < line.len() { format!("{text}...") } else { text }
}

fn is_same(new: &str, old: &str) -> bool {
    let (mut a, mut b) = (Tokens(new), Tokens(old));
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(new), Some(old)) if new == old => {}
            (Some(new), Some(old)) if is_same_number(new, old) => {}
            _ => return false,
        }
    }
}

/// Whether two numbers differ by at most one in the last digit of that with more digits.
fn is_same_number(a: &str, b: &str) -> bool {
    let (Ok(x), Ok(y)) = (a.parse::<f64>(), b.parse::<f64>()) else { return false };
    // Counts are exact.
    let is_count = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let step = last_digit(a).min(last_digit(b));
    !(is_count(a) && is_count(b)) && (x - y).abs() <= 1.01 * step
}

fn last_digit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32)
}

/// Numbers, and the texts between them.
struct Tokens<'a>(&'a str);

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        if self.0.is_empty() {
            return None;
        }
        let length = match number_length(self.0) {
            0 => self
                .0
                .char_indices()
                .map(|(place, _)| place)
                .skip(1)
                .find(|&place| number_length(&self.0[place..]) > 0),
            length => Some(length),
        };
        let (token, rest) = self.0.split_at(length.unwrap_or(self.0.len()));
        self.0 = rest;
        Some(token)
    }
}

/// Length of the number that a text begins with; 0 of a text that begins otherwise.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let sign = usize::from(text.starts_with(['-', '+']));
    let whole = digits(sign);
    let mut length = sign + whole;
    if text[length..].starts_with('.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    } else if whole == 0 {
        return 0;
    }
    if text[length..].starts_with(['e', 'E']) {
        let sign = usize::from(text[length + 1..].starts_with(['-', '+']));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

#[cfg(test)]
mod tests;
