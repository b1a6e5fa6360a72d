//! `[laws]`.

use super::*;
use crate::results::typed;

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
    assert!(text(&output.stderr).contains("it was fitted for 0.001 to 0.008"), "{}", text(&output.stderr));
    let table = |name: &str| rows(&out, "laws", name);

    // One unit for all: (0.3 pi)^2 R (H/E*)^2.
    let points = table("laws.csv");
    assert_eq!(points.len(), 6 * 5);
    let critical = 0.09 * std::f64::consts::PI.powi(2) * 20e-6 * (7.6f64 / (210.0 / 1.82)).powi(2);
    for row in &points {
        let [ratio, w] = ["indentation_over_critical", "indentation_m"].map(|name| number(row, name));
        assert!((w / (ratio * critical) - 1.0).abs() < 1e-12, "{row:?}");
        // All but the ellipse are Hertz's sphere far below the onset.
        let load = number(row, "load_over_critical");
        if ratio < 0.5 && row["law"] != "elliptic-zmc" {
            assert!((load / ratio.powf(1.5) - 1.0).abs() < 1e-12, "{row:?}");
        }
    }

    let influence = table("influence.csv");
    assert_eq!(influence.len(), 2 * 3);
    for row in &influence {
        // At 1 GPa asperities interact.
        assert_eq!(row["counts"] == "false", row["pressure_pa"] == "1000000000.0", "{row:?}");
        let [all, passing] =
            ["all_laws_deterministic", "passing_laws_deterministic"].map(|name| number(row, name));
        assert!(all >= passing && passing > 0.0, "{row:?}");
    }
    assert_eq!(table("curves.csv").len(), 6 * 3 * 2);

    let summary = summary(&out, "laws");
    let drawn = &summary["surfaces"]["drawn"];
    assert_eq!(drawn["mean_smaller_over_larger_curvature"], 0.5);
    assert!((drawn["mean_curvature_per_m"].as_f64().unwrap() * 20e-6 - 1.0).abs() < 1e-12);
    let measured = &typed(table("law_or_summation.csv"))[0];
    assert_eq!((&measured["loads"], &measured["matters_more"]), (&2.into(), &"cannot-tell".into()));
    let [mean, largest] =
        ["models_difference", "largest_models_difference"].map(|name| measured[name].as_f64().unwrap());
    assert!(mean > 0.0 && mean <= largest.abs(), "{measured}");

    let page = fs::read_to_string(out.join("laws/report.md")).unwrap();
    let answer =
        "Which changes the separation more, summation or contact law, cannot be told on any of 1 surfaces";
    assert!(page.contains(answer) && !page.contains("NaN"), "{page}");
}
