//! `on = "rough"` of a layer: both models and the reference, from a spec to the page.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

use crate::Report;
use crate::results::{self, Row, table};

/// Rough steel and a flat, with a layer of lead by its other keys.
fn spec(rough: &str, flat: &str, layer: &str) -> String {
    format!(
        r#"title = "t"
{}{}[material.titanium]
young = "120 GPa"
poisson = 0.33
hardness = "3 GPa"
[compare]
rough = "{rough}"
flat = "{flat}"
law = ["hertz", "zmc"]
models = ["statistical", "deterministic", "reference"]
layer = {{ material = "lead", {layer} }}
pressure = ["5 MPa", "20 MPa"]
{}"#,
        steel!(),
        lead!(),
        generated!("a", 64, "1 um", "100 nm", "40 um" to "8 um")
    )
}

fn experiment(words: &str) -> Experiment {
    results::read(tempfile::tempdir().unwrap().path(), words).unwrap()
}

fn run(rough: &str, flat: &str, layer: &str) -> Box<dyn Outcome> {
    results::run(&spec(rough, flat, layer)).unwrap()
}

/// The rows of the curves of sum, integral and reference, every digit of them.
fn curves(outcome: &dyn Outcome) -> Vec<Row> {
    table(outcome, "curves.csv").unwrap()
}

const LAYER: &str = "thickness = [0, \"200 nm\", \"inf\"]";

#[test]
fn on_bodies_of_one_material_it_makes_no_difference_which_is_coated() {
    let [rough, flat] =
        ["rough", "flat"].map(|on| curves(&*run("steel", "steel", &format!("{LAYER}, on = \"{on}\""))));
    // Two laws of three models at three thicknesses and two loads.
    assert!(rough.len() >= 30, "{}", rough.len());
    assert_eq!(rough, flat);
    assert_eq!(flat, curves(&*run("steel", "steel", LAYER)));
}

#[test]
fn exchanging_the_bodies_and_the_layer_changes_nothing() {
    let on_rough = curves(&*run("steel", "titanium", &format!("{LAYER}, on = \"rough\"")));
    assert_eq!(on_rough, curves(&*run("titanium", "steel", LAYER)));
    assert_ne!(on_rough, curves(&*run("steel", "titanium", LAYER)));
}

#[test]
fn check_page_and_summary_name_the_body_and_the_limits() {
    let layer = "thickness = \"200 nm\", on = \"rough\"";
    let words = spec("steel", "titanium", layer);
    let checked = experiment(&words).to_string();
    assert!(checked.contains("  layer: 0, 200 nm of lead on the rough body, rule gao\n"), "{checked}");
    let found = experiment(&words).run(&Silent).unwrap();
    let page = found.outline().markdown();
    assert!(page.contains("200 nm of lead on the rough body"), "{page}");
    assert!(page.contains("Layer of lead on the rough body: "), "{page}");
    assert!(page.contains("A coated asperity is taken as a layered half-space"), "{page}");
    let warning = "layer lead of 200 nm on the rough body, surface a: it is ";
    let warnings = found.warnings();
    // Thicker than Sq, thin for its asperities.
    let limits: Vec<&String> = warnings.iter().filter(|line| line.starts_with(warning)).collect();
    assert!(matches!(&limits[..], [one] if one.contains("times as thick as Sq")), "{warnings:?}");
    let thick = run("steel", "titanium", "thickness = \"20 um\", on = \"rough\"").warnings();
    assert!(thick.iter().any(|line| line.contains("times as thick as the mean radius")), "{thick:?}");
    let on_flat = run("steel", "titanium", "thickness = \"20 um\"").warnings();
    assert!(!on_flat.iter().any(|line| line.contains("on the rough body")), "{on_flat:?}");
}
