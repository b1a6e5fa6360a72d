//! A card per report: title, answer and main figure; filtered by kind, surface and words.

use super::{Entry, MARK};
use crate::report::page::{document, escape_html as escape, with_minus};

const STYLE: &str = include_str!("assets/index.css");
const SCRIPT: &str = include_str!("assets/index.js");

pub fn page(entries: &[Entry]) -> String {
    let kinds = sorted(entries.iter().map(|entry| entry.kind.clone()));
    let surfaces = sorted(entries.iter().flat_map(|entry| entry.surfaces().map(|(name, _)| name.clone())));
    let cards: String = entries.iter().map(card).collect();
    let body = format!(
        "<h1>Reports</h1>\n<p>{} reports. <a href=\"comparison.html\">Compare curves of several reports</a>.</p>\n\
         <form class=\"filter\" hidden>\n{}{}<label>Words <input type=\"search\" id=\"words\"></label>\n\
         <span role=\"status\" id=\"count\"></span>\n</form>\n<ul class=\"cards\">\n{cards}</ul>\n<p>{MARK} overwritten by the next run.</p>\n",
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
    let figure = entry.figure.as_ref().map_or_else(String::new, |file| {
        format!("<img src=\"{name}/{}\" alt=\"Main figure: {title}\" loading=\"lazy\">\n", escape(file))
    });
    let surfaces: Vec<String> = entry.surfaces().map(|(name, _)| escape(name)).collect();
    let warnings = match entry.warnings.len() {
        0 => String::new(),
        1 => ", 1 warning".to_owned(),
        count => format!(", {count} warnings"),
    };
    let data = entry.data();
    format!(
        "<li data-kind=\"{kind}\" data-surfaces=\"{surfaces}\">\n<h2><a href=\"{name}/{page}\">{title}</a></h2>\n{figure}\
         <p class=\"answer\">{answer}</p>\n<p class=\"facts\">[{kind}]{warnings}; <a href=\"{name}/{data}\">{data}</a></p>\n</li>\n",
        kind = escape(&entry.kind),
        page = entry.page(),
        surfaces = surfaces.join("\n"),
        answer = escape(&with_minus(&entry.answer.sentence)),
    )
}
