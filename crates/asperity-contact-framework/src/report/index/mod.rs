//! Index of all reports of a folder: a list in Markdown, cards in HTML.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

use super::answer::{Answer, CardLine};
use super::page::{Cell, Page, document, escape_html as escape, with_minus};
use crate::kind::RegisteredKind;
use crate::metadata::Group;

/// The program name in `summary.json`.
pub const PROGRAM: &str = "asperity";

/// Begins the last line of an index page; a page with this text may be replaced by the next run.
pub const MARK: &str = "Written by asperity;";

/// The picture of a report's card, in its folder.
pub const CARD: &str = "card.svg";

/// The pages that lead to all reports of a folder.
#[derive(Debug)]
pub struct Index {
    reports: usize,
    pub pages: [(&'static str, String); 2],
}

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
    group: Option<Group>,
    /// What it found.
    #[serde(default, deserialize_with = "read_answer")]
    answer: Answer,
    #[serde(default)]
    surfaces: Value,
    #[serde(default)]
    warnings: Vec<String>,
    #[serde(default)]
    files: Vec<String>,
}

/// An answer; of a report by an earlier version a sentence alone.
fn read_answer<'de, D: Deserializer<'de>>(of: D) -> Result<Answer, D::Error> {
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
    pub const FILES: [&'static str; 2] = ["README.md", "index.html"];

    pub fn is_empty(&self) -> bool {
        self.reports == 0
    }

    /// The index of all reports in `directory`; a report whose summary names no group has that of its kind.
    pub fn read(directory: &Path, kinds: &[RegisteredKind]) -> Self {
        let group_of = |kind: &str| kinds.iter().find(|one| one.name == kind)?.group;
        let read = |entry: fs::DirEntry| {
            let summary = fs::read(entry.path().join("summary.json")).ok()?;
            let found: Entry = serde_json::from_slice(&summary).ok()?;
            let name = entry.file_name().into_string().ok()?;
            let has_html = entry.path().join("report.html").is_file();
            let group = found.group.or_else(|| group_of(&found.kind));
            (found.program == PROGRAM && !name.starts_with('.')).then_some(Entry {
                name,
                has_html,
                group,
                ..found
            })
        };
        let folders = fs::read_dir(directory).into_iter().flatten().flatten();
        let mut entries: Vec<Entry> = folders.filter_map(read).collect();
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        let [list, cards] = Self::FILES;
        let pages = [(list, markdown(&entries)), (cards, page(&entries))];
        Self { reports: entries.len(), pages }
    }
}

/// The groups that hold reports, in their order: headings, and what they hold.
fn groups(entries: &[Entry]) -> impl Iterator<Item = (&'static str, Vec<&Entry>)> {
    const YOURS: &str = "Your surfaces";
    let all = [None].into_iter().chain(Group::ALL.map(Some));
    all.map(|group| {
        let of_group = entries.iter().filter(|entry| entry.group == group).collect();
        (group.map_or(YOURS, Group::title), of_group)
    })
    .filter(|(_, entries): &(_, Vec<_>)| !entries.is_empty())
}

/// The list of reports, for those who read the folder on the web.
fn markdown(entries: &[Entry]) -> String {
    let mut page = Page::new("Reports");
    for (title, entries) in groups(entries) {
        let row = |entry: &&Entry| {
            let link = |text: &str, file: &str| Cell::Link {
                text: text.to_owned(),
                to: format!("{}/{file}", entry.name),
            };
            vec![
                link(&entry.title, "report.md"),
                Cell::AroundCode(entry.answer.sentence.clone()),
                Cell::from(match entry.warnings.len() {
                    0 => "none".to_owned(),
                    count => count.to_string(),
                }),
                link("summary.json", "summary.json"),
            ]
        };
        page.heading(2, title).table(["report", "answer", "warnings", "data"], entries.iter().map(row));
    }
    page.paragraph(&format!("{MARK} overwritten by the next run."));
    page.markdown()
}

const STYLE: &str = include_str!("assets/index.css");
const SCRIPT: &str = include_str!("assets/index.js");

fn page(entries: &[Entry]) -> String {
    let kinds = sorted(entries.iter().map(|entry| entry.kind.clone()));
    let surfaces = sorted(entries.iter().flat_map(|entry| entry.surfaces().map(|(name, _)| name.clone())));
    let group = |(place, (title, entries)): (usize, (&str, Vec<&Entry>))| {
        let cards: String = entries.into_iter().map(card).collect();
        format!(
            "<section aria-labelledby=\"group-{place}\">\n<h2 id=\"group-{place}\">{title}</h2>\n<ul class=\"cards\">\n{cards}</ul>\n</section>\n"
        )
    };
    let all: String = groups(entries).enumerate().map(group).collect();
    let body = format!(
        "<h1>Reports</h1>\n<p>{} reports.</p>\n\
         <form class=\"filter\" hidden>\n{}{}<label>Words <input type=\"search\" id=\"words\"></label>\n\
         <span role=\"status\" id=\"count\"></span>\n</form>\n{all}<p>{MARK} overwritten by the next run.</p>\n",
        entries.len(),
        choice("Kind", "kind", &kinds),
        choice("Surface", "surface", &surfaces),
    );
    document("Reports", &body, STYLE, &format!("<script>\n{SCRIPT}</script>\n"))
}

fn sorted(all: impl Iterator<Item = String>) -> Vec<String> {
    let mut all: Vec<String> = all.filter(|name| !name.is_empty()).collect();
    all.sort();
    all.dedup();
    all
}

fn choice(label: &str, id: &str, values: &[String]) -> String {
    let option = |value: &String| format!("<option>{}</option>", escape(value));
    format!(
        "<label>{label} <select id=\"{id}\"><option value=\"\">all</option>{}</select></label>\n",
        values.iter().map(option).collect::<String>()
    )
}

fn card(entry: &Entry) -> String {
    let name = escape(&entry.name);
    let title = escape(&entry.title);
    let picture = if entry.files.iter().any(|file| file == CARD) {
        format!("<img src=\"{name}/{CARD}\" alt=\"Main figure: {title}\" loading=\"lazy\">\n")
    } else {
        String::new()
    };
    let surfaces: Vec<String> = entry.surfaces().map(|(name, _)| escape(name)).collect();
    let warnings = match entry.warnings.len() {
        0 => String::new(),
        1 => ", 1 warning".to_owned(),
        count => format!(", {count} warnings"),
    };
    let data = entry.data();
    format!(
        "<li data-kind=\"{kind}\" data-surfaces=\"{surfaces}\">\n<h3><a href=\"{name}/{page}\">{title}</a></h3>\n{picture}{answer}\
         <p class=\"facts\">[{kind}]{warnings}; <a href=\"{name}/{data}\">{data}</a></p>\n</li>\n",
        kind = escape(&entry.kind),
        page = entry.page(),
        surfaces = surfaces.join("\n"),
        answer = answer(&entry.answer),
    )
}

/// What a report found: of a case the lines that a reader needs first, else the sentence.
fn answer(answer: &Answer) -> String {
    const SHOWN: [&str; 3] = [CardLine::ANSWER, "difference", "instead"];
    let text = |text: &str| escape(&with_minus(&text.replace('`', "")));
    let line = |line: &CardLine| format!("<dt>{}</dt><dd>{}</dd>\n", escape(&line.label), text(&line.text()));
    let shown = answer.lines.iter().filter(|line| SHOWN.contains(&line.key.as_str()));
    let lines: String = shown.map(line).collect();
    if lines.is_empty() {
        format!("<p class=\"answer\">{}</p>\n", text(&answer.sentence))
    } else {
        format!("<dl class=\"answer\">\n{lines}</dl>\n")
    }
}
