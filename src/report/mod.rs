//! What a run tells: pictures, pages, tables, and the folder that holds them.
//!
//! Everything but [`store`] is pure: results in, bytes out.
//!
//! | module | what lives there |
//! |---|---|
//! | [`plot`] | a figure described by its layers, drawn to SVG text |
//! | [`page`] | one content in two forms, Markdown and self-contained HTML |
//! | [`mod@format`] | numbers and quantities as people read them |
//! | `compare`, `indentation`, `laws`, `limit`, `precision`, `stability` | the page of each kind of experiment, on `sections` and `figures` |
//! | `layer`, `falls` | a comparison under a layer in several thicknesses; where area or load falls |
//! | [`surface`] | what a surface is, in a comparison, on a page of its own, in the terminal |
//! | `tables`, `summary` | CSV and JSON, for machines |
//! | `index` | the pages that lead to all reports of a folder |
//! | [`store`] | the only place that touches the disk: a folder is replaced whole or not at all |
//! | [`verify`] | do fresh reports say the same as committed ones? |

mod compare;
mod falls;
mod figures;
pub mod format;
mod indentation;
mod index;
mod laws;
mod layer;
mod limit;
pub mod page;
mod precision;
mod sections;
mod stability;
pub mod store;
mod summary;
pub mod surface;
mod tables;
pub mod verify;

pub use index::{Index, MARK};
pub use summary::looked_at;

use std::time::Instant;

use store::Folder;

use crate::experiment::results::Results;

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

/// The whole report on `results`, to be written under `key`, which stands for all that it depends on.
///
/// # Errors
/// See [`ReportError`].
pub fn folder(results: &Results, key: &str) -> Result<Folder, ReportError> {
    let start = Instant::now();
    let (page, tables) = match results {
        Results::Compare(results) => {
            let tables = vec![
                ("curves.csv", tables::curves(results)?),
                ("comparison.csv", tables::comparison(results)?),
            ];
            (compare::page(results), tables)
        }
        Results::Indentation(results) => (indentation::page(results), indentation::tables(results)?),
        Results::Laws(results) => (laws::page(results), laws::tables(results)?),
        Results::Precision(results) => (precision::page(results), precision::tables(results)?),
        Results::Stability(results) => (stability::page(results), stability::tables(results)?),
        Results::Surfaces(results) => (surface::page(results), Vec::new()),
        Results::Limit(results) => {
            let tables = vec![
                ("curves.csv", tables::limit_curves(results)?),
                ("comparison.csv", tables::limit_comparison(results)?),
                ("convergence.csv", tables::convergence(results)?),
            ];
            (limit::page(results), tables)
        }
    };
    let mut folder = Folder::new(&results.metadata().stem, key);
    folder.file("report.md", page.markdown()).file("report.html", page.html());
    for (name, svg) in page.figures() {
        folder.file(name, svg);
    }
    for (name, table) in tables {
        folder.file(name, table);
    }
    let mut names: Vec<String> = folder.names().map(str::to_owned).collect();
    names.extend(["summary.json".to_owned(), "timing.json".to_owned()]);
    names.sort();
    let summary = match results {
        Results::Compare(results) => summary::compare(results, &names)?,
        Results::Indentation(results) => summary::indentation(results, &names)?,
        Results::Laws(results) => summary::laws(results, &names)?,
        Results::Limit(results) => summary::limit(results, &limit::slopes(results), &names)?,
        Results::Precision(results) => summary::precision(results, &names)?,
        Results::Stability(results) => summary::stability(results, &names)?,
        Results::Surfaces(results) => summary::surfaces(results, &names)?,
    };
    folder.file("summary.json", summary);
    folder.file("timing.json", summary::timing(results.metadata(), start.elapsed())?);
    Ok(folder)
}
