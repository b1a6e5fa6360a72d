//! The report of a run: page, tables, figures and summaries in one folder.

use std::time::Instant;

use indexmap::IndexMap;

use crate::digest::{hexadecimal, sha256};
use crate::kind::Outcome;
use crate::report::CARD;
use crate::report::digest::digest;
use crate::report::store::Folder;
use crate::report::table::Tables;
use crate::summary;

/// Endings of the files of a report that version control keeps, besides short tables and `summary.json`.
const COMMITTED: [&str; 2] = [".md", ".svg"];

/// A report that cannot be written down.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A table.
    #[error("a table cannot be written: {0}")]
    Table(#[from] csv::Error),
    /// A summary.
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
    let summary = summary::summary(outcome, &tables, &page, committed, names)?;
    let timing = summary::timing(outcome.metadata(), start.elapsed())?;
    folder.file("summary.json", summary).file("timing.json", timing);
    Ok(folder)
}
