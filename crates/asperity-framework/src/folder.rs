//! The report of a run: page, tables, figures and summaries in one folder.

use std::time::Instant;

use crate::kind::Outcome;
use crate::print::{PrintError, printed};
use crate::report::store::Folder;
use crate::summary;

/// A report that cannot be written down.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A table.
    #[error("a table cannot be written: {0}")]
    Table(#[from] csv::Error),
    /// A figure in print.
    #[error("a figure {0}")]
    Print(#[from] PrintError),
    /// A summary.
    #[error("a summary cannot be written: {0}")]
    Summary(#[from] serde_json::Error),
}

/// The complete report on `outcome`; `key` identifies everything that it depends on.
///
/// # Errors
/// See [`ReportError`].
pub fn folder(outcome: &dyn Outcome, key: &str) -> Result<Folder, ReportError> {
    let start = Instant::now();
    let page = outcome.page();
    let size = outcome.metadata().figure;
    let files = page.files(size);
    let mut folder = Folder::new(&outcome.metadata().stem, key);
    folder.file("report.md", files.markdown).file("report.html", files.html);
    if size.is_some() {
        for (name, content) in printed(&files.figures)? {
            folder.file(name, content);
        }
    }
    for (name, svg) in files.figures {
        folder.file(name, svg);
    }
    for (name, table) in outcome.tables()? {
        folder.file(name, table);
    }
    let mut names: Vec<String> = folder.names().map(str::to_owned).collect();
    names.extend(["summary.json".to_owned(), "timing.json".to_owned()]);
    names.sort();
    folder.file("summary.json", summary::summary(outcome, &page, &names)?);
    folder.file("timing.json", summary::timing(outcome.metadata(), start.elapsed())?);
    Ok(folder)
}
