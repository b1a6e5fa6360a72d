//! Two readings of σ and d: of the asperities, or of the surface.

use asperity_framework::report::format::{input_number, input_quantity, number, quantity, ratio};
use asperity_framework::report::page::Page;

use crate::kind::compare::findings::{ReadLoads, Readings};

/// The range of the ratios of the loads, in a sentence; `None` of no loads.
pub fn finding(found: &Readings) -> Option<String> {
    let to = |[from, to]: [String; 2]| if from == to { from } else { format!("{from} to {to}") };
    let times = to(found.range()?.map(number));
    let valid = match found.valid_range().map(|range| to(range.map(number))) {
        Some(valid) if valid == times => "all of them valid".to_owned(),
        Some(valid) => format!("{valid} at the valid ones"),
        None => "none of them valid".to_owned(),
    };
    Some(format!(
        "**Reading of σ and d**: taken as those of the surface instead of the asperities, the same σ and d give a load {times} \
         times as high (d/σ = {}; {valid}).",
        to(found.separations()?.map(input_number))
    ))
}

/// The loads under both readings.
pub fn section(page: &mut Page, found: &Readings) {
    page.heading(2, "Two readings of σ and d");
    page.paragraph(&finding(found).unwrap_or_default());
    page.paragraph(
        "σ and d are either those of the asperities (standard deviation of their heights, separation from their mean height) \
         or those of the surface (Sq, separation from the mean plane). Asperities lie above the mean plane and scatter less \
         than the surface: the same d/σ is then a deeper contact.",
    );
    let has_thickness = found.loads.iter().any(|loads| loads.thickness.is_some());
    let mut header = vec!["asperity reading", "surface reading", "law"];
    if has_thickness {
        header.push("layer");
    }
    header.extend(["d/σ", "model", "p, asperity reading", "p, surface reading", "ratio", "valid"]);
    page.table(header, found.loads.iter().map(|loads| row(loads, has_thickness)));
    page.paragraph(
        "Pressures are means over the realisations. Valid: both models are within their valid range under both readings, in \
         every realisation.",
    );
}

fn row(loads: &ReadLoads, has_thickness: bool) -> Vec<String> {
    let [asperities, surface] = loads.surfaces.clone();
    let mut row = vec![asperities, surface, loads.law.clone()];
    if has_thickness {
        row.push(loads.thickness.map_or_else(String::new, |t| input_quantity(t, "m")));
    }
    row.extend([input_number(loads.separation), loads.kind.name().to_owned()]);
    row.extend(loads.answers.map(|answer| quantity(answer.pressure, "Pa")));
    row.extend([ratio(loads.ratio()), if loads.is_valid() { "yes" } else { "no" }.to_owned()]);
    row
}
