//! Index of all reports of a folder.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::page::{Cell, Page};

/// The program name in `summary.json`.
pub const PROGRAM: &str = "asperity";

/// Begins the last line of an index page; a page with this text may be replaced by the next run.
pub const MARK: &str = "Written by asperity;";

/// `README.md` and `index.html`.
#[derive(Debug)]
pub struct Index {
    reports: usize,
    /// Markdown.
    pub markdown: String,
    /// Self-contained HTML.
    pub html: String,
}

/// A report in the index.
#[derive(Deserialize)]
struct Entry {
    program: String,
    title: String,
    #[serde(default)]
    warnings: Vec<String>,
    #[serde(default)]
    files: Vec<String>,
}

impl Index {
    /// Whether there are no reports.
    pub fn is_empty(&self) -> bool {
        self.reports == 0
    }

    /// The index of all reports in `directory`.
    pub fn of(directory: &Path) -> Self {
        let mut entries: Vec<(String, Entry)> = fs::read_dir(directory)
            .into_iter()
            .flatten()
            .filter_map(|entry| {
                let entry = entry.ok()?;
                let summary = fs::read(entry.path().join("summary.json")).ok()?;
                let found: Entry = serde_json::from_slice(&summary).ok()?;
                let name = entry.file_name().into_string().ok()?;
                (found.program == PROGRAM && !name.starts_with('.')).then_some((name, found))
            })
            .collect();
        entries.sort_by(|a, b| a.0.cmp(&b.0));
        let page = |file: &str| {
            let mut page = Page::new("Reports");
            page.table(
                ["report", "title", "warnings", "data"],
                entries.iter().map(|(name, entry)| {
                    let link = |text: &str, file: &str| Cell::Link {
                        text: text.to_owned(),
                        to: format!("{name}/{file}"),
                    };
                    vec![
                        link(name, file),
                        Cell::from(entry.title.as_str()),
                        Cell::from(match entry.warnings.len() {
                            0 => "none".to_owned(),
                            count => format!("{count} (read first)"),
                        }),
                        match entry.files.iter().any(|file| file == "comparison.csv") {
                            true => link("comparison.csv", "comparison.csv"),
                            false => link("summary.json", "summary.json"),
                        },
                    ]
                }),
            );
            page.paragraph(&format!("{MARK} overwritten by the next run."));
            page
        };
        Self {
            reports: entries.len(),
            markdown: page("report.md").markdown(),
            html: page("report.html").html(),
        }
    }
}
