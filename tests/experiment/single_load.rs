//! One load or one separation: a table that answers in the units of the shop; and one thickness beside the uncoated flat.

use crate::Report;
use asperity_experiment::Experiment;
use asperity_framework::Outcome;
use asperity_framework::progress::Silent;

/// The outcome of `[compare]` with the keys `compare`, and what `check` prints.
fn run(compare: &str) -> (Box<dyn Outcome>, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.toml");
    let spec = concat!(
        "title = \"t\"\n",
        steel!(),
        lead!(),
        "[surface.a.population]\n",
        case_1!(),
        "count = 6000\n[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n"
    );
    std::fs::write(&path, format!("{spec}{compare}\n")).unwrap();
    let experiment = Experiment::read(&path).unwrap();
    (experiment.run(&Silent).unwrap(), experiment.to_string())
}

/// The cells of the row called `name` of the first table of results.
fn row(page: &str, name: &str) -> Vec<String> {
    let results = page.split("results at this").nth(1).unwrap();
    let line = results.lines().find(|line| line.starts_with(&format!("| {name} |"))).expect(name);
    line.trim_matches('|').split('|').skip(1).map(|cell| cell.trim().to_owned()).collect()
}

#[test]
fn one_load_is_answered_in_a_table_and_without_figures_of_a_point() {
    let page = run("force = { values = [\"0.5 N\"] }").0.outline();
    let names: Vec<String> = page.files(None).figures.into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["a-asperities.svg"]);
    let text = page.markdown();
    assert!(text.contains("## a: results at this load"));
    // 6000 asperities on 0.1 mm².
    assert_eq!(row(&text, "load"), ["0.5 N", "0.5 N", "0 %"].map(|cell| cell.replace("0.5 N", "500 mN")));
    assert_eq!(row(&text, "nominal pressure")[..2], ["5 MPa", "5 MPa"]);
    let number = |cell: &str| cell.split(' ').next().unwrap().replace(['+', ','], "").replace('−', "-");
    let value = |name: &str, column: usize| number(&row(&text, name)[column]).parse::<f64>().unwrap();
    for column in [0, 1] {
        // The mean contact pressure is the load over the real area, in GPa; sigma is 48 nm.
        let ratio =
            0.5e12 / value("real contact area", column) / 1e9 / value("mean contact pressure", column);
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
        let of_nominal = value("real contact area, of the nominal", column);
        assert!((of_nominal * 1e3 / value("real contact area", column) - 1.0).abs() < 0.01);
        let d =
            value("separation (from the mean asperity height)", column) / value("separation in σ", column);
        assert!((d / 48.0 - 1.0).abs() < 0.01, "{d}");
    }
    assert!(row(&text, "stiffness")[0].ends_with("N/µm"));
}

#[test]
fn one_separation_and_one_model_too_but_not_a_sweep() {
    let text = run("models = [\"deterministic\"]\nseparation = { values = [1.5] }").0.outline().markdown();
    assert!(text.contains("## a: results at this separation"));
    assert_eq!(row(&text, "separation in σ"), ["1.5 σ"]);
    // Nothing touches: no contact pressure.
    let text = run("separation = { values = [9] }").0.outline().markdown();
    assert_eq!(row(&text, "mean contact pressure")[1..], ["–", "–"]);
    let page = run("pressure = { values = [\"1 MPa\", \"2 MPa\"] }").0.outline();
    assert!(!page.markdown().contains("results at this"));
    assert!(page.files(None).figures.into_iter().any(|(name, _)| name == "a-area.svg"));
}

#[test]
fn one_thickness_is_shown_beside_the_uncoated_flat_and_a_list_stays() {
    let thicknesses = |spec: &str| {
        let layer = format!(
            "layer = {{ material = \"lead\", thickness = {spec} }}\nforce = {{ values = [\"0.05 N\"] }}"
        );
        let (outcome, check) = run(&layer);
        let summary = outcome.records();
        assert_eq!(check.contains("lead of 0, "), summary["layer"]["thicknesses_m"][0] == 0.0, "{check}");
        (summary["layer"]["thicknesses_m"].as_array().unwrap().len(), outcome.outline().markdown())
    };
    let (count, text) = thicknesses("\"50 nm\"");
    assert_eq!(count, 2);
    assert!(text.contains("on the uncoated flat: results at this load"), "{text}");
    assert!(text.contains("under 50 nm of lead: results at this load"));
    assert_eq!(thicknesses("[\"50 nm\"]").0, 1);
    assert_eq!(thicknesses("\"inf\"").0, 1);
    assert_eq!(thicknesses("[\"50 nm\", \"inf\"]").0, 2);
}
