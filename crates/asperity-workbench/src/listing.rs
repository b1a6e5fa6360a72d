//! What a folder holds, as the page lists it: maps, lists of asperities, specs and reports.

use std::fs;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use asperity_contact_framework::report::answer::Answer;
use serde::{Deserialize, Serialize};

use crate::engine::Engine;
use crate::folder::Folder;
use crate::limits;

#[derive(Debug, PartialEq, Serialize)]
pub struct Entry {
    /// From the folder, with slashes.
    path: String,
    what: What,
    /// When it was last written, s since 1970.
    modified: u64,
    bytes: u64,
}

#[derive(Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "type")]
enum What {
    /// A measured file, or a list of asperities.
    Surface,
    Spec {
        kind: String,
        title: String,
    },
    Report {
        title: String,
        answer: String,
        picture: bool,
        page: &'static str,
    },
}

impl Folder {
    /// All maps, lists, specs and reports, the newest first.
    pub fn entries(&self, engine: &dyn Engine) -> Vec<Entry> {
        let mut entries = Vec::new();
        self.walk(self.root(), 0, engine, &mut entries);
        entries.sort_by(|a, b| b.modified.cmp(&a.modified).then(a.path.cmp(&b.path)));
        entries
    }

    fn walk(&self, folder: &Path, depth: usize, engine: &dyn Engine, entries: &mut Vec<Entry>) {
        const FOREIGN: [&str; 2] = ["target", "node_modules"];
        let mut inside: Vec<fs::DirEntry> = fs::read_dir(folder).into_iter().flatten().flatten().collect();
        inside.sort_by_key(fs::DirEntry::file_name);
        for entry in inside {
            if entries.len() >= limits::FILES {
                return;
            }
            // Of a link the link itself, so that it is neither followed nor listed.
            let (Ok(metadata), Ok(name)) = (entry.metadata(), entry.file_name().into_string()) else {
                continue;
            };
            if name.starts_with('.') {
                continue;
            }
            let path = entry.path();
            if metadata.is_dir() {
                match report(&path) {
                    Some(what) => entries.extend(self.entry(&path, &metadata, what)),
                    None if depth < limits::DEPTH && !FOREIGN.contains(&name.as_str()) => {
                        self.walk(&path, depth + 1, engine, entries);
                    }
                    None => {}
                }
            } else if metadata.is_file() {
                let is_spec = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
                let what = if is_spec && metadata.len() <= limits::REQUEST as u64 {
                    let found = fs::read_to_string(&path).ok().and_then(|text| engine.kind(&text));
                    found.map(|(kind, title)| What::Spec { kind, title })
                } else {
                    engine.is_surface(&path).then_some(What::Surface)
                };
                entries.extend(what.and_then(|what| self.entry(&path, &metadata, what)));
            }
        }
    }

    fn entry(&self, path: &Path, metadata: &fs::Metadata, what: What) -> Option<Entry> {
        let modified = metadata.modified().unwrap_or(UNIX_EPOCH);
        Some(Entry { path: self.name_of(path)?, what, modified: seconds(modified), bytes: metadata.len() })
    }
}

/// Whether a folder holds a report.
pub fn is_report(folder: &Path) -> bool {
    report(folder).is_some()
}

/// A report, if that is what a folder holds.
fn report(folder: &Path) -> Option<What> {
    #[derive(Deserialize)]
    struct Summary {
        program: String,
        title: String,
        #[serde(default)]
        answer: serde_json::Value,
    }
    let path = folder.join("summary.json");
    // What lies elsewhere, has no end or is none of the program's is no summary.
    let is_summary =
        fs::symlink_metadata(&path).is_ok_and(|file| file.is_file() && file.len() <= limits::SUMMARY);
    let text = is_summary.then(|| fs::read(&path).ok()).flatten()?;
    let Summary { program, title, answer } = serde_json::from_slice(&text).ok()?;
    let answer = match answer {
        serde_json::Value::String(sentence) => sentence,
        other => serde_json::from_value::<Answer>(other).unwrap_or_default().sentence,
    };
    let picture = folder.join("card.svg").is_file();
    let page = if folder.join("report.html").is_file() { "report.html" } else { "report.md" };
    (program == asperity_contact_framework::report::PROGRAM).then_some(What::Report {
        title,
        answer,
        picture,
        page,
    })
}

fn seconds(time: SystemTime) -> u64 {
    time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}
