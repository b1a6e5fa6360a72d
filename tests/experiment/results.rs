//! Runs of specs and of the program, and what tests read of them: the rows of their tables and the figures of their pages.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output};

use asperity::npy;
use asperity::topography::generate::gaussian;
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
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

/// A surface of a population as that of the paper's case 1, with further keys.
pub fn population(name: &str, count: usize, keys: &str) -> String {
    format!("[surface.{name}.population]\n{}count = {count}\n{keys}\n", case_1!())
}

/// Heights (m) of a periodic Gaussian surface of `side` x `side` points with a standard deviation of 0.1 µm; its waves are from a cut-off
/// to a roll-off of so many points.
pub fn waves(side: usize, [roll_off, cut_off]: [f64; 2], seed: u8) -> Vec<f64> {
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off };
    let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid([side; 2], [1.0; 2]);
    gaussian(&spectrum, 1e-7, [seed; 32])
}

/// Writes heights (m) by their places along x and y.
pub fn write_map(path: impl AsRef<Path>, [nx, ny]: [usize; 2], height: impl Fn(usize, usize) -> f64) {
    let heights = (0..nx * ny).map(|k| height(k / ny, k % ny));
    npy::write(File::create(path).unwrap(), [nx, ny], heights).unwrap();
}

/// A spec as a file in `folder`.
pub fn read(folder: &Path, spec: &str) -> Result<Experiment, String> {
    let path = folder.join("t.toml");
    fs::write(&path, spec).unwrap();
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

/// What the program does in a folder.
pub fn experiment(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_experiment")).args(arguments).current_dir(folder).output().unwrap()
}

/// The same where it must succeed.
pub fn succeeds(arguments: &[&str], folder: &Path) -> Output {
    let output = experiment(arguments, folder);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

/// The files of a report, except for what depends on the clock.
pub fn report(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    files
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .filter(|(name, _)| name != "timing.json" && name != "manifest.json")
        .collect()
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
