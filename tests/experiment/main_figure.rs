//! What a page of `[compare]` is opened for.

use std::path::Path;

use asperity_contact_framework::Outcome;

use crate::Report;
use crate::results::{self, figure, number, table, write_map};

const LOADS: &str = "pressure = { from = \"1 MPa\", to = \"100 MPa\", points = 9 }\nrobustness = false\n";
const POPULATION: &str = concat!("[surface.a.population]\n", case_1!(), "count = 20000\n");
const MAP: &str = "[surface.m.file]\npath = \"m.npy\"\npixel = \"0.5 um\"\n";

/// The outcome of a comparison, beside a map of waves whose summits have different heights.
fn run(folder: &Path, compare: &str, surfaces: &str) -> Box<dyn Outcome> {
    write_map(folder.join("m.npy"), [200; 2], |i, j| {
        let [x, y] = [i, j].map(|at| at as f64);
        1e-7 * ((0.9 * x).sin() * (0.8 * y).cos()
            + 0.4 * (0.13 * x + 0.21 * y).sin()
            + 0.2 * (0.037 * x * y).sin())
    });
    let spec =
        concat!("title = \"t\"\n", steel!(), lead!(), "[compare]\nrough = \"steel\"\nflat = \"steel\"\n");
    results::run_in(folder, &format!("{spec}{compare}{LOADS}{surfaces}")).unwrap()
}

fn figures(outcome: &dyn Outcome) -> Vec<String> {
    outcome.outline().files(None).figures.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn one_case_has_its_curves_above_its_differences() {
    let folder = tempfile::tempdir().unwrap();
    let outcome = run(folder.path(), "law = \"zmc\"\n", POPULATION);
    let svg = figure(&*outcome, "a-models.svg").unwrap();
    for text in [
        "Real contact area",
        "difference in area (%)",
        "deterministic",
        "95 % interval",
        "accepted",
        "10 MPa",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    assert_eq!(figures(&*outcome)[0], "a-models.svg");
    assert!(
        figures(&*outcome).iter().all(|name| !name.contains("contact-map") && name != "a-separation.svg")
    );
    let several = run(folder.path(), "law = [\"zmc\", \"hertz\"]\n", POPULATION);
    assert_eq!(figures(&*several)[0], "verdicts.svg");
}

#[test]
fn a_measured_map_shows_the_contacts_of_the_sum_load_by_load() {
    let folder = tempfile::tempdir().unwrap();
    let outcome = run(folder.path(), "law = \"zmc\"\n", MAP);
    assert_eq!(figures(&*outcome)[..2], ["m-models.svg", "m-contact-map.svg"]);
    let svg = figure(&*outcome, "m-contact-map.svg").unwrap();
    let rows = table(&*outcome, "results.csv").unwrap();
    let sum = rows.iter().find(|row| row["model"] == "deterministic").unwrap();
    assert_eq!(svg.matches("<circle").count() as f64, number(sum, "contacts").round());
    let html = outcome.outline().html();
    let (_, data) = html.split_once("{\"panels\":[],\"frames\":").unwrap();
    let data: serde_json::Value =
        serde_json::Deserializer::from_str(data).into_iter().next().unwrap().unwrap();
    let counts: Vec<usize> =
        data["circles"][1].as_array().unwrap().iter().map(|radii| radii.as_array().unwrap().len()).collect();
    assert!(counts.len() > 2 && counts.is_sorted() && counts[0] < counts[counts.len() - 1], "{counts:?}");
    assert_eq!(counts.len(), data["names"].as_array().unwrap().len());
    let several = run(folder.path(), "law = [\"zmc\", \"hertz\"]\n", MAP);
    assert!(figure(&*several, "m-contact-map.svg").is_none());
}

#[test]
fn a_measured_map_shows_the_contacts_of_the_boundary_elements_where_they_were_run() {
    let folder = tempfile::tempdir().unwrap();
    let models = "models = [\"statistical\", \"deterministic\", \"reference\"]\nlaw = \"hertz\"\n";
    let outcome = run(folder.path(), &format!("{models}reference = {{ loads = 3 }}\n"), MAP);
    let svg = figure(&*outcome, "m-contact-map.svg").unwrap();
    assert!(svg.contains("in contact in the boundary elements") && !svg.contains("<circle"));
}

#[test]
fn a_spec_that_reproduces_a_figure_of_the_paper_shows_that_one() {
    let folder = tempfile::tempdir().unwrap();
    let outcome = run(folder.path(), "law = \"zmc\"\nfigure-of-paper = [4, 3]\n", POPULATION);
    assert_eq!(figures(&*outcome)[..2], ["figure-4-of-paper.svg", "figure-3-of-paper.svg"]);
    let svg = figure(&*outcome, "figure-4-of-paper.svg").unwrap();
    assert!(svg.contains("Fig. 4 of Pasaribu and Schipper (2005): separation against load"), "{svg}");
    assert!(svg.contains("load ratio") && svg.contains("separation d/σ"));
    let layer = "layer = { material = \"lead\", thickness = [0, \"100 nm\", \"inf\"] }\n";
    let outcome = run(folder.path(), &format!("law = \"zmc\"\n{layer}figure-of-paper = 6\n"), POPULATION);
    assert_eq!(figures(&*outcome)[0], "figure-6-of-paper.svg");
    assert!(figure(&*outcome, "a-layers.svg").is_none());
    let plain = run(folder.path(), &format!("law = \"zmc\"\n{layer}"), POPULATION);
    assert!(figure(&*plain, "a-layers.svg").is_some() && figure(&*plain, "figure-6-of-paper.svg").is_none());
}
