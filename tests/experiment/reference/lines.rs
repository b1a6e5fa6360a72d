//! Analytical lines beside models and reference.

use super::{SMOOTH, SWEEP, THREE, of_model, run};
use crate::Report;
use crate::results::{column, figure, number, table};

/// A patch of few, smooth waves: contacts are resolved and the patch is many of them wide.
const PATCH: &str = generated!("a", 256, "0.25 um", "20 nm", "8 um" to "4 um");

#[test]
fn analytical_lines_are_those_of_the_gradient_in_figures_and_table() {
    let spec = |lines: &str| format!("law = \"hertz\"\n{THREE}{lines}{SWEEP}reference = {{ loads = 3 }}\n");
    let plain = run(&spec(""), SMOOTH);
    let outcome = run(&spec("lines = [\"persson\", \"bush-gibson-thomas\"]\n"), SMOOTH);
    let models = |outcome| figure(outcome, "a-models.svg").unwrap();
    for name in ["Persson", "Bush-Gibson-Thomas"] {
        assert!(models(&*outcome).contains(name) && !models(&*plain).contains(name));
    }
    let text = outcome.outline().markdown();
    assert!(text.contains("Persson, B. N. J. (2001)") && text.contains("Bush, A. W."), "{text}");
    assert!(!plain.outline().markdown().contains("Persson"));
    let summary = outcome.records();
    let slope = summary["surfaces"]["a"]["height_map"]["rms_slope"].as_f64().unwrap();
    let modulus = summary["reduced_modulus_pa"].as_f64().unwrap();
    let rows = table(&*outcome, "lines.csv").unwrap();
    assert_eq!(rows.len(), 2 * 3);
    for row in &rows {
        let ratio = number(row, "pressure_pa") / (modulus * slope);
        let factor = if row["line"] == "persson" { (8.0 / std::f64::consts::PI).sqrt() } else { 2.5066 };
        // Light loads.
        assert!((number(row, "area_ratio") / (factor * ratio) - 1.0).abs() < 0.012, "{row:?}");
    }
    // Without a reference at loads of each decade.
    let alone = run(&format!("law = \"hertz\"\nlines = [\"persson\"]\n{SWEEP}"), SMOOTH);
    assert_eq!(table(&*alone, "lines.csv").unwrap().len(), 5);
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
    let svg = figure(&*outcome, "a-models.svg").unwrap();
    for name in ["deterministic, with interaction", "statistical, with interaction", "undeformed mean plane"]
    {
        assert!(svg.contains(name), "{name}");
    }
    let rows = table(&*outcome, "lines.csv").unwrap();
    let of_line = |model: &str| -> Vec<f64> {
        let rows = rows.iter().filter(|row| row["model"] == model);
        rows.map(|row| number(row, "separation_over_sigma")).collect()
    };
    let sum = column(&of_model(&*outcome, "deterministic"), "separation_over_sigma");
    let [corrected, reference] = ["deterministic", "reference"].map(of_line);
    assert!(corrected.len() == 2 && reference.len() == 2, "{rows:?}");
    for ((found, reference), plain) in corrected.iter().zip(&reference).zip(sum) {
        assert!(plain - reference > 0.4, "{reference} {plain}");
        assert!((found - reference).abs() < 0.4 * (plain - reference).abs(), "{found} {reference} {plain}");
    }
    // The distance from the deformed surface is greater by the mean deflection; a surface without end has none.
    let solved = table(&*outcome, "reference.csv").unwrap();
    assert!(solved.iter().all(|row| number(row, "mean_gap_m") > number(row, "undeformed_gap_m")));
    let periodic = run(&format!("law = \"hertz\"\n{THREE}pressure = \"10 MPa\"\n"), PATCH);
    let row = &table(&*periodic, "reference.csv").unwrap()[0];
    assert!((number(row, "mean_gap_m") / number(row, "undeformed_gap_m") - 1.0).abs() < 1e-4);
}
