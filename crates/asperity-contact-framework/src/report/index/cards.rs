//! A card per report, by groups: title, answer and picture; filtered by kind, surface and words.

use super::{CARD, Entry, MARK, groups};
use crate::report::answer::{Answer, CardLine};
use crate::report::page::{document, escape_html as escape, with_minus};

const STYLE: &str = include_str!("assets/index.css");
const SCRIPT: &str = include_str!("assets/index.js");

pub fn page(entries: &[Entry]) -> String {
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
