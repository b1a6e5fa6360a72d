//! Analytical lines beside models and reference.

use super::{SMOOTH, SWEEP, THREE, of_model, run};
use crate::Report;

use crate::results::{column, figure, number, table};

/// A patch of few, smooth waves: contacts are resolved and the patch is many of them wide.
const PATCH: &str = r#"
[surface.a.generate]
points = 256
pixel = "0.25 um"
sigma = "20 nm"
spectrum.self-affine = { hurst = 0.8, roll-off = "8 um", cut-off = "4 um" }
"#;

/// The rows of the last table of a page whose header begins with `| p |` and holds `name`.
fn page_table(page: &str, name: &str) -> Vec<Vec<String>> {
    let lines: Vec<&str> = page.lines().collect();
    let head = lines.iter().rposition(|line| line.starts_with("| p |") && line.contains(name)).unwrap();
    let cells =
        |line: &&str| line.trim_matches('|').split('|').map(|cell| cell.trim().replace("\\_", "_")).collect();
    let rows = lines[head..].iter().take_while(|line| line.starts_with('|'));
    rows.enumerate().filter(|(k, _)| *k != 1).map(|(_, line)| cells(line)).collect()
}

#[test]
fn analytical_lines_are_those_of_the_gradient_in_figures_and_table() {
    let spec = |lines: &str| format!("law = \"hertz\"\n{THREE}{lines}{SWEEP}reference = {{ loads = 3 }}\n");
    let plain = run(&spec(""), SMOOTH);
    let outcome = run(&spec("lines = [\"persson\", \"bush-gibson-thomas\"]\n"), SMOOTH);
    let area = |outcome| figure(outcome, "a-area.svg").unwrap();
    for name in ["Persson", "Bush-Gibson-Thomas"] {
        assert!(area(&*outcome).contains(name) && !area(&*plain).contains(name));
    }
    let separation = |outcome| figure(outcome, "a-separation.svg").unwrap();
    assert_eq!(separation(&*outcome), separation(&*plain));
    let text = outcome.outline().markdown();
    assert!(text.contains("Persson, B. N. J. (2001)") && text.contains("Bush, A. W."), "{text}");
    assert!(!plain.outline().markdown().contains("Persson"));
    let summary = outcome.records();
    let slope = summary["surfaces"]["a"]["height_map"]["rms_slope"].as_f64().unwrap();
    let modulus = summary["reduced_modulus_pa"].as_f64().unwrap();
    let rows = page_table(&text, "Persson");
    assert_eq!(rows[0], ["p", "A/A_nom Persson", "A/A_nom Bush-Gibson-Thomas", "A/A_nom ref."]);
    assert_eq!(rows.len(), 4);
    for (row, load) in rows[1..].iter().zip([1e6, 1e7, 1e8]) {
        let ratio = load / (modulus * slope);
        for (cell, area) in
            [(&row[1], (8.0 / std::f64::consts::PI).sqrt() * ratio), (&row[2], 2.5066 * ratio)]
        {
            // Light loads, three digits.
            let found: f64 = cell.parse().unwrap();
            assert!((found / area - 1.0).abs() < 0.012, "{row:?}: {area}");
        }
    }
    // Without a reference at loads of each decade.
    let alone = run(&format!("law = \"hertz\"\nlines = [\"persson\"]\n{SWEEP}"), SMOOTH).outline().markdown();
    assert_eq!(page_table(&alone, "Persson")[0], ["p", "A/A_nom Persson"]);
    assert_eq!(page_table(&alone, "Persson").len(), 6);
}

/// The separation of the models from the flat, less the deflection of the patch, is near that of the reference on a finite
/// patch; without it, it is off by half a sigma to a whole one.
#[test]
fn interaction_gives_the_distance_of_the_flat_from_an_undeformed_patch() {
    let spec = format!(
        "law = \"hertz\"\n{THREE}pressure = [\"20 MPa\", \"40 MPa\"]\nreference = {{ boundary = \"finite\" }}\n\
         lines = [\"greenwood-williamson-interacting\"]\n"
    );
    let outcome = run(&spec, PATCH);
    let svg = figure(&*outcome, "a-separation.svg").unwrap();
    for name in ["deterministic, with interaction", "statistical, with interaction", "undeformed mean plane"]
    {
        assert!(svg.contains(name), "{name}");
    }
    let rows = page_table(&outcome.outline().markdown(), "with interaction");
    assert_eq!(
        rows[0][1..],
        ["d/σ statistical with interaction", "d/σ deterministic with interaction", "d/σ ref., undeformed"]
    );
    let sum = column(&of_model(&*outcome, "deterministic"), "separation_over_sigma");
    for (row, plain) in rows[1..].iter().zip(sum) {
        let [found, reference] =
            [&row[2], &row[3]].map(|cell| cell.replace('−', "-").parse::<f64>().unwrap());
        assert!(plain - reference > 0.4, "{row:?} {plain}");
        assert!((found - reference).abs() < 0.4 * (plain - reference).abs(), "{row:?} {plain}");
    }
    // The distance from the deformed surface is greater by the mean deflection; a surface without end has none.
    let solved = table(&*outcome, "reference.csv").unwrap();
    assert!(solved.iter().all(|row| number(row, "mean_gap_m") > number(row, "undeformed_gap_m")));
    let periodic = run(&format!("law = \"hertz\"\n{THREE}pressure = \"10 MPa\"\n"), PATCH);
    let row = &table(&*periodic, "reference.csv").unwrap()[0];
    assert!((number(row, "mean_gap_m") / number(row, "undeformed_gap_m") - 1.0).abs() < 1e-4);
}
