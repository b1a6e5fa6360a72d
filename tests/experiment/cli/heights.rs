//! Height distributions, from the input file to the summary.

use std::fs;

use super::{run, text};

const SPEC: &str = r#"
title = "heights"

[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"

[compare]
rough = "steel"
flat = "steel"
law = "zmc"
separation = { values = [2, 0] }

[surface.a.population]
radius = "20 um"
sigma = "48 nm"
density = "6e10 /m^2"
count = 40000
draw = "quantiles"
heights = HEIGHTS
"#;

/// The last pressures of both models, Pa, and the distribution in the summary.
fn outcome(spec: &str) -> (f64, f64, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("heights.toml");
    fs::write(&file, spec).unwrap();
    let out = folder.path().join("reports");
    let output = run(&file, &out, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let read = |name: &str| fs::read_to_string(out.join("heights").join(name)).unwrap();
    let table = read("curves.csv");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let column = |name: &str| head.iter().position(|column| *column == name).unwrap();
    let (model, pressure) = (column("model"), column("pressure_pa"));
    let rows: Vec<Vec<&str>> = lines.collect();
    let last = |name: &str| {
        let row = rows.iter().rfind(|row| row[model] == name).unwrap();
        row[pressure].parse::<f64>().unwrap()
    };
    let summary: serde_json::Value = serde_json::from_str(&read("summary.json")).unwrap();
    let heights = &summary["surfaces"]["a"]["model_heights"];
    (last("statistical"), last("deterministic"), heights.as_str().unwrap().to_owned())
}

#[test]
fn a_population_of_any_distribution_is_that_of_both_models() {
    for heights in [
        "\"exponential\"",
        "{ weibull = { shape = 2 } }",
        "{ weibull = { shape = 0.7 } }",
        "{ johnson = { skewness = -1, kurtosis = 4.5 } }",
    ] {
        let (statistical, deterministic, summary) = outcome(&SPEC.replace("HEIGHTS", heights));
        assert!((statistical / deterministic - 1.0).abs() < 1e-3, "{heights}: {statistical} {deterministic}");
        assert_eq!(summary, heights.replace('"', ""));
    }
}

#[test]
fn the_statistical_model_takes_the_heights_that_the_comparison_names() {
    let named = SPEC
        .replace("HEIGHTS", "\"gaussian\"")
        .replace("law = \"zmc\"", "law = \"zmc\"\nstatistical = { heights = { weibull = { shape = 2 } } }");
    let (statistical, deterministic, summary) = outcome(&named);
    assert_eq!(summary, "{ weibull = { shape = 2 } }");
    let weibull = outcome(&SPEC.replace("HEIGHTS", "{ weibull = { shape = 2 } }"));
    let gaussian = outcome(&SPEC.replace("HEIGHTS", "\"gaussian\""));
    assert_eq!((statistical, deterministic), (weibull.0, gaussian.1));
}
