//! `[laws]`.

use super::*;
use crate::results::{self, typed};

const LAWS: &str = concat!(
    r#"
title = "laws"
"#,
    steel!(),
    r#"yield-strength = "2.5 GPa"
[laws]
rough = "steel"
flat = "steel"
law = ["zmc", "ceb", "kogut-etsion", "jackson-green", "elliptic-zmc", "hertz"]
asperity = { radius = "20 um", curvature-ratio = 3 }
indentation = { from = 1e-2, to = 1e2, points = 5 }
pressure = { values = ["1 MPa", "10 MPa", "1 GPa"] }
[surface.drawn.population]
radius = "20 um"
curvature-ratio = 2
sigma = "48 nm"
density = "6e10 /m^2"
count = 20000
"#
);

#[test]
fn laws_have_their_tables_and_say_what_matters() {
    let folder = tempfile::tempdir().unwrap();
    let (spec, out) = (folder.path().join("laws.toml"), folder.path().join("reports"));
    fs::write(&spec, LAWS).unwrap();
    let output = run(&spec, &out, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("it was fitted for 0.001 to 0.008"), "{}", text(&output.stderr));
    let table = |name: &str| {
        let mut reader = csv::Reader::from_path(out.join("laws").join(name)).unwrap();
        let columns: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        (columns, rows)
    };

    // One unit for all: (0.3 pi)^2 R (H/E*)^2.
    let (columns, rows) = table("laws.csv");
    assert_eq!(rows.len(), 6 * 5);
    assert_eq!(columns[..3], ["law", "indentation_over_critical", "indentation_m"]);
    let critical = 0.09 * std::f64::consts::PI.powi(2) * 20e-6 * (7.6f64 / (210.0 / 1.82)).powi(2);
    for row in &rows {
        let [ratio, w] = [1, 2].map(|k| row[k].parse::<f64>().unwrap());
        assert!((w / (ratio * critical) - 1.0).abs() < 1e-12, "{row:?}");
        // All but the ellipse are Hertz's sphere far below the onset.
        let load: f64 = row[5].parse().unwrap();
        if ratio < 0.5 && &row[0] != "elliptic-zmc" {
            assert!((load / ratio.powf(1.5) - 1.0).abs() < 1e-12, "{row:?}");
        }
    }

    let (columns, rows) = table("boundaries.csv");
    let jump = columns.iter().position(|column| column == "load_jump").unwrap();
    let jumps: Vec<(String, i64)> = rows
        .iter()
        .map(|row| (row[0].to_owned(), (1e3 * row[jump].parse::<f64>().unwrap()).round() as i64))
        .collect();
    let of = |law: &str| jumps.iter().filter(|(of, _)| of == law).map(|(_, jump)| *jump).collect::<Vec<_>>();
    assert_eq!((of("zmc"), of("ceb"), of("kogut-etsion")), (vec![0, 0], vec![500], vec![30, 17, 79]));
    assert_eq!((of("elliptic-zmc"), of("hertz")), (vec![0, 0], vec![]));

    let (columns, rows) = table("influence.csv");
    assert_eq!(rows.len(), 2 * 3);
    let at = |name: &str| columns.iter().position(|column| column == name).unwrap();
    for row in &rows {
        // At 1 GPa asperities interact.
        assert_eq!(
            &row[at("counts")],
            if &row[at("pressure_pa")] == "1000000000.0" { "false" } else { "true" }
        );
        let [all, passing] = ["all_laws_deterministic", "passing_laws_deterministic"]
            .map(|name| row[at(name)].parse::<f64>().unwrap());
        assert!(all >= passing && passing > 0.0, "{row:?}");
    }
    assert_eq!(table("curves.csv").1.len(), 6 * 3 * 2);

    let summary = fs::read_to_string(out.join("laws/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let drawn = &summary["surfaces"]["drawn"];
    assert_eq!(drawn["mean_smaller_over_larger_curvature"], 0.5);
    assert!((drawn["mean_curvature_per_m"].as_f64().unwrap() * 20e-6 - 1.0).abs() < 1e-12);
    let measured = &typed(results::rows(&fs::read(out.join("laws/law_or_summation.csv")).unwrap()))[0];
    assert_eq!((&measured["loads"], &measured["matters_more"]), (&2.into(), &"cannot-tell".into()));
    let [mean, largest] =
        ["models_difference", "largest_models_difference"].map(|name| measured[name].as_f64().unwrap());
    assert!(mean > 0.0 && mean <= largest.abs(), "{measured}");

    let page = fs::read_to_string(out.join("laws/report.md")).unwrap();
    for words in [
        "Which changes the separation more, summation or contact law, cannot be told on any of 1 surfaces",
        "## What matters more?",
        "| mean curvature | 50000 /m |",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("NaN"));
}
