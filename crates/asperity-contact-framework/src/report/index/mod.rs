//! Index of all reports of a folder: a list in Markdown, cards in HTML, and a page that overlays their curves.
//!
//! | module | what it writes |
//! |---|---|
//! | `cards` | `index.html`: a card per report with its answer and main figure |
//! | `overlay` | `comparison.html`: curves of several reports in one figure |

mod cards;
mod overlay;

use std::fs;
use std::path::Path;

use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

use super::answer::Answer;
use super::page::{Cell, Page};

/// The program name in `summary.json`.
pub const PROGRAM: &str = "asperity";

/// Begins the last line of an index page; a page with this text may be replaced by the next run.
pub const MARK: &str = "Written by asperity;";

/// The pages that lead to all reports of a folder.
#[derive(Debug)]
pub struct Index {
    reports: usize,
    /// File names and contents.
    pub pages: [(&'static str, String); 3],
}

/// A report in the index.
#[derive(Deserialize)]
struct Entry {
    /// Name of its folder.
    #[serde(skip)]
    name: String,
    /// Whether its HTML page is there.
    #[serde(skip)]
    has_html: bool,
    program: String,
    title: String,
    #[serde(default)]
    kind: String,
    /// What it found.
    #[serde(default, deserialize_with = "answer")]
    answer: Answer,
    /// File name of its main figure.
    #[serde(default)]
    figure: Option<String>,
    reduced_modulus_pa: Option<f64>,
    hardness_pa: Option<f64>,
    #[serde(default)]
    surfaces: Value,
    #[serde(default)]
    warnings: Vec<String>,
    #[serde(default)]
    files: Vec<String>,
}

/// An answer; of a report by an earlier version a sentence alone.
fn answer<'de, D: Deserializer<'de>>(of: D) -> Result<Answer, D::Error> {
    Ok(match Value::deserialize(of)? {
        Value::String(sentence) => Answer { sentence, lines: Vec::new() },
        other => serde_json::from_value(other).unwrap_or_default(),
    })
}

impl Entry {
    /// The page that is there: a long run that was not made here has only what is committed.
    fn page(&self) -> &'static str {
        if self.has_html { "report.html" } else { "report.md" }
    }

    /// Its surfaces with what is known of each.
    fn surfaces(&self) -> impl Iterator<Item = (&String, &Value)> {
        self.surfaces.as_object().into_iter().flat_map(Map::iter)
    }

    /// The table that most readers want.
    fn data(&self) -> &'static str {
        const TABLE: &str = "comparison.csv";
        if self.files.iter().any(|file| file == TABLE) { TABLE } else { "summary.json" }
    }
}

impl Index {
    /// Names of its pages.
    pub const FILES: [&'static str; 3] = ["README.md", "index.html", "comparison.html"];

    /// Whether there are no reports.
    pub fn is_empty(&self) -> bool {
        self.reports == 0
    }

    /// The index of all reports in `directory`.
    pub fn read(directory: &Path) -> Self {
        let read = |entry: fs::DirEntry| {
            let summary = fs::read(entry.path().join("summary.json")).ok()?;
            let found: Entry = serde_json::from_slice(&summary).ok()?;
            let name = entry.file_name().into_string().ok()?;
            let has_html = entry.path().join("report.html").is_file();
            (found.program == PROGRAM && !name.starts_with('.')).then_some(Entry { name, has_html, ..found })
        };
        let folders = fs::read_dir(directory).into_iter().flatten().flatten();
        let mut entries: Vec<Entry> = folders.filter_map(read).collect();
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        let [list, cards, overlay] = Self::FILES;
        let pages = [
            (list, markdown(&entries)),
            (cards, cards::page(&entries)),
            (overlay, overlay::page(directory, &entries)),
        ];
        Self { reports: entries.len(), pages }
    }
}

/// The list of reports, for those who read the folder on the web.
fn markdown(entries: &[Entry]) -> String {
    let mut page = Page::new("Reports");
    page.table(
        ["report", "title", "warnings", "data"],
        entries.iter().map(|entry| {
            let link = |text: &str, file: &str| Cell::Link {
                text: text.to_owned(),
                to: format!("{}/{file}", entry.name),
            };
            vec![
                link(&entry.name, "report.md"),
                Cell::from(entry.title.as_str()),
                Cell::from(match entry.warnings.len() {
                    0 => "none".to_owned(),
                    count => count.to_string(),
                }),
                link("summary.json", "summary.json"),
            ]
        }),
    );
    page.paragraph(&format!("{MARK} overwritten by the next run."));
    page.markdown()
}
