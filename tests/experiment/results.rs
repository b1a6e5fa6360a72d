//! Runs of specs, and what tests read of them: the rows of their tables and the figures of their pages.

use std::collections::BTreeMap;
use std::path::Path;

use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

use crate::Report;

/// A comparison of rough steel on flat steel under one law, without loads.
pub const ON_STEEL: &str = concat!(
    "title = \"t\"\nseed = 3\n",
    steel!(),
    "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n"
);

/// A spec as a file in `folder`.
pub fn read(folder: &Path, spec: &str) -> Result<Experiment, String> {
    let path = folder.join("t.toml");
    std::fs::write(&path, spec).unwrap();
    Experiment::read(&path).map_err(|error| error.to_string().replace(&format!("{}/", folder.display()), ""))
}

/// Runs a spec, with files beside it in `folder`.
pub fn run_in(folder: &Path, spec: &str) -> Result<Box<dyn Outcome>, String> {
    read(folder, spec)?.run(&Silent).map_err(|error| error.to_string())
}

/// Runs a spec that needs no other file.
pub fn run(spec: &str) -> Result<Box<dyn Outcome>, String> {
    run_in(tempfile::tempdir().unwrap().path(), spec)
}

/// A row of a table by the names of its columns.
pub type Row = BTreeMap<String, String>;

/// The rows of a table.
pub fn rows(csv: &[u8]) -> Vec<Row> {
    csv::Reader::from_reader(csv).deserialize().map(Result::unwrap).collect()
}

/// The rows of a table; `None` where the report has no such table.
pub fn table(outcome: &dyn Outcome, file: &str) -> Option<Vec<Row>> {
    let tables = outcome.files();
    tables.iter().find(|(name, _)| *name == file).map(|(_, content)| rows(content))
}

/// Rows with their cells as values: numbers, true and false, words, and null where a cell is empty.
pub fn typed(rows: Vec<Row>) -> Vec<serde_json::Value> {
    let value = |cell: String| match cell.as_str() {
        "" => serde_json::Value::Null,
        text => serde_json::from_str(text).unwrap_or_else(|_| cell.clone().into()),
    };
    rows.into_iter().map(|row| row.into_iter().map(|(name, cell)| (name, value(cell))).collect()).collect()
}

pub fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

pub fn column(rows: &[Row], name: &str) -> Vec<f64> {
    rows.iter().map(|row| number(row, name)).collect()
}

/// A figure of the page, as SVG.
pub fn figure(outcome: &dyn Outcome, file: &str) -> Option<String> {
    outcome.outline().files(None).figures.into_iter().find(|(name, _)| *name == file).map(|(_, svg)| svg)
}
