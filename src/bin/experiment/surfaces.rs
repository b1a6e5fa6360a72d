//! `experiment surface`: measured files, each with a report of its own, and the answers on several in one table.

use std::path::{Path, PathBuf};

use asperity_contact_framework::remedy::FrontEnd;
use asperity_contact_framework::report::answer::{Answer, CardLine};
use asperity_contact_framework::report::store::Store;
use asperity_experiment::surface::{FileOptions, described_file};
use asperity_experiment::{Experiment, saved_spec, surface_report};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::arguments::RunOptions;
use super::output::{print, say};
use super::several::Place;
use super::{Failure, open_store, run_and_write, say_answer, update_index, watched};
use crate::output::{check_save_spec, write_new};

/// The table of the answers on several files, in the folder of the reports.
const ANSWERS: &str = "answers.csv";

/// How its first line begins.
const COLUMNS: &str = "file,report,error,";

/// What a report says, for machines.
#[derive(Deserialize)]
pub struct Answered {
    pub answer: Answer,
    /// The row of `answers.csv` of each case.
    #[serde(default)]
    answers: Vec<Map<String, Value>>,
}

impl Answered {
    /// What the report in `folder` says; `None` where there is none.
    pub fn of(folder: &Path) -> Option<Self> {
        serde_json::from_slice(&std::fs::read(folder.join("summary.json")).ok()?).ok()
    }
}

/// Describes the surface of each file.
pub fn describe(
    files: &[PathBuf],
    file_options: FileOptions,
    name: Option<&str>,
    save_spec: Option<&Path>,
    options: &RunOptions,
) -> Result<(), Failure> {
    if let [file] = files {
        return one(file, &file_options, name, save_spec, Place::ALONE, options).map(drop);
    }
    let single = [("--name", name.is_some()), ("--save-spec", save_spec.is_some())];
    if let Some((flag, _)) = single.into_iter().find(|(_, is_given)| *is_given) {
        let message = format!("{flag}: found with {} files; allowed: with one", files.len());
        return Err(Failure::Input(message));
    }
    let mut rows = Vec::new();
    let mut last = Ok(());
    for (index, file) in files.iter().enumerate() {
        let place = Place { number: index + 1, of: files.len() };
        let described = one(file, &file_options, None, None, place, options);
        rows.push(Row::new(file, &described, options));
        if let Err(failure) = described
            && let Err(before) = std::mem::replace(&mut last, Err(failure))
        {
            before.report();
        }
    }
    let mut store = Store::new(&options.out);
    store.write_page(ANSWERS, &table(&rows)?, COLUMNS)?;
    if !options.silent {
        let in_short = |row: &Row| FrontEnd::Terminal.text(&row.in_short());
        rows.iter().for_each(|row| print(format_args!("{}: {}", row.file, in_short(row))));
    }
    say(options, &format!("{} written", options.out.join(ANSWERS).display()));
    last
}

/// Describes one file, or all surfaces of a spec; the name of its report.
fn one(
    file: &Path,
    file_options: &FileOptions,
    name: Option<&str>,
    save_spec: Option<&Path>,
    place: Place,
    options: &RunOptions,
) -> Result<String, Failure> {
    let shown = file.file_stem().unwrap_or_default().to_string_lossy();
    let free = name.is_none().then(|| free_name(file, options)).flatten();
    let experiment = watched(&shown, options.is_quiet(), |progress| {
        Experiment::describe(file, file_options, name.or(free.as_deref()), progress)
    })?;
    if let Some(spec) = save_spec {
        check_save_spec(file, spec)?;
    }
    let mut store = open_store(options)?;
    store.check(experiment.stem())?;
    check_same_file(&experiment, &options.out.join(experiment.stem()))?;
    let results = run_and_write(&experiment, place, None, &mut store, options)?;
    if place.is_alone() {
        say_answer(&experiment, &*results, options);
    }
    if let Some(spec) = save_spec {
        write_new(spec, &saved_spec(file_options, file, spec, &*results))?;
        say(
            options,
            &format!("\n{} written; run it with `experiment run {}`", spec.display(), spec.display()),
        );
    }
    update_index(&mut store, options)?;
    Ok(experiment.stem().to_owned())
}

/// Another name for the report on a measured file whose own name is that of a report on another file: with its ending, then a number.
fn free_name(file: &Path, options: &RunOptions) -> Option<String> {
    /// More files of one name are hardly meant.
    const MOST: usize = 1000;
    let ending = file.extension().filter(|ending| *ending != "toml")?;
    let own = surface_report(file);
    let with_ending = format!("{own}-{}", ending.to_string_lossy().to_lowercase());
    let numbered = (2..MOST).map(|number| format!("{with_ending}-{number}"));
    let mut names = [own, with_ending.clone()].into_iter().chain(numbered);
    let place = |name: &String| options.out.join(name);
    names.find(|name| described_file(&place(name)).is_none_or(|other| is_same(&other, file)))
}

fn is_same(a: &Path, b: &Path) -> bool {
    let whole = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    whole(a) == whole(b)
}

/// The report on a file must not replace that on another file of the same name.
fn check_same_file(experiment: &Experiment, folder: &Path) -> Result<(), Failure> {
    let (Some(now), Some(before)) = (experiment.described_file(), described_file(folder)) else {
        return Ok(());
    };
    if is_same(&now, &before) {
        return Ok(());
    }
    Err(Failure::Input(format!(
        "{} holds the report on another file, {}; allowed: --name NAME for a separate report",
        folder.display(),
        before.display()
    )))
}

/// A file in the table of answers.
struct Row {
    file: String,
    report: String,
    error: String,
    answered: Option<Answered>,
}

impl Row {
    fn new(file: &Path, described: &Result<String, Failure>, options: &RunOptions) -> Self {
        let (report, error) = match described {
            Ok(report) => (report.clone(), String::new()),
            Err(failure) => (String::new(), failure.message().to_owned()),
        };
        let answered = described.as_ref().ok().and_then(|report| Answered::of(&options.out.join(report)));
        Self { file: file.display().to_string(), report, error, answered }
    }

    fn line(&self, key: &str) -> Option<String> {
        let lines = &self.answered.as_ref()?.answer.lines;
        lines.iter().find(|line| line.key == key).map(CardLine::text)
    }

    /// A value of its first case.
    fn of_case(&self, column: &str) -> Option<String> {
        match self.answered.as_ref()?.answers.first()?.get(column)? {
            Value::Null => None,
            Value::String(text) => Some(text.clone()),
            other => Some(other.to_string()),
        }
    }

    /// The answer, or why there is none.
    fn in_short(&self) -> String {
        let sentence = || self.answered.as_ref().map(|answered| answered.answer.sentence.clone());
        let error = self.error.strip_prefix(&self.file).unwrap_or(&self.error).trim_start_matches([':', ' ']);
        self.line("answer").or_else(sentence).unwrap_or_else(|| error.to_owned())
    }
}

/// The answers as CSV: a row for each file.
fn table(rows: &[Row]) -> Result<Vec<u8>, Failure> {
    const OF_CASE: [&str; 6] = [
        "area",
        "area_difference",
        "separation",
        "separation_difference",
        "stiffness",
        "stiffness_difference",
    ];
    const LINES: [&str; 7] = ["result", "answer", "difference", "why", "instead", "nearer", "certainty"];
    let failed = |error: csv::Error| Failure::Run(format!("{ANSWERS}: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let columns = COLUMNS.trim_end_matches(',').split(',').chain(OF_CASE).chain(LINES);
    writer.write_record(columns).map_err(failed)?;
    for row in rows {
        let own = [row.file.clone(), row.report.clone(), row.error.clone()].into_iter();
        let of_case = OF_CASE.iter().map(|column| row.of_case(column).unwrap_or_default());
        let lines = LINES.iter().map(|key| row.line(key).unwrap_or_default());
        writer.write_record(own.chain(of_case).chain(lines)).map_err(failed)?;
    }
    writer.into_inner().map_err(|error| Failure::Run(format!("{ANSWERS}: {}", error.error())))
}
