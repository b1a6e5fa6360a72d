//! One load or one separation: a table that answers in the units of the shop; and one thickness beside the uncoated flat.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;

use crate::Report;
use crate::results::{number, read, table};

/// The outcome of `[compare]` with the keys `compare`, and what `check` prints.
fn run(compare: &str) -> (Box<dyn Outcome>, String) {
    let folder = tempfile::tempdir().unwrap();
    let spec = concat!(
        "title = \"t\"\n",
        steel!(),
        lead!(),
        "[surface.a.population]\n",
        case_1!(),
        "count = 6000\n[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n"
    );
    let experiment = read(folder.path(), &format!("{spec}{compare}\n")).unwrap();
    (experiment.run(&Silent).unwrap(), experiment.to_string())
}

#[test]
fn one_load_is_answered_in_a_table_and_without_figures_of_a_point() {
    let outcome = run("force = { values = [\"0.5 N\"] }").0;
    let page = outcome.outline();
    let names: Vec<String> = page.files(None).figures.into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["a-asperities.svg"]);
    let text = page.markdown();
    let table_on_page =
        "| model | load (mN) | nominal area (mm²) | nominal pressure (MPa) | separation (nm) |";
    assert!(text.contains("## Results") && text.contains(table_on_page), "{text}");
    for row in table(&*outcome, "results.csv").unwrap() {
        // 6000 asperities on 0.1 mm².
        assert!(
            (number(&row, "force_n") - 0.5).abs() < 1e-9 && (number(&row, "pressure_pa") - 5e6).abs() < 1.0
        );
        let area = number(&row, "real_area_m2");
        assert!((0.5 / area / number(&row, "mean_real_pressure_pa") - 1.0).abs() < 1e-6);
        assert!((number(&row, "area_ratio") * 1e-7 / area - 1.0).abs() < 1e-9);
        let sigma = number(&row, "separation_m") / number(&row, "separation_over_sigma");
        assert!((sigma / 48e-9 - 1.0).abs() < 1e-9, "{sigma}");
        assert!(number(&row, "stiffness_n_per_m") > 0.0);
    }
}

#[test]
fn one_separation_and_one_model_too_and_the_middle_of_several_loads() {
    let outcome = run("models = [\"deterministic\"]\nseparation = { values = [1.5] }").0;
    let rows = table(&*outcome, "results.csv").unwrap();
    assert_eq!((rows.len(), number(&rows[0], "separation_over_sigma")), (1, 1.5));
    // Nothing touches: no contact pressure.
    let rows = table(&*run("separation = { values = [9] }").0, "results.csv").unwrap();
    assert!(rows[1]["mean_real_pressure_pa"].is_empty(), "{rows:?}");
    let outcome =
        run("pressure = { values = [\"5 MPa\", \"10 MPa\", \"20 MPa\"] }\nseparation = { values = [1, 2] }")
            .0;
    for row in table(&*outcome, "results.csv").unwrap() {
        assert!(
            (number(&row, "pressure_pa") - 1e7).abs() < 1.0,
            "the middle one of the prescribed loads: {row:?}"
        );
        let [low, area] = [number(&row, "real_area_low_m2"), number(&row, "real_area_m2")];
        // The integral of a population is exact.
        assert_eq!(low < (1.0 - 1e-9) * area, row["model"] == "deterministic", "{row:?}");
    }
    assert!(outcome.outline().files(None).figures.into_iter().any(|(name, _)| name == "a-models.svg"));
}

#[test]
fn one_thickness_is_shown_beside_the_uncoated_flat_and_a_list_stays() {
    let thicknesses = |spec: &str| {
        let layer = format!(
            "layer = {{ material = \"lead\", thickness = {spec} }}\nforce = {{ values = [\"0.05 N\"] }}"
        );
        let (outcome, check) = run(&layer);
        let summary = outcome.records();
        assert_eq!(check.contains("layer: 0, "), summary["layer"]["thicknesses_m"][0] == 0.0, "{check}");
        (summary["layer"]["thicknesses_m"].as_array().unwrap().len(), outcome.outline().markdown())
    };
    let (count, text) = thicknesses("\"50 nm\"");
    assert_eq!(count, 2);
    assert!(
        text.contains("| uncoated | statistical |") && text.contains("| 50 nm | statistical |"),
        "{text}"
    );
    assert_eq!(thicknesses("[\"50 nm\"]").0, 1);
    assert_eq!(thicknesses("\"inf\"").0, 1);
    assert_eq!(thicknesses("[\"50 nm\", \"inf\"]").0, 2);
}
