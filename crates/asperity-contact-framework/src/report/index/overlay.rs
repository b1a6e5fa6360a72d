//! Curves of several reports in one figure, which the reader chooses.

use std::path::Path;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Entry, MARK};
use crate::report::format::{number, quantity, thickness};
use crate::report::page::{CHART_STYLE, charts, document, escape_html as escape};

const STYLE: &str = include_str!("assets/index.css");
const SCRIPT: &str = include_str!("assets/comparison.js");

/// Points of a curve; of more, equally many are left out between those shown.
const MOST_POINTS: usize = 40;

/// What a row of `curves.csv` says here.
#[derive(Deserialize)]
struct Row {
    surface: String,
    realisation: usize,
    law: String,
    layer_thickness_m: Option<f64>,
    model: String,
    pressure_pa: f64,
    load_ratio: f64,
    area_ratio: f64,
    separation_over_sigma: f64,
    limits: String,
}

/// A curve of one model: pressures (MPa), load ratios, area ratios, separations over sigma.
#[derive(Default, Serialize)]
struct Curve([Vec<f64>; 4]);

/// Both models on one surface, under one law and thickness.
#[derive(Serialize)]
struct Case {
    report: String,
    name: String,
    models: IndexMap<String, Curve>,
    /// The cells of its row: surface, law, layer, E*, H, skewness.
    #[serde(skip)]
    cells: [String; 6],
}

pub fn page(directory: &Path, entries: &[Entry]) -> String {
    let cases: Vec<Case> = entries.iter().flat_map(|entry| cases(directory, entry)).collect();
    let row = |(index, case): (usize, &Case)| {
        let report = escape(&case.report);
        let cells: String = case.cells.iter().map(|cell| format!("<td>{}</td>", escape(cell))).collect();
        format!(
            "<tr><td><input type=\"checkbox\" value=\"{index}\" aria-label=\"{report}: {}\" disabled></td>\
             <td><a href=\"{report}/report.html\">{report}</a></td>{cells}</tr>\n",
            escape(&case.name)
        )
    };
    let rows: String = cases.iter().enumerate().map(row).collect();
    let data = serde_json::to_string(&cases).unwrap_or_default().replace('<', "\\u003c");
    let body = format!(
        "<h1>Compare curves of several reports</h1>\n\
         <p>Both models over load on the surfaces, laws and layers that you choose, at admissible loads. <a href=\"index.html\">All reports</a>.</p>\n\
         <noscript><p>The curves are drawn by a script, which does not run here; each report shows its own.</p></noscript>\n\
         <figure id=\"comparison\"><figcaption>Solid: deterministic model and difference; dashed: statistical model. Admissible loads only, first \
         realisation.</figcaption></figure>\n\
         <form class=\"filter\" hidden>\n<label>Along x <select id=\"along\"><option value=\"0\">nominal pressure (MPa)</option>\
         <option value=\"1\">load ratio P/(Aₙₒₘ E*)</option></select></label>\n\
         <label>Words <input type=\"search\" id=\"words\"></label>\n<span role=\"status\" id=\"count\"></span>\n</form>\n\
         <div class=\"table cases\" role=\"region\" aria-label=\"Curves\" tabindex=\"0\"><table>\n<thead><tr><th>show</th><th>report</th>\
         <th>surface</th><th>law</th><th>layer</th><th>E*</th><th>hardness</th><th>skewness</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n\
         <script type=\"application/json\" id=\"cases\">{data}</script>\n<p>{MARK} overwritten by the next run.</p>\n"
    );
    let script = format!("{}<script>\nconst COLOURS = {};\n{SCRIPT}</script>\n", charts(), colours());
    document("Compare reports", &body, &format!("{CHART_STYLE}\n{STYLE}"), &script)
}

/// The colours of curves as JSON.
fn colours() -> String {
    serde_json::to_string(&asperity_plot::series_colours()).unwrap_or_default()
}

/// The cases of a report that holds curves of both models.
fn cases(directory: &Path, entry: &Entry) -> Vec<Case> {
    let path = directory.join(&entry.name).join("curves.csv");
    let Ok(mut reader) = csv::Reader::from_path(path) else { return Vec::new() };
    let rows = reader.deserialize().map_while(Result::<Row, _>::ok);
    let mut all: IndexMap<(String, String, String), Case> = IndexMap::new();
    for row in rows.filter(|row| row.realisation == 1 && row.limits.is_empty()) {
        let layer = row.layer_thickness_m.map_or_else(String::new, thickness);
        let key = (row.surface.clone(), row.law.clone(), layer.clone());
        let case = all.entry(key).or_insert_with(|| new_case(entry, &row, layer));
        let Curve(columns) = case.models.entry(row.model).or_default();
        let values = [1e-6 * row.pressure_pa, row.load_ratio, row.area_ratio, row.separation_over_sigma];
        columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }
    let mut cases: Vec<Case> = all.into_values().filter(|case| case.models.len() > 1).collect();
    for Curve(columns) in cases.iter_mut().flat_map(|case| case.models.values_mut()) {
        let every = columns[0].len().div_ceil(MOST_POINTS).max(1);
        for column in columns {
            *column = column.iter().step_by(every).map(|&value| rounded(value)).collect();
        }
    }
    cases
}

fn new_case(entry: &Entry, row: &Row, layer: String) -> Case {
    let facts = entry.surfaces().find(|(name, _)| **name == row.surface).map(|(_, facts)| facts);
    let skewness = facts.and_then(|facts| facts.get("skewness")).and_then(Value::as_f64);
    let modulus = entry.reduced_modulus_pa.map_or_else(String::new, |value| quantity(value, "Pa"));
    let hardness = entry.hardness_pa.map_or_else(String::new, |value| quantity(value, "Pa"));
    let parts = [&row.surface, &row.law, &layer];
    let parts: Vec<&str> = parts.into_iter().map(String::as_str).filter(|part| !part.is_empty()).collect();
    Case {
        report: entry.name.clone(),
        name: parts.join(", "),
        models: IndexMap::new(),
        cells: [
            row.surface.clone(),
            row.law.clone(),
            layer,
            modulus,
            hardness,
            skewness.map_or_else(String::new, number),
        ],
    }
}

/// Five digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
