//! The report of a run: page, tables, figures and `summary.json` in one folder.

use std::time::{Duration, Instant};

use asperity::work::Work;
use indexmap::IndexMap;
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::digest::{hexadecimal, sha256};
use crate::kind::Outcome;
use crate::metadata::{Group, Metadata};
use crate::report::answer::Answer;
use crate::report::digest::digest;
use crate::report::store::Folder;
use crate::report::table::Tables;
use crate::report::{CARD, PROGRAM, Page};

/// Endings of the files of a report that version control keeps, besides short tables and `summary.json`.
const COMMITTED: [&str; 2] = [".md", ".svg"];

/// A report that cannot be written down.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("a table cannot be written: {0}")]
    Table(#[from] csv::Error),
    #[error("a summary cannot be written: {0}")]
    Summary(#[from] serde_json::Error),
}

/// The complete report on `outcome`; `key` identifies everything that it depends on.
pub fn folder(outcome: &dyn Outcome, key: &str) -> Result<Folder, ReportError> {
    let start = Instant::now();
    let mut tables = outcome.tables();
    tables.extend(digest(&tables));
    let tables = Tables::new(tables);
    let page = outcome.page(&tables);
    let files = page.files(outcome.metadata().figure);
    let mut folder = Folder::new(&outcome.metadata().stem, key);
    folder.file("report.md", files.markdown).file("report.html", files.html);
    for (name, svg) in files.figures {
        folder.file(name, svg);
    }
    if let Some(svg) = files.card {
        folder.file(CARD, svg);
    }
    for table in tables.iter() {
        folder.file(table.schema.file, table.csv()?);
    }
    let is_committed = |name: &str| {
        COMMITTED.iter().any(|ending| name.ends_with(ending))
            || tables.iter().any(|table| table.schema.file == name && !table.schema.is_long)
    };
    let mut committed: IndexMap<&str, String> = folder
        .files()
        .filter(|(name, _)| is_committed(name))
        .map(|(name, content)| (name, hexadecimal(&sha256(content))))
        .collect();
    committed.sort_unstable_keys();
    let mut names: Vec<&str> = folder.files().map(|(name, _)| name).collect();
    names.extend(["summary.json", "timing.json"]);
    names.sort_unstable();
    let summary = summary(outcome, &tables, &page, committed, names)?;
    let timing = timing(outcome.metadata(), start.elapsed())?;
    folder.file("summary.json", summary).file("timing.json", timing);
    Ok(folder)
}

#[derive(Serialize)]
struct Summary<'a> {
    program: &'static str,
    version: &'static str,
    title: &'a str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    group: Option<Group>,
    answer: Answer,
    #[serde(skip_serializing_if = "Option::is_none")]
    figure: Option<&'a str>,
    spec_sha256: &'a str,
    input_sha256: &'a str,
    seed: u64,
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    materials_from_library: IndexMap<&'a str, MaterialSummary>,
    #[serde(flatten)]
    of_kind: Map<String, Value>,
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<&'static str>,
    /// Of a long run, which is not made again with each change of the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    library_sha256: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    work: Option<Work>,
    papers: Vec<&'static str>,
    /// SHA-256 of the files that version control keeps.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    committed: IndexMap<&'a str, String>,
    files: Vec<&'a str>,
}

/// The value of `run` of an experiment that runs only where it is named or long runs are asked for.
pub(crate) const LONG: &str = "long";

/// A material whose values are from the library: its name there, and the source of each value.
#[derive(Serialize)]
struct MaterialSummary {
    name: &'static str,
    sources: IndexMap<&'static str, String>,
}

/// `summary.json` of an outcome whose report is not written, without names of files.
pub fn summary_json(outcome: &dyn Outcome, tables: &Tables) -> serde_json::Result<Vec<u8>> {
    summary(outcome, tables, &outcome.page(tables), IndexMap::new(), Vec::new())
}

/// `summary.json` of an outcome with its tables and page; `committed` are the SHA-256 of the files that version control keeps, `files`
/// the names of all files of the report.
pub(super) fn summary(
    outcome: &dyn Outcome,
    tables: &Tables,
    page: &Page,
    committed: IndexMap<&str, String>,
    files: Vec<&str>,
) -> serde_json::Result<Vec<u8>> {
    let metadata = outcome.metadata();
    let mut of_kind = outcome.facts()?;
    for table in tables.iter() {
        if let Some(key) = table.schema.records {
            of_kind.insert(key.to_owned(), table.records());
        }
    }
    let summary = serde_json::to_value(&Summary {
        program: PROGRAM,
        version: env!("CARGO_PKG_VERSION"),
        title: &metadata.title,
        kind: metadata.kind,
        group: metadata.group,
        answer: page.answer(),
        figure: page.main_figure(),
        spec_sha256: &metadata.spec_sha256,
        input_sha256: &metadata.input_sha256,
        seed: metadata.seed,
        materials_from_library: metadata
            .origins
            .iter()
            .map(|(name, origin)| {
                let sources = origin.sources().into_iter().collect();
                (name.as_str(), MaterialSummary { name: origin.from.name, sources })
            })
            .collect(),
        of_kind,
        warnings: outcome.warnings(),
        run: metadata.is_long.then_some(LONG),
        library_sha256: metadata.is_long.then_some(metadata.library_sha256),
        work: metadata.work,
        papers: metadata.papers.iter().map(|paper| paper.full).collect(),
        committed,
        files,
    })?;
    Ok((written(&summary) + "\n").into_bytes())
}

/// JSON with a line for each field of an object and for each entry of a list, such as a record, unless all of it is short.
fn written(value: &Value) -> String {
    const SHORT: usize = 100;
    let on_one_line = value.to_string();
    if on_one_line.len() <= SHORT {
        return on_one_line;
    }
    match value {
        Value::Object(fields) => {
            let fields = fields.iter().map(|(key, value)| format!("{}:{}", json!(key), written(value)));
            format!("{{\n{}\n}}", fields.collect::<Vec<_>>().join(",\n"))
        }
        Value::Array(entries) => {
            format!("[\n{}\n]", entries.iter().map(Value::to_string).collect::<Vec<_>>().join(",\n"))
        }
        _ => on_one_line,
    }
}

#[derive(Serialize)]
struct Times {
    read_s: f64,
    generate_s: f64,
    summits_s: f64,
    statistical_s: f64,
    deterministic_s: f64,
    sampling_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    reference_s: Option<f64>,
    report_s: f64,
    total_s: f64,
}

/// `timing.json`, given the time that page, tables and figures took.
pub(super) fn timing(metadata: &Metadata, report: Duration) -> serde_json::Result<Vec<u8>> {
    let timing = &metadata.timing;
    serde_json::to_vec_pretty(&Times {
        read_s: timing.read.as_secs_f64(),
        generate_s: timing.generate.as_secs_f64(),
        summits_s: timing.summits.as_secs_f64(),
        statistical_s: timing.statistical.as_secs_f64(),
        deterministic_s: timing.deterministic.as_secs_f64(),
        sampling_s: timing.sampling.as_secs_f64(),
        reference_s: Some(timing.reference.as_secs_f64()).filter(|&seconds| seconds > 0.0),
        report_s: report.as_secs_f64(),
        total_s: (timing.total + report).as_secs_f64(),
    })
}
