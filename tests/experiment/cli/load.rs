//! The load and the bodies that a user has: `nominal-area`, and the options of `surface FILE`.

use super::*;

/// Steel at a load, without surfaces.
fn spec(load: &str) -> String {
    let contact = "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\n";
    format!("title = \"t\"\n{}{contact}{load}\n", steel!())
}

/// A folder with rough heights.
fn measured() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("map.txt"), rough([60; 2], 0.0)).unwrap();
    folder
}

#[test]
fn a_force_acts_on_the_nominal_area_that_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let pressures = |name: &str, load: &str| {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, spec(load) + &results::population("a", 3000, "")).unwrap();
        run(&path, &out, &[]);
        let checked = text(&experiment(&["check", path.to_str().unwrap()], folder.path()).stdout);
        (checked, rows(&out, name, "curves.csv"))
    };
    let (checked, on_area) = pressures("area", "force = \"5 N\"\nnominal-area = \"4 mm2\"");
    assert!(checked.contains("  load: 5 N on 4 mm² (nominal-area): 1.25 MPa\n"), "{checked}");
    let (checked, at_pressure) = pressures("pressure", "pressure = \"1.25 MPa\"\nnominal-area = \"4 mm2\"");
    assert!(checked.contains("  load: 5 N on 4 mm² (nominal-area): 1.25 MPa\n"), "{checked}");
    assert_eq!(on_area.len(), 2);
    for (a, b) in on_area.iter().zip(&at_pressure) {
        assert_eq!([&a["control"], &b["control"]], ["force", "pressure"]);
        assert_eq!([&a["pressure_pa"], &a["area_ratio"]], [&b["pressure_pa"], &b["area_ratio"]]);
    }
    // 3000 asperities at 6e10 /m².
    let (checked, _) = pressures("own", "force = { from = \"50 mN\", to = \"500 mN\", points = 3 }");
    assert!(
        checked.contains("  load: 50 mN to 500 mN on 50000 µm² (surface a): 1 MPa to 10 MPa, 3 loads\n"),
        "{checked}"
    );
}

#[test]
fn a_force_on_the_area_of_a_measured_map_is_cautioned() {
    let folder = measured();
    let warned = |load: &str| {
        let map = "[surface.a.file]\npath = \"map.txt\"\npixel = \"1 um\"\nunit = \"nm\"\n";
        fs::write(folder.path().join("map.toml"), spec(load) + map).unwrap();
        text(&run(&folder.path().join("map.toml"), &folder.path().join("reports"), &["--force"]).stderr)
    };
    let said = warned("force = \"10 mN\"");
    let words = "surface a: 10 mN on the map's own 3360 µm²: 2.97 MPa; if the force acts on another area, write it, as in `nominal-area";
    assert!(said.contains(words), "{said}");
    assert!(!warned("force = \"10 mN\"\nnominal-area = \"1e-8 m^2\"").contains("own"));
    assert!(!warned("pressure = \"3 MPa\"").contains("own"));
}

#[test]
fn the_options_of_a_surface_and_the_spec_that_they_save_give_the_same_results() {
    let folder = measured();
    let bodies = ["--rough", "bronze-CuSn8", "--flat", "steel-100Cr6"];
    let layer = ["--layer", "coating-DLC", "--thickness", "2 um"];
    let load = ["--load", "5 N", "--area", "4 mm2", "--save-spec", "mine.toml"];
    let output = succeeds(&[&MAP[..], &bodies, &layer, &load].concat(), folder.path());
    assert!(!text(&output.stderr).contains("the map's own"), "{}", text(&output.stderr));
    let saved = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    for line in [
        "rough = \"bronze-CuSn8\"",
        "flat = \"steel-100Cr6\"",
        "layer = { material = \"coating-DLC\", thickness = \"2 um\" }",
        "force = \"5 N\"",
        "nominal-area = \"4 mm2\"",
    ] {
        assert!(saved.lines().any(|found| found == line), "{line}: {saved}");
    }
    let out = folder.path().join("reports");
    run(&folder.path().join("mine.toml"), &out, &[]);
    for table in ["curves.csv", "comparison.csv", "verdicts.csv"] {
        let [described, ran] =
            ["surface-map", "mine"].map(|stem| fs::read_to_string(out.join(stem).join(table)).unwrap());
        assert_eq!(described, ran, "{table}");
    }
    let curves = rows(&out, "mine", "curves.csv");
    let at_load: Vec<_> = curves.iter().filter(|row| row["control"] == "force").collect();
    // Both models, uncoated and under the layer.
    assert_eq!(at_load.len(), 4);
    for row in at_load {
        assert_eq!(row["target"], "5.0");
        assert!((number(row, "pressure_pa") / 1.25e6 - 1.0).abs() < 1e-6, "{row:?}");
    }
    let said = refused(&["surface", "mine.toml", "--load", "5 N"], folder.path());
    assert!(said.contains("other options only with a measured file"), "{said}");
}

#[test]
fn loads_and_bodies_that_cannot_be_meant_are_refused() {
    let folder = measured();
    for more in [
        &["--load", "5 N", "--pressure", "1 MPa"][..],
        &["--area", "4 mm2"],
        &["--thickness", "2 um"],
        &["--layer", "coating-DLC"],
        &["--load", "5 MPa"],
        &["--load", "5 N", "--area", "4 mm"],
        &["--load", "5 N", "--area", "4"],
        &["--pressure", "0.5"],
        &["--rough", "bronze"],
        &["--layer", "coating-DLC", "--thickness", "2"],
        &["--layer-on", "rough"],
        &["--layer", "coating-DLC", "--thickness", "2 um", "--layer-on", "ball"],
        &["--material", "a", "--rough", "b", "--flat", "c"],
    ] {
        let said = refused(&[&MAP[..], more].concat(), folder.path());
        assert_message(module_path!(), &more.join(" "), &said);
    }
}

#[test]
fn a_layer_on_the_rough_body_is_named_in_the_terminal() {
    let folder = measured();
    let layer = ["--pressure", "1 MPa", "--layer", "coating-DLC", "--thickness", "20 nm"];
    let said = |more: &[&str]| text(&succeeds(&[&MAP[..], &layer, more].concat(), folder.path()).stdout);
    let on_rough = said(&["--layer-on", "rough", "--save-spec", "mine.toml"]);
    for words in ["map, rough body uncoated\n", "map, 20 nm of coating-DLC on the rough body\n"] {
        assert!(on_rough.contains(words), "{on_rough}");
    }
    let saved = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let line = "layer = { material = \"coating-DLC\", thickness = \"20 nm\", on = \"rough\" }";
    assert!(saved.lines().any(|found| found == line), "{saved}");
    assert!(said(&["--layer-on", "flat"]).contains("map, under 20 nm of coating-DLC\n"));
}

#[test]
fn names_that_a_report_cannot_have_are_made_plain_or_refused_before_a_run() {
    let folder = measured();
    let file = if cfg!(windows) { "map.txt" } else { "a: \"b\"?\t.txt" };
    fs::rename(folder.path().join("map.txt"), folder.path().join(file)).unwrap();
    succeeds(&["surface", file, "--pixel", "1 um", "--unit", "nm"], folder.path());
    let plain = if cfg!(windows) { "surface-map" } else { "surface-a- -b---" };
    assert!(folder.path().join("reports").join(plain).join("report.md").exists());
    if cfg!(unix) {
        fs::write(folder.path().join("a: b.toml"), spec("separation = 2") + &results::population("a", 9, ""))
            .unwrap();
        let said = refused(&["run", "a: b.toml"], folder.path());
        assert!(said.contains("rename it, for example to a- b.toml"), "{said}");
    }
}
