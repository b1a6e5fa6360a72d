//! `[indentation]` from the spec to the report: Fig. 5 of Pasaribu and Schipper (2005), the limits, measured points, the rules.

use std::fs;
use std::path::Path;

use asperity::sphere::{Curve, DecreasingQuantity};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use asperity_experiment::kind::indentation::IndentationResults;

use crate::Report;
use crate::results::{column, number, read, run_in, table};

fn committed(stem: &str) -> IndentationResults {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments").join(stem).with_extension("toml");
    crate::downcast(Experiment::read(&path).unwrap().run(&Silent).unwrap())
}

const BODIES: &str = concat!(
    r#"
title = "one sphere"
"#,
    steel!(),
    lead!(),
    r#"[indentation]
ball = "steel"
flat = "steel"
law = ["hertz", "zmc"]
"#
);

/// Runs an `[indentation]` table with a file of measured points.
fn run_words(words: &str, points: &str) -> (tempfile::TempDir, IndentationResults) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("points.csv"), points).unwrap();
    let results = crate::downcast(run_in(folder.path(), &format!("{BODIES}{words}")).unwrap());
    (folder, results)
}

fn loads(curve: &Curve) -> Vec<f64> {
    curve.points.iter().map(|point| point.contact.load).collect()
}

#[test]
fn changes_of_figure_5() {
    for (stem, known, beyond) in [
        ("sherbiny-lead-on-steel", &[0.0409, 1.057, 4.627, 248.6][..], 1),
        ("tang-arnell-ceramic-on-steel", &[0.635, 8.76][..], 1),
    ] {
        let results = committed(stem);
        let coated = &results.layers[0].laws[0].coated;
        assert_eq!(coated.changes.len(), known.len(), "{stem}");
        for (found, known) in coated.changes.iter().zip(known) {
            assert!((found.indentation * 1e6 / known - 1.0).abs() < 1e-3, "{stem}: {found:?}");
            assert_ne!(found.from, found.to);
        }
        assert!(coated.changes.windows(2).all(|pair| pair[0].to == pair[1].from), "{stem}");
        assert_eq!(coated.changes.len() - coated.changes_within().count(), beyond, "{stem}");
        assert!(coated.decreases.is_empty(), "{stem}");
    }
}

#[test]
fn loads_of_figure_5_in_the_table() {
    let words = "radius = \"12.75 mm\"\nlayer = { material = \"lead\", thickness = \"1.2 um\" }\n\
                 indentation = { values = [1e-7, 5e-7, 1e-6, 2e-6, 5e-6] }\n";
    let spec = BODIES.replace("flat = \"steel\"", "flat = \"mild\"").replace(
        "[material.lead]",
        "[material.mild]\nyoung = \"140 GPa\"\npoisson = 0.3\nhardness = \"1.86 GPa\"\n[material.lead]",
    );
    let rows = table(&*crate::results::run(&(spec + words)).unwrap(), "indentation.csv").unwrap();
    let coated = rows.iter().filter(|row| row["law"] == "zmc" && row["curve"] == "coated");
    let loads: Vec<f64> = coated.map(|row| number(row, "load_n")).collect();
    let known = [0.375385, 4.06646, 13.6708, 39.129, 153.356];
    assert_eq!(loads.len(), known.len());
    for (found, known) in loads.iter().zip(known) {
        assert!((found / known - 1.0).abs() < 2e-6, "{found} N, known {known}");
    }
}

#[test]
fn curves_lie_between_their_limits_and_reach_them() {
    let words = |t: &str, range: &str| {
        format!(
            "radius = \"1 mm\"\nlayer = {{ material = \"lead\", thickness = \"{t}\" }}\nindentation = {range}\n"
        )
    };
    let range = "{ from = \"1 nm\", to = \"1 um\", points = 13 }";
    let (_folder, between) = run_words(&words("1 um", range), "");
    let layer = &between.layers[0];
    let hertz = &layer.laws[0];
    for k in 0..13 {
        let [soft, coated, stiff] =
            [&hertz.all_layer, &hertz.coated, &hertz.uncoated].map(|curve| loads(curve)[k]);
        let exact = layer.exact[k].unwrap();
        assert!(soft < coated && coated < stiff && soft < exact.load && exact.load < coated, "point {k}");
        assert_eq!(exact.indentation, between.indentations[k]);
        assert_eq!(layer.errors[0][k].ratio > 1.0, coated > exact.load);
        assert!((layer.errors[0][k].ratio / (coated / exact.load) - 1.0).abs() < 1e-10);
    }
    let close = |t: &str, to: fn(&asperity_experiment::kind::indentation::LawCurves) -> &Curve| {
        let (_folder, results) = run_words(&words(t, range), "");
        for law in &results.layers[0].laws {
            for (found, limit) in loads(&law.coated).iter().zip(loads(to(law))) {
                assert!((found / limit - 1.0).abs() < 1e-4, "{t}, {}: {found} and {limit}", law.law);
            }
        }
    };
    close("1e-6 nm", |law| &law.uncoated);
    close("10 m", |law| &law.all_layer);
}

#[test]
fn an_exact_contact_that_is_too_wide_is_left_out() {
    let words = "radius = \"1 m\"\nlayer = { material = \"lead\", thickness = \"1 nm\" }\n\
                 indentation = { from = \"1e-4 nm\", to = \"1 um\", points = 15 }\n";
    let (_folder, results) = run_words(words, "");
    let layer = &results.layers[0];
    let solved = layer.exact.iter().flatten().count();
    assert!(solved > 0 && solved < 15);
    assert!(layer.exact[..solved].iter().all(Option::is_some));
    assert_eq!(layer.errors[0].len(), solved);
    assert!(asperity_contact_framework::folder(&results, "key").is_ok());
    let page = |results: &dyn Outcome| results.outline().markdown();
    assert!(page(&results).contains("rules.svg"));
    // With none at all there is nothing to draw.
    let (_folder, none) = run_words(&words.replace("1e-4 nm", "0.1 um"), "");
    assert!(none.layers[0].exact.iter().all(Option::is_none));
    assert!(!page(&none).contains("rules.svg") && !page(&none).contains("Errors against a/t"));
}

/// The errors of both models are those of the layer, whichever of them the spec chose.
#[test]
fn a_layer_under_both_models_has_its_errors_once() {
    let words = "radius = \"20 um\"\nlayer = [{ material = \"lead\", thickness = \"1 um\" }, \
                 { material = \"lead\", thickness = \"1 um\", rule = \"series\" }]\n\
                 indentation = { from = \"1 nm\", to = \"100 nm\", points = 4 }\n";
    let (_folder, results) = run_words(words, "");
    let page = (&results as &dyn Outcome).outline().markdown();
    for error in ["`gao` overestimates", "`series` underestimates"] {
        assert_eq!(page.matches(error).count(), 1, "{page}");
    }
    assert_eq!(table(&results, "rule.csv").unwrap().len(), 2 * 4);
}

#[test]
fn a_decreasing_area_is_reported() {
    let words = "radius = \"20 um\"\nlayer = { material = \"lead\", thickness = \"100 nm\" }\n\
                 indentation = { from = \"0.1 nm\", to = \"1 um\", points = 41 }\n";
    let (_folder, results) = run_words(words, "");
    let layer = &results.layers[0];
    assert!(layer.laws[0].coated.decreases.is_empty());
    assert_eq!(
        layer.laws[1].coated.decreases.iter().map(|decrease| decrease.of).collect::<Vec<_>>(),
        [DecreasingQuantity::Area]
    );
    let decreases = table(&results, "coated_decreases.csv").unwrap();
    let [one] = &decreases[..] else { panic!("{decreases:?}") };
    assert_eq!(["layer", "rule", "law", "of"].map(|name| &*one[name]), ["lead", "gao", "zmc", "area"]);
}

#[test]
fn measured_points_are_compared_with_the_curve() {
    let words = "radius = \"12.75 mm\"\nlayer = { material = \"lead\", thickness = \"1.2 um\" }\n\
                 indentation = { from = \"10 nm\", to = \"5 um\", points = 11 }\noverlay = \"points.csv\"\n";
    let (folder, results) = run_words(words, "# mine\nlot, load, indentation\na, 2.5, 1e-7\nb, 20, 1e-6\n");
    assert_eq!(results.overlay[..], [(1e-7, 2.5), (1e-6, 20.0)]);
    for law in &results.layers[0].laws {
        assert_eq!(law.at_overlay.len(), 2);
    }
    assert_eq!(column(&table(&results, "overlay.csv").unwrap(), "measured_load_n"), [2.5, 20.0, 2.5, 20.0]);
    // Other points are another experiment.
    let key = || read(folder.path(), &format!("{BODIES}{words}")).unwrap().key().unwrap();
    let before = key();
    fs::write(folder.path().join("points.csv"), "load, indentation\n2.5, 1e-7\n").unwrap();
    assert_ne!(key(), before);
}
