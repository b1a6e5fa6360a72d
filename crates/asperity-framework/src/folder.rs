//! The report of a run: page, tables, figures and summaries in one folder.

use std::time::Instant;

use asperity_print::PrintError;
use rayon::prelude::*;

use crate::kind::Outcome;
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

/// Each figure as PDF and as PNG.
fn printed(figures: &[(String, String)]) -> Result<Vec<(String, Vec<u8>)>, PrintError> {
    /// Pixels per inch, as journals ask for.
    const DPI: f32 = 300.0;
    let both = |(name, svg): &(String, String)| {
        let stem = name.strip_suffix(".svg").unwrap_or(name);
        Ok([
            (format!("{stem}.pdf"), asperity_print::pdf(svg)?),
            (format!("{stem}.png"), asperity_print::png(svg, DPI)?),
        ])
    };
    let files: Result<Vec<_>, PrintError> = figures.par_iter().map(both).collect();
    Ok(files?.into_iter().flatten().collect())
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
