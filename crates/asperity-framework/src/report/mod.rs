//! What a run tells: pages, tables, summaries, and the folder that holds them.
//!
//! Everything but [`store`] is pure: results in, bytes out.
//!
//! | module | what lives there |
//! |---|---|
//! | `page` | one content in two forms, Markdown and self-contained HTML |
//! | [`mod@format`] | numbers and quantities as people read them |
//! | [`sections`] | what every page says: the bodies, the sources, the files |
//! | [`table`], [`mod@summary`] | CSV and JSON, for machines |
//! | `index` | the pages that lead to all reports of a folder |
//! | [`store`] | the only place that touches the disk: a folder is replaced whole or not at all |
//! | [`verify`] | do fresh reports say the same as committed ones? |

pub mod format;
mod index;
pub mod page;
pub mod sections;
pub mod store;
pub mod summary;
pub mod table;
pub mod verify;

pub use index::{Index, MARK};
pub use page::Page;

use std::time::Instant;

use store::Folder;

use crate::kind::Outcome;

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

/// The whole report on `outcome`, to be written under `key`, which stands for all that it depends on.
///
/// # Errors
/// See [`ReportError`].
pub fn folder(outcome: &dyn Outcome, key: &str) -> Result<Folder, ReportError> {
    let start = Instant::now();
    let page = outcome.page();
    let mut folder = Folder::new(&outcome.metadata().stem, key);
    folder.file("report.md", page.markdown()).file("report.html", page.html());
    for (name, svg) in page.figures() {
        folder.file(name, svg);
    }
    for (name, table) in outcome.tables()? {
        folder.file(name, table);
    }
    let mut names: Vec<String> = folder.names().map(str::to_owned).collect();
    names.extend(["summary.json".to_owned(), "timing.json".to_owned()]);
    names.sort();
    folder.file("summary.json", summary::summary(outcome, &names)?);
    folder.file("timing.json", summary::timing(outcome.metadata(), start.elapsed())?);
    Ok(folder)
}
