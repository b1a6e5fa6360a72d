//! Sweeps: variations are the experiments that they name, what is kept of a run is not run again, and what is looked for is found.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::assert_message;
use crate::results::{self, Row, column, number, report, rows, run, succeeds};

const SPEC: &str = concat!(
    "title = \"Swept\"\nseed = 3\n\n",
    steel!(),
    lead!(),
    "\n[surface.a.population]\n",
    case_1!(),
    "count = 3000\nheights.johnson = { skewness = -1, kurtosis = 4.5 }\n\n",
    "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\npressure = [\"1 MPa\", \"3 MPa\", \"9 MPa\"]\n\n"
);

fn spec(sweep: &str) -> String {
    format!("{SPEC}[sweep]\n{sweep}\n")
}

fn table(text: &str, file: &str) -> Vec<Row> {
    results::table(&*run(text).unwrap(), file).unwrap_or_else(|| panic!("no {file}"))
}

fn error(text: &str) -> String {
    run(text).err().expect("an error")
}

#[test]
fn variations_are_the_experiments_that_they_name() {
    let swept =
        table(&spec("\"material.steel.hardness\" = [\"2 GPa\", \"4 GPa\"]\nseed = [3, 4]"), "sweep.csv");
    assert_eq!(swept.len(), 2 * 2 * 3);
    for (hardness, seed, variation) in
        [("2 GPa", 3, 1.0), ("2 GPa", 4, 2.0), ("4 GPa", 3, 3.0), ("4 GPa", 4, 4.0)]
    {
        let alone = SPEC.replace("7.6 GPa", hardness).replace("seed = 3", &format!("seed = {seed}"));
        let pairs: Vec<Row> =
            table(&alone, "comparison.csv").into_iter().filter(|row| row["pairing"] == "load").collect();
        let own: Vec<Row> =
            swept.iter().filter(|row| number(row, "variation") == variation).cloned().collect();
        for name in
            ["statistical_area_ratio", "deterministic_area_ratio", "deterministic_separation_over_sigma"]
        {
            assert_eq!(column(&own, name), column(&pairs, name), "{name}");
        }
        assert!(own.iter().all(|row| number(row, "seed") == f64::from(seed)));
        assert_eq!(number(&own[0], "material.steel.hardness"), if hardness == "2 GPa" { 2e9 } else { 4e9 });
        let differences = table(&alone, "differences.csv");
        for row in &own {
            let is_same =
                |other: &&Row| other["quantity"] == "area" && other["pressure_pa"] == row["pressure_pa"];
            let same = differences.iter().find(is_same).unwrap();
            assert_eq!(
                [&row["area_difference"], &row["area_low"], &row["area_verdict"]],
                [&same["difference"], &same["low"], &same["verdict"]]
            );
        }
    }
}

#[test]
fn zipped_keys_step_together_and_any_value_may_be_swept() {
    let zipped = "combine = \"zip\"\nseed = [3, 4, 5]\n\"material.steel.young\" = { from = \"100 GPa\", to = \"400 GPa\", points = 3 }";
    let swept = table(&spec(zipped), "sweep.csv");
    assert_eq!(column(&swept, "seed"), [3.0, 3.0, 3.0, 4.0, 4.0, 4.0, 5.0, 5.0, 5.0]);
    assert!((number(&swept[3], "material.steel.young") / 2e11 - 1.0).abs() < 1e-12);
    let laws = table(
        &spec(
            "compare.law = [\"hertz\", \"zmc\"]\nsurface.a.population.heights = [\"gaussian\", { johnson = { skewness = 1, kurtosis = 5 } }]",
        ),
        "sweep.csv",
    );
    assert_eq!(laws.len(), 12);
    assert_eq!(laws[11]["surface.a.population.heights"], "{ johnson = { skewness = 1, kurtosis = 5 } }");
}

/// Its table is the first of the kind.
#[test]
fn every_kind_can_be_swept() {
    let text = concat!(
        "title = \"t\"\n",
        steel!(),
        lead!(),
        "[indentation]\nradius = \"1 um\"\nball = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\nlayer = { material = \"lead\", thickness = \"1 nm\" }\nindentation = { from = \"1 nm\", to = \"10 nm\", points = 3 }\n",
        "[sweep]\n\"indentation.radius\" = [\"1 um\", \"4 um\"]\n"
    );
    let swept = table(text, "sweep.csv");
    let loads: Vec<f64> =
        swept.iter().filter(|row| row["curve"] == "uncoated").map(|row| number(row, "load_n")).collect();
    assert_eq!(loads.len(), 6);
    // Hertz's load grows with the square root of the radius.
    for k in 0..3 {
        assert!((loads[3 + k] / loads[k] - 2.0).abs() < 1e-12, "{loads:?}");
    }
}

#[test]
fn what_cannot_be_swept_says_why() {
    for sweep in [
        "",
        "title = [\"a\"]",
        "\"compare.law\" = \"zmc\"",
        "\"compare.low\" = [\"zmc\"]",
        "\"compare.law.zmc\" = [1]",
        "\"compare.pressure\" = []",
        "\"compare.pressure\" = { from = 0, to = 1, points = 3 }",
        "\"compare.pressure\" = { from = \"1 nm\", to = \"1 GPa\", points = 3 }",
        "\"compare.pressure\" = { from = \"1 Pa\", to = \"1 GPa\", points = 1 }",
        "\"compare.pressure\" = { from = \"1 Pa\", to = \"1 GPa\", points = 3, step = 1 }",
        "seed = { from = 1, to = 2, points = 101 }\n\"material.steel.poisson\" = { from = 0.1, to = 0.4, points = 100 }",
        "\"material.steel.poisson\" = [0.3, 0.7]",
        "combine = \"zip\"\nseed = [1, 2]\n\"compare.law\" = [\"zmc\"]",
        "combine = \"any\"\nseed = [1, 2]",
        "seed = [1, 2]\nfind = { key = \"compare.law\", verdict = \"area\", at = \"1 MPa\" }",
        "seed = [1, 2]\nfind = { key = \"seed\", at = \"1 MPa\" }",
        "seed = [1, 2]\nfind = { key = \"seed\", quantity = \"area\", ratio = 2, to = \"x\", at = \"1 MPa\" }",
        "seed = [1, 2]\nfind = { key = \"seed\", verdict = \"area\" }",
        "seed = [1, 2]\nfind = { key = \"seed\", verdict = \"aera\", at = \"1 MPa\" }",
        "seed = [1, 2]\nfind = { key = \"seed\", quantity = \"area\", value = 2, at = \"1 nm\" }",
    ] {
        assert_message(module_path!(), &format!("sweep {sweep}"), &error(&spec(sweep)));
    }
    let alone = format!("title = \"t\"\n{}[sweep]\nseed = [1]\n", steel!());
    assert!(error(&alone).contains("found no experiment"), "{}", error(&alone));
}

/// A load that one of the surfaces does not reach is a warning, the others have their results.
#[test]
fn a_variation_that_fails_does_not_stop_the_others() {
    let outcome = run(&spec("\"compare.pressure\" = [\"1 MPa\", \"900 GPa\"]")).unwrap();
    let warnings = outcome.warnings().join("\n");
    assert!(warnings.contains("variation 2 (compare.pressure = 900 GPa) could not be run"), "{warnings}");
    assert_eq!(results::table(&*outcome, "sweep.csv").unwrap().len(), 1);
    let message = error(&spec("\"compare.pressure\" = [\"800 GPa\", \"900 GPa\"]"));
    assert!(message.contains("no variation could be run"), "{message}");
}

fn law(text: String) -> String {
    text.replace("law = \"zmc\"", "law = \"hertz\"")
}

/// Hertz's area over the nominal one depends on p/E* alone: twice the modulus at twice the load is the same contact.
#[test]
fn the_value_of_a_key_is_found_where_a_quantity_is_a_given_one() {
    let young = "\"material.steel.young\" = [\"50 GPa\", \"200 GPa\", \"800 GPa\"]";
    let found = |what: &str| {
        let text = law(spec(&format!(
            "{young}\nfind = {{ key = \"material.steel.young\", at = \"2 MPa\", {what} }}"
        )));
        table(&text, "crossings.csv")
    };
    let at_one =
        law(SPEC.replace("210 GPa", "100 GPa").replace("[\"1 MPa\", \"3 MPa\", \"9 MPa\"]", "\"1 MPa\""));
    let pair = &table(&at_one, "comparison.csv")[0];
    for model in ["deterministic", "statistical"] {
        let area = number(pair, &format!("{model}_area_ratio"));
        let crossing = found(&format!("quantity = \"area\", value = {area}, model = \"{model}\""));
        assert_eq!(crossing.len(), 1);
        assert!((number(&crossing[0], "at") / 2e11 - 1.0).abs() < 1e-4, "{crossing:?}");
        assert!(number(&crossing[0], "low") <= 2e11 && 2e11 <= number(&crossing[0], "high"));
    }
    let ratio = found("quantity = \"separation\", ratio = 1, to = \"100 GPa\"");
    assert!((number(&ratio[0], "at") / 1e11 - 1.0).abs() < 1e-4, "{ratio:?}");
    assert!(found("quantity = \"area\", value = 1e-9").is_empty());
}

/// The share of a film in friction has a least value, so that the same friction is found twice.
#[test]
fn all_crossings_are_reported() {
    let text = spec(
        "\"compare.layer.thickness\" = { from = \"1 nm\", to = \"10 um\", points = 9 }\n\
         find = { key = \"compare.layer.thickness\", quantity = \"friction\", ratio = 0.8, to = \"uncoated\", at = \"3 MPa\" }",
    );
    let sheared = "law = \"zmc\"\nlayer = { material = \"lead\", thickness = \"1 nm\", shear-strength = { tau0 = \"33 MPa\" } }\nshear-strength = { tau0 = \"300 MPa\" }\n";
    let text = text.replace("law = \"zmc\"\n", sheared);
    let crossings = table(&text, "crossings.csv");
    let at = column(&crossings, "at");
    assert!(at.len() == 2 && at[0] < at[1], "{crossings:?}");
    let at_first = text.replace("thickness = \"1 nm\"", &format!("thickness = \"{:e} m\"", at[0]));
    let alone =
        at_first.split("[sweep]").next().unwrap().replace("[\"1 MPa\", \"3 MPa\", \"9 MPa\"]", "\"3 MPa\"");
    let friction: Vec<f64> = table(&alone, "results.csv")
        .iter()
        .filter(|row| row["model"] == "deterministic")
        .map(|row| number(row, "friction"))
        .collect();
    // The film breaks on one asperity after the other: the sum has steps.
    assert!((friction[1] / friction[0] / 0.8 - 1.0).abs() < 1e-2, "{friction:?}");
}

#[test]
fn a_change_of_verdict_is_found_where_there_is_one() {
    let found = |skewness: &str| {
        let text = spec(&format!(
            "\"surface.a.population.heights.johnson.skewness\" = [{skewness}]\n\
             find = {{ key = \"surface.a.population.heights.johnson.skewness\", verdict = \"separation\", at = \"3 MPa\" }}"
        ));
        let outcome = run(&text.replace("count = 3000", "count = 30_000")).unwrap();
        ["crossings.csv", "changes.csv"].map(|file| results::table(&*outcome, file).unwrap())
    };
    let [crossings, changes] = found("-1, 0");
    assert!(!crossings.is_empty(), "no change");
    let at = number(&crossings[0], "at");
    assert!(-1.0 < at && at < 0.0 && crossings[0]["target"].contains(" to "), "{crossings:?}");
    assert!(changes.iter().any(|row| row["quantity"] == "separation"));
    assert!(found("-1, -0.99").iter().all(Vec::is_empty));
}

/// What is kept of the variations of the spec `a.toml`.
fn kept(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder.join("out/.kept/a")).unwrap().map(|file| file.unwrap().path()).collect()
}

fn run_a(folder: &Path) {
    succeeds(&["run", "a.toml", "--out", "out", "--quiet"], folder);
}

/// A sweep without its report, of which one piece is not whole, as a kill may leave it, has the bytes of the whole run; another value runs that
/// value alone.
#[test]
fn what_is_kept_of_a_sweep_is_not_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = spec(
        "\"compare.layer.thickness\" = { from = \"1 nm\", to = \"1 um\", points = 4 }\n\"material.lead.hardness\" = [\"0.1 GPa\", \"0.4 GPa\"]\n\
         find = { key = \"compare.layer.thickness\", quantity = \"area\", ratio = 1.2, to = \"uncoated\", at = \"3 MPa\" }",
    );
    let text = text
        .replace("law = \"zmc\"\n", "law = \"zmc\"\nlayer = { material = \"lead\", thickness = \"1 nm\" }\n");
    fs::write(folder.join("a.toml"), &text).unwrap();
    run_a(folder);
    let whole = report(&folder.join("out/a"));
    assert!(whole.contains_key("crossings.csv"));
    fs::remove_dir_all(folder.join("out/a")).unwrap();
    let spoilt = &kept(folder)[0];
    fs::write(spoilt, "{\"csv\":").unwrap();
    let times = || kept(folder).into_iter().map(|file| (file.metadata().unwrap().modified().unwrap(), file));
    let before: Vec<_> = times().filter(|(_, file)| file != spoilt).collect();
    assert!(before.len() > 8);
    run_a(folder);
    assert!(report(&folder.join("out/a")) == whole);
    let longer = text.replace("\"0.4 GPa\"]", "\"0.4 GPa\", \"0.2 GPa\"]");
    fs::write(folder.join("a.toml"), longer).unwrap();
    run_a(folder);
    let after: Vec<_> = times().collect();
    assert!(after.len() > before.len() + 1 && before.iter().all(|piece| after.contains(piece)));
}

/// What is kept belongs to the content of the files that were read.
#[test]
fn another_list_under_the_same_name_is_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let list = |scale: f64| {
        let rows = (0..400).map(|k| format!("{:e},1e-5\n", scale * 1e-9 * f64::from(k % 37)));
        fs::write(folder.join("list.csv"), format!("height,radius\n{}", rows.collect::<String>())).unwrap();
    };
    let text = format!(
        "title = \"t\"\n{}[surface.a.asperities]\nfile = \"list.csv\"\nnominal-area = \"0.01 mm^2\"\n\
         [compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\npressure = \"9 MPa\"\n\
         [sweep]\n\"material.steel.young\" = [\"100 GPa\", \"200 GPa\"]\n",
        steel!()
    );
    fs::write(folder.join("a.toml"), text).unwrap();
    let areas = || {
        run_a(folder);
        column(&rows(&fs::read(folder.join("out/a/sweep.csv")).unwrap()), "deterministic_area_ratio")
    };
    list(1.0);
    let first = areas();
    list(3.0);
    let second = areas();
    assert!(first.len() == 2 && first.iter().zip(&second).all(|(a, b)| a != b), "{first:?} {second:?}");
    list(1.0);
    assert_eq!(areas(), first);
}

/// A failure may be one of the machine, which the next run does not have.
#[test]
fn a_failure_is_not_kept() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("a.toml"), spec("\"compare.pressure\" = [\"1 MPa\", \"900 GPa\", \"2 MPa\"]"))
        .unwrap();
    run_a(folder);
    assert_eq!(kept(folder).len(), 2);
}
