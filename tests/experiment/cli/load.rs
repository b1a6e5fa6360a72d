//! The load and the bodies that a user has: `nominal-area`, and the options of `surface FILE`.

use super::*;

/// A steel population at a load.
fn spec(load: &str) -> String {
    format!(
        "title = \"t\"\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\n{load}\n[surface.a.population]\n{}count = \
         3000\n",
        steel!(),
        case_1!()
    )
}

/// Rough heights (nm), a line for each y.
fn rough() -> String {
    let mut state = 7u64;
    let mut height = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        format!("{:.3}", (state >> 40) as f64 / 2e5)
    };
    (0..60).map(|_| (0..60).map(|_| height()).collect::<Vec<_>>().join(" ") + "\n").collect()
}

#[test]
fn a_force_acts_on_the_nominal_area_that_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let pressures = |name: &str, load: &str| {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, spec(load)).unwrap();
        let output = run(&path, &out, &[]);
        assert!(output.status.success(), "{}", text(&output.stderr));
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
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("map.txt"), rough()).unwrap();
    let warned = |load: &str| {
        let map = "[surface.a.file]\npath = \"map.txt\"\npixel = \"1 um\"\nunit = \"nm\"\n";
        let spec = spec(load).split("[surface").next().unwrap().to_owned() + map;
        fs::write(folder.path().join("map.toml"), spec).unwrap();
        let output = run(&folder.path().join("map.toml"), &folder.path().join("reports"), &["--force"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let said = warned("force = \"10 mN\"");
    let words = "surface a: 10 mN on the map's own 3360 µm²: 2.97 MPa; if the force acts on another area, write it, as in `nominal-area";
    assert!(said.contains(words), "{said}");
    assert!(!warned("force = \"10 mN\"\nnominal-area = \"1e-8 m^2\"").contains("own"));
    assert!(!warned("pressure = \"3 MPa\"").contains("own"));
}

#[test]
fn the_options_of_a_surface_and_the_spec_that_they_save_give_the_same_results() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("map.txt"), rough()).unwrap();
    let look = |more: &[&str]| {
        experiment(
            &[&["surface", "map.txt", "--pixel", "1 um", "--unit", "nm"], more].concat(),
            folder.path(),
        )
    };
    let output = look(&[
        "--load",
        "5 N",
        "--area",
        "4 mm2",
        "--rough",
        "bronze-CuSn8",
        "--flat",
        "steel-100Cr6",
        "--layer",
        "coating-DLC",
        "--thickness",
        "2 um",
        "--save-spec",
        "mine.toml",
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
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
    assert!(run(&folder.path().join("mine.toml"), &out, &[]).status.success());
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
    for (more, words) in [
        (&["--load", "5 N", "--pressure", "1 MPa"][..], "--load \"5 N\": found together with --pressure"),
        (&["--area", "4 mm2"], "--area \"4 mm2\": found without a load"),
        (&["--thickness", "2 um"], "--thickness \"2 um\": found without a layer"),
        (&["--layer", "coating-DLC"], "--layer \"coating-DLC\": found without its thickness"),
        (&["--load", "5 MPa"], "--load \"5 MPa\": found \"5 MPa\"; allowed: a positive finite force"),
        (
            &["--load", "5 N", "--area", "4 mm"],
            "--area \"4 mm\": found \"4 mm\"; allowed: a positive finite area",
        ),
        (&["--load", "5 N", "--area", "4"], "--area \"4\": found 4.0; write \"4 mm^2\" or \"4 cm^2\""),
        (&["--pressure", "0.5"], "--pressure \"0.5\": found 0.5; write \"500 kPa\" or \"500 MPa\""),
        (&["--rough", "bronze"], "--rough \"bronze\": found from = \"bronze\""),
        (&["--layer", "coating-DLC", "--thickness", "2"], "--thickness \"2\": found 2"),
        (&["--layer-on", "rough"], "--layer-on \"rough\": found without a layer"),
        (
            &["--layer", "coating-DLC", "--thickness", "2 um", "--layer-on", "ball"],
            "--layer-on \"ball\": found no body; allowed: \"flat\", \"rough\"",
        ),
        (
            &["--material", "a", "--rough", "b", "--flat", "c"],
            "--material \"a\": found together with --rough and --flat",
        ),
    ] {
        let output = look(more);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {said}");
        assert!(said.contains(words), "{more:?}: {said}");
    }
    let of_spec = experiment(&["surface", "mine.toml", "--load", "5 N"], folder.path());
    assert!(text(&of_spec.stderr).contains("other options only with a measured file"));
}

#[test]
fn a_layer_on_the_rough_body_is_named_in_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("map.txt"), rough()).unwrap();
    let look = |more: &[&str]| {
        let options = ["surface", "map.txt", "--pixel", "1 um", "--unit", "nm", "--pressure", "1 MPa"];
        experiment(&[&options, more].concat(), folder.path())
    };
    let layer = ["--layer", "coating-DLC", "--thickness", "20 nm", "--save-spec", "mine.toml"];
    let on_rough = look(&[&layer[..], &["--layer-on", "rough"]].concat());
    assert!(on_rough.status.success(), "{}", text(&on_rough.stderr));
    let said = text(&on_rough.stdout);
    for words in ["map, rough body uncoated\n", "map, 20 nm of coating-DLC on the rough body\n"] {
        assert!(said.contains(words), "{said}");
    }
    let saved = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let line = "layer = { material = \"coating-DLC\", thickness = \"20 nm\", on = \"rough\" }";
    assert!(saved.lines().any(|found| found == line), "{saved}");
    let said = text(&look(&[&layer[..4], &["--layer-on", "flat"]].concat()).stdout);
    assert!(said.contains("map, under 20 nm of coating-DLC\n"), "{said}");
}

#[test]
fn names_that_a_report_cannot_have_are_made_plain_or_refused_before_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = if cfg!(windows) { "map.txt" } else { "a: \"b\"?\t.txt" };
    fs::write(folder.path().join(file), rough()).unwrap();
    let look = |more: &[&str]| {
        experiment(&[&["surface", file, "--pixel", "1 um", "--unit", "nm"], more].concat(), folder.path())
    };
    let output = look(&[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let plain = if cfg!(windows) { "surface-map" } else { "surface-a- -b---" };
    assert!(folder.path().join("reports").join(plain).join("report.md").exists());
    let named = look(&["--name", "b:c"]);
    assert_eq!(named.status.code(), Some(2));
    assert!(text(&named.stderr).contains("--name: found the report name \"b:c\"; allowed: a name such as"));
    if cfg!(unix) {
        fs::write(folder.path().join("a: b.toml"), spec("separation = 2")).unwrap();
        let ran = experiment(&["run", "a: b.toml"], folder.path());
        assert_eq!(ran.status.code(), Some(2));
        assert!(text(&ran.stderr).contains("rename it, for example to a- b.toml"), "{}", text(&ran.stderr));
    }
}

#[test]
fn surfaces_that_overlap_completely_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let report = |separation: &str| {
        let path = folder.path().join("deep.toml");
        fs::write(&path, spec(&format!("separation = {separation}"))).unwrap();
        let output = run(&path, &folder.path().join("reports"), &["--force"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        (text(&output.stderr), fs::read_to_string(folder.path().join("reports/deep/report.md")).unwrap())
    };
    let (said, page) = report("-20");
    assert!(said.contains("from d = -20 σ down the surfaces overlap completely"), "{said}");
    assert!(!page.contains("in contact at none"), "{page}");
    let (said, page) = report("12");
    assert!(
        !said.contains("overlap") && page.contains("in contact at none of the separations"),
        "{said} {page}"
    );
}

/// A run that takes long is interrupted: one line, exit code 130, no report.
#[cfg(unix)]
#[test]
fn an_interrupted_run_says_so_and_leaves_no_report() {
    let folder = tempfile::tempdir().unwrap();
    let long = spec("pressure = \"1 MPa\"").replace("count = 3000", "count = 1000000\nrealisations = 1000");
    fs::write(folder.path().join("long.toml"), long).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_experiment"))
        .args(["run", "long.toml"])
        .current_dir(folder.path())
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(2));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    assert!(text(&output.stderr).ends_with("interrupted; nothing was written\n"), "{}", text(&output.stderr));
    assert!(!folder.path().join("reports/long").exists());
}
