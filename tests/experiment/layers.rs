//! Comparisons under a layer, from a spec to the report.

use asperity::compare::ModelKind;
use asperity::sphere::DecreasingQuantity;
use asperity::study::Threshold;
use asperity_contact_framework::Outcome;
use asperity_experiment::kind::compare::results::CompareResults;

use crate::Report;
use crate::results::{Row, column, run, table, typed};

/// A steel population on a flat; the keys of the flat are given.
fn spec(flat: &str) -> String {
    // Under a film the rough body never yields, and is pressed deep.
    let (rough, nearest) = if flat.contains("film") { ("hard", -9.0) } else { ("steel", 1.0) };
    let case_1 = case_1!();
    format!(
        r#"
title = "t"
seed = 3
{}{}[material.titanium]
young = "120 GPa"
poisson = 0.33
hardness = "3 GPa"
[material.film]
young = "200 GPa"
poisson = 0.3
hardness = "2 GPa"
[material.soft]
young = "200 GPa"
poisson = 0.3
hardness = "0.1 GPa"
[material.hard]
young = "600 GPa"
poisson = 0.2
[compare]
rough = "{rough}"
{flat}
law = ["zmc", "hertz"]
separation = {{ values = [3, {nearest}] }}
pressure = {{ values = ["1 MPa", "10 MPa"] }}
[surface.a.population]
{case_1}count = 5000
"#,
        steel!(),
        lead!(),
    )
}

fn results(flat: &str) -> Box<dyn Outcome> {
    run(&spec(flat)).unwrap()
}

fn compared(flat: &str) -> CompareResults {
    crate::downcast(results(flat))
}

const LAYERS: &str = r#"flat = "steel"
layer = { material = "lead", thickness = [0, 2e-8, 5e-8, "inf"] }"#;

/// The contract's rows: surface, realisation, law, thickness.
#[test]
fn every_law_runs_under_every_thickness_in_file_order() {
    let found = compared(LAYERS);
    let cases: Vec<(&str, Option<f64>)> = found.surfaces[0]
        .cases
        .iter()
        .map(|case| case.first())
        .map(|case| (case.law.as_str(), case.thickness))
        .collect();
    let thicknesses = [0.0, 20e-9, 50e-9, f64::INFINITY];
    let expected: Vec<(&str, Option<f64>)> =
        ["zmc", "hertz"].into_iter().flat_map(|law| thicknesses.map(|t| (law, Some(t)))).collect();
    assert_eq!(cases, expected);
    for file in ["curves.csv", "comparison.csv"] {
        let mut read = column(&table(&found, file).unwrap(), "layer_thickness_m");
        read.dedup();
        assert_eq!(read, [thicknesses, thicknesses].concat());
    }
}

#[test]
fn thicknesses_may_be_spaced_by_equal_ratios() {
    let thicknesses = |written: &str| {
        let flat = format!("flat = \"steel\"\nlayer = {{ material = \"lead\", thickness = {written} }}");
        let found = compared(&flat);
        found.contact.layer.unwrap().thicknesses
    };
    let swept = thicknesses("{ from = \"10 nm\", to = 1e-6, points = 3 }");
    let listed = thicknesses("[\"10 nm\", \"100 nm\", \"1 um\"]");
    assert_eq!((swept[0], swept[2], swept.len()), (listed[0], listed[2], 3));
    assert!((swept[1] / listed[1] - 1.0).abs() < 1e-12, "{swept:?}");
}

#[test]
fn no_layer_is_the_substrate_and_all_layer_the_layer_to_the_bit() {
    let layered = compared(LAYERS);
    let [steel, lead] = ["steel", "lead"].map(|flat| compared(&format!("flat = \"{flat}\"")));
    let curves = |results: &CompareResults, thickness| {
        let cases = results.surfaces[0].cases.iter().map(|case| case.first());
        let of = cases.filter(|case| case.thickness == thickness);
        of.map(|case| case.comparison.curves.clone()).collect::<Vec<_>>()
    };
    assert_eq!(curves(&layered, Some(0.0)), curves(&steel, None));
    assert_eq!(curves(&layered, Some(f64::INFINITY)), curves(&lead, None));
    assert_ne!(curves(&layered, Some(20e-9)), curves(&steel, None));
    // Load ratios refer to the pair without the layer.
    assert_eq!(layered.contact.reduced_modulus, steel.contact.reduced_modulus);
}

/// A report of one model shows that model only, with a/t of its contacts.
#[test]
fn a_report_of_one_model_shows_one_model() {
    let of = |models: &str| {
        let found = compared(&format!("{LAYERS}\nmodels = {models}"));
        let case = &found.surfaces[0].cases[1].first();
        let point = &case
            .comparison
            .curves
            .iter()
            .rfind(|point| point.prescribed_pressure == Some(1e6))
            .unwrap()
            .response;
        let mean = point.area_ratio.total() / point.contact_density;
        let ratio = (mean / std::f64::consts::PI).sqrt() / 2e-8;
        let page = (&found as &dyn Outcome).outline().markdown();
        let model = if models.contains("deterministic") { "deterministic" } else { "statistical" };
        let start = format!("| 1 | 20 nm | {model} |");
        let row = page.lines().find(|line| line.starts_with(&start)).unwrap().to_owned();
        assert!(
            row.contains(&format!("| {} |", asperity_contact_framework::report::format::number(ratio))),
            "{row}: {ratio}"
        );
        let has = |model: &str| page.contains(&format!("| 1 | 20 nm | {model} |"));
        [has("statistical"), has("deterministic")]
    };
    assert_eq!(of("[\"statistical\"]"), [true, false]);
    assert_eq!(of("[\"deterministic\"]"), [false, true]);
    assert_eq!(of("[\"statistical\", \"deterministic\"]"), [true, true]);
}

/// Just below the threshold the area is within 5 %, just above it is not.
#[test]
fn a_threshold_is_where_the_area_has_changed_by_5_percent() {
    let thresholds = compared(LAYERS).surfaces.remove(0).thresholds;
    assert_eq!(thresholds.len(), 8, "2 laws, 2 loads, 2 models");
    let first: &Threshold = &thresholds[0];
    assert_eq!((first.law.as_str(), first.kind, first.pressure), ("zmc", ModelKind::Statistical, 1e6));
    // 1 MPa is carried by fewer than 30 effective contacts, in the sum and in what is compared with it.
    for threshold in &thresholds {
        assert_eq!(threshold.exceeded.is_none(), threshold.pressure == 1e7, "{threshold:?}");
        assert_eq!(threshold.thickness.is_some(), threshold.exceeded.is_none(), "{threshold:?}");
    }
    for threshold in thresholds.iter().filter(|threshold| threshold.exceeded.is_none()) {
        let t = threshold.thickness.unwrap();
        let flat = format!(
            "flat = \"steel\"\nlayer = {{ material = \"lead\", thickness = [0, {:e}, {:e}] }}",
            t * 0.99,
            t * 1.01
        );
        let around = compared(&flat);
        let cases =
            around.surfaces[0].cases.iter().map(|case| case.first()).filter(|case| case.law == threshold.law);
        let areas: Vec<f64> = cases
            .map(|case| {
                case.comparison
                    .at_load(threshold.kind, threshold.pressure)
                    .unwrap()
                    .response
                    .area_ratio
                    .total()
            })
            .collect();
        let change = |k: usize| (areas[k] / areas[0] - 1.0).abs();
        assert!(change(1) < 0.05 && change(2) > 0.05, "{threshold:?}: {} {}", change(1), change(2));
    }
}

/// Jackson and Green's law is not defined under a finite layer, so it has no threshold.
#[test]
fn a_law_without_layers_has_no_threshold() {
    let words = spec("flat = \"steel\"\nlayer = { material = \"lead\", thickness = [0, \"inf\"] }")
        .replace("hardness = \"7.6 GPa\"", "hardness = \"7.6 GPa\"\nyield-strength = \"2.7 GPa\"")
        .replace("hardness = \"0.17 GPa\"", "hardness = \"0.17 GPa\"\nyield-strength = \"0.06 GPa\"")
        .replace("\"hertz\"", "\"jackson-green\"");
    let found: CompareResults = crate::downcast(run(&words).unwrap());
    let of = |law: &str| found.surfaces[0].thresholds.iter().filter(|found| found.law == law).count();
    assert_eq!((of("zmc"), of("jackson-green")), (4, 0));
    assert_eq!(found.surfaces[0].cases.len(), 4);
}

#[test]
fn a_rule_outside_its_range_is_reported_with_its_error() {
    let layer = |name: &str, rule: &str| {
        let flat = format!(
            "flat = \"steel\"\nlayer = {{ material = \"{name}\", thickness = \"50 nm\", rule = \"{rule}\" }}"
        );
        let warnings = compared(&flat).warnings().into_iter();
        warnings.filter(|warning| warning.contains("its modulus")).collect::<Vec<_>>()
    };
    let [gao] = &layer("lead", "gao")[..] else { panic!("one warning") };
    assert!(gao.contains("its modulus is 0.0857 times the substrate's") && gao.contains("0.5 to 2"), "{gao}");
    assert!(gao.contains("rule `gao` is up to 2.35 times too stiff"), "{gao}");
    let [series] = &layer("lead", "series")[..] else { panic!("one warning") };
    assert!(series.contains("`series` is up to 1.3") && series.contains("too compliant"), "{series}");
    assert_eq!(layer("titanium", "gao"), Vec::<String>::new());
}

/// The effective hardness is a rule in w/t: it is cautioned where contacts are wider than the layer is thick.
#[test]
fn contacts_that_are_wide_against_the_layer_are_cautioned() {
    let of = |thickness: &str| {
        let flat =
            format!("flat = \"steel\"\nlayer = {{ material = \"titanium\", thickness = \"{thickness}\" }}");
        compared(&flat).warnings()
    };
    let thin = of("50 nm");
    assert!(
        matches!(&thin[..], [one] if one.starts_with("layer titanium of 50 nm: contacts are up to ")),
        "{thin:?}"
    );
    assert_eq!(of("10 um"), Vec::<String>::new());
}

/// A single layer without effect: the threshold is found beyond the list.
#[test]
fn a_threshold_is_sought_beyond_the_list() {
    let of = |list: &str| {
        let flat = format!("flat = \"steel\"\nlayer = {{ material = \"lead\", thickness = {list} }}");
        let found = compared(&flat).surfaces.remove(0).thresholds;
        let found = found.into_iter().filter(|threshold| threshold.exceeded.is_none());
        found.map(|threshold| threshold.thickness).collect::<Vec<_>>()
    };
    let known = of("[0, 2e-8, 5e-8, \"inf\"]");
    for list in ["[0, \"1 nm\"]", "\"inf\"", "[\"1 um\", \"2 um\"]"] {
        assert_eq!(of(list).len(), 4, "2 laws, 2 models");
        for (found, known) in of(list).into_iter().zip(&known) {
            assert!((found.unwrap() / known.unwrap() - 1.0).abs() < 0.02, "{list}: {found:?} {known:?}");
        }
    }
    assert_eq!(of("0"), []);
}

/// A plastic film 20 times as hard as its substrate.
#[test]
fn a_decreasing_load_is_reported() {
    let flat = "flat = \"soft\"\nlayer = { material = \"film\", thickness = \"150 nm\" }";
    let found = compared(flat);
    let decreases = &found.surfaces[0].decreases;
    assert!(
        decreases.iter().any(|one| one.decrease.of == DecreasingQuantity::Load && one.decrease.loss() > 0.01),
        "{decreases:?}"
    );
    assert!(
        (&found as &dyn Outcome).outline().markdown().contains("Asperities whose area or load decreases")
    );
    let rows = table(&found, "decreases.csv").unwrap();
    let is_load = |row: &Row| row["layer_thickness_m"] == "1.5e-7" && row["of"] == "load";
    assert!(rows.iter().any(is_load), "{rows:?}");
}

#[test]
fn the_summary_holds_the_layer() {
    let outcome = results(LAYERS);
    let summary = outcome.records();
    assert_eq!(summary["layer"]["thicknesses_m"], serde_json::json!([0.0, 2e-8, 5e-8, "inf"]));
    assert_eq!(summary["layer"]["material"], "lead");
    assert_eq!(summary["layer"]["rule_errors"].as_array().unwrap().len(), 14);
    assert_eq!(table(&*outcome, "layer_thresholds.csv").unwrap().len(), 8);
    // PHYSICS: under 50 nm of lead the area of an asperity of 20 um decreases somewhere.
    let falls = typed(table(&*outcome, "decreases.csv").unwrap());
    assert!(falls.iter().any(|fall| fall["of"] == "area" && fall["layer_thickness_m"] == 50e-9), "{falls:?}");
    assert!(falls.iter().all(|fall| fall["of"] == "area"), "no load falls under lead");
}
