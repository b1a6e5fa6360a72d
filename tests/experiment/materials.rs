//! Materials of the library: the documentation, specs that take them, and the sources in a report.

use std::fs;

use asperity_contact_framework::folder as report_folder;
use asperity_contact_framework::report::store::Store;
use asperity_experiment::materials::{all_materials, one_material};

use crate::Report;
use crate::results::run_in;

const SPEC: &str = "title = \"t\"\n[material]\nball = { from = \"steel-100Cr6\", hardness = \"7 GPa\" }\n\
     disc = { from = \"bronze-CuSn8\" }\nother = { young = \"1 GPa\", poisson = 0.3 }\n\
     [compare]\nrough = \"ball\"\nflat = \"disc\"\nlaw = \"zmc\"\npressure = { values = [\"10 MPa\"] }\n\
     [surface.a.population]\nradius = \"20 um\"\nsigma = \"48 nm\"\ndensity = \"6e10 /m^2\"\ncount = 1000\n";

#[test]
fn the_documentation_lists_the_library() {
    assert!(
        fs::read_to_string("docs/materials.md").unwrap().trim_end() == all_materials().trim_end(),
        "docs/materials.md is not the library of this program. To renew it:\n\
         cargo run --release --bin experiment -- materials > docs/materials.md"
    );
    assert!(fs::read_to_string("README.md").unwrap().contains("docs/materials.md"));
}

#[test]
fn one_material_is_shown_with_its_sources_and_an_unknown_one_with_similar_names() {
    let bronze = one_material("bronze-cusn8").unwrap();
    assert!(bronze.contains("500 MPa") && bronze.contains("data sheet"), "{bronze}");
    assert!(one_material("bronze-CuSn9").unwrap_err().contains("bronze-CuSn8"));
}

#[test]
fn a_report_names_the_source_of_each_value_that_is_from_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let results = run_in(folder.path(), SPEC).unwrap();
    let origins = &results.metadata().origins;
    assert_eq!(origins.keys().collect::<Vec<_>>(), ["ball", "disc"]);
    let keys: Vec<&str> = origins["ball"].sources().iter().map(|(key, _)| *key).collect();
    assert_eq!(keys, ["young", "poisson"], "the hardness is that of the spec");
    assert!(results.outline().markdown().contains("`bronze-CuSn8` of the library"));
    Store::new(folder.path()).write(&report_folder(&*results, "key").unwrap()).unwrap();
    let summary = fs::read_to_string(folder.path().join("t/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let disc = &summary["materials_from_library"]["disc"];
    assert_eq!(disc["name"], "bronze-CuSn8");
    assert!(disc["sources"]["yield-strength"].as_str().unwrap().contains("RCI"), "{disc}");
    assert!(summary["materials_from_library"]["other"].is_null());
}
