//! The program as a user meets it: exit codes, messages, what is written and what is left alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use asperity_contact_framework::report::format;

use crate::common::assert_message;
use crate::results::{self, Row, experiment, number, succeeds};

mod every_input;
mod export;
mod heights;
mod input;
mod laws;
mod load;
mod reach;
mod realisations;
mod surface;

/// Runs a spec into a folder of reports.
fn run(spec: &Path, out: &Path, more: &[&str]) -> Output {
    let arguments = ["run", spec.to_str().unwrap(), "--out", out.to_str().unwrap()];
    succeeds(&[&arguments, more].concat(), out.parent().unwrap())
}

/// The error message of a command that must fail with exit code 2.
fn refused(arguments: &[&str], folder: &Path) -> String {
    let output = experiment(arguments, folder);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    said
}

/// A map in nm as text, and what describes it.
const MAP: [&str; 6] = ["surface", "map.txt", "--pixel", "1 um", "--unit", "nm"];

/// Rough heights (nm) from `offset` up, a line for each y.
fn rough([nx, ny]: [usize; 2], offset: f64) -> String {
    let mut state = 1u64;
    let mut height = |_| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        format!("{:.3}", offset + (state >> 40) as f64 / 2e5)
    };
    (0..ny).map(|_| (0..nx).map(&mut height).collect::<Vec<_>>().join(" ") + "\n").collect()
}

/// The rows of a table of a report.
fn rows(out: &Path, stem: &str, table: &str) -> Vec<Row> {
    results::rows(&fs::read(out.join(stem).join(table)).unwrap())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn an_export_makes_its_folder_and_refuses_a_file_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    population(folder.path(), "joint", "", "[\"2 MPa\", \"4 MPa\"]", 20_000);
    let export = ["export", "interface", "joint.toml", "--out"];
    succeeds(&[&export[..], &["tables/new"]].concat(), folder.path());
    assert!(folder.path().join("tables/new/joint.csv").is_file());
    let said = refused(&[&export[..], &["joint.toml"]].concat(), folder.path());
    assert!(said.contains("--out joint.toml: "), "{said}");
}

#[test]
fn a_new_spec_runs_unchanged_and_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    succeeds(&["new", "mine"], folder.path());
    let output = succeeds(&["run", "mine.toml"], folder.path());
    assert!(text(&output.stdout).starts_with("reports/mine written: "));
    for file in ["report.md", "report.html", "curves.csv", "comparison.csv", "summary.json", "timing.json"] {
        assert!(folder.path().join("reports/mine").join(file).is_file(), "{file}");
    }
    for page in ["README.md", "index.html"] {
        assert!(
            fs::read_to_string(folder.path().join("reports").join(page)).unwrap().contains("mine/report")
        );
    }
    refused(&["new", "mine"], folder.path());
}

const SMALL: &str = concat!(
    r#"
title = "small"
"#,
    steel!(),
    r#"[compare]
rough = "steel"
flat = "steel"
law = ["hertz", { zmc = { onset = 0.89, transition-ratio = 110 } }]
separation = { values = [3, 0] }
pressure = { values = ["1 MPa"] }
force = { values = ["1 mN"] }
[surface.list.asperities]
file = "list.csv"
nominal-area = "1e-8 m^2"
[surface.drawn.population]
"#,
    case_1!(),
    r#"count = 2000
"#
);

/// A folder with a small spec that reads a file.
fn small() -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("small.toml");
    fs::write(&spec, SMALL).unwrap();
    let rows: String = (0..500).map(|i| format!("{:e},{:e}\n", f64::from(i % 97) * 1e-9, 1e-6)).collect();
    fs::write(folder.path().join("list.csv"), format!("# made\nheight, radius\n{rows}")).unwrap();
    let out = folder.path().join("reports");
    (folder, spec, out)
}

#[test]
fn an_unchanged_experiment_is_not_run_again() {
    let (folder, spec, out) = small();
    let said = |more: &[&str]| text(&run(&spec, &out, more).stdout);
    let times = || {
        let files = fs::read_dir(out.join("small")).unwrap().chain(fs::read_dir(&out).unwrap());
        let mut times: Vec<_> = files
            .map(|entry| {
                let entry = entry.unwrap();
                (entry.path(), entry.metadata().unwrap().modified().unwrap())
            })
            .collect();
        times.sort();
        times
    };
    assert!(said(&[]).contains("written"));
    let before = times();
    assert!(before.len() > 8);
    let unchanged = said(&[]);
    assert!(unchanged.contains("is unchanged") && !unchanged.contains("written"), "{unchanged}");
    assert_eq!(times(), before);
    assert!(said(&["--force"]).contains("written"));
    assert!(times() != before);
    assert!(said(&[]).contains("unchanged"));

    fs::write(out.join("small/curves.csv"), "spoilt").unwrap();
    assert!(said(&[]).contains("written"));
    fs::remove_file(out.join("small/report.html")).unwrap();
    assert!(said(&[]).contains("written"));
    let list = folder.path().join("list.csv");
    fs::write(&list, fs::read_to_string(&list).unwrap() + "1e-9,1e-6\n").unwrap();
    assert!(said(&[]).contains("written"));
    fs::write(&spec, SMALL.replace("\"small\"", "\"other\"")).unwrap();
    assert!(said(&[]).contains("written"));
    assert!(said(&[]).contains("unchanged"));
}

#[test]
fn the_tables_have_the_rows_of_the_contract() {
    let (_folder, spec, out) = small();
    assert!(run(&spec, &out, &["--silent"]).stdout.is_empty());
    let curves = rows(&out, "small", "curves.csv");
    // 2 surfaces, 2 laws, 2 models, 4 control points.
    assert_eq!(curves.len(), 2 * 2 * 2 * 4);
    for row in &curves {
        assert!(!row.values().any(|cell| cell.contains("NaN") || cell.contains("inf")), "{row:?}");
        if row["control"] == "pressure" {
            assert!((number(row, "pressure_pa") / 1e6 - 1.0).abs() < 2e-3);
        }
        assert_eq!(row["pressure_standard_error_pa"].is_empty(), row["model"] == "statistical");
        assert_eq!(number(row, "area_ratio") > 0.05, row["beyond_model"] == "true");
    }
    assert_eq!(curves[4]["law"], "hertz");
    assert_eq!(curves[8]["law"], "zmc(onset=0.89 transition-ratio=110)");

    let pairs = rows(&out, "small", "comparison.csv");
    for pairs in pairs.chunk_by(|a, b| a["surface"] == b["surface"] && a["law"] == b["law"]) {
        // Two separations, one pressure, one force, and the two separations' pressures unless zero.
        let at = |pairing: &str| pairs.iter().filter(|row| row["pairing"] == pairing).collect::<Vec<_>>();
        assert_eq!(at("separation").len(), 2);
        assert!((3..=4).contains(&at("load").len()));
        let area = if pairs[0]["surface"] == "list" { 1e-8 } else { 2000.0 / 6e10 };
        let [pressure, force] = [0, 1].map(|place| number(at("load")[place], "target"));
        assert!((pressure / 1e6 - 1.0).abs() < 1e-14 && (force / (1e-3 / area) - 1.0).abs() < 1e-14);
        for row in pairs {
            let [s, d] =
                ["statistical", "deterministic"].map(|model| number(row, &format!("{model}_area_ratio")));
            assert_eq!(number(row, "difference_area_ratio"), s - d);
            if row["pairing"] == "load" {
                assert!(number(row, "statistical_pressure_pa") >= number(row, "target"));
                assert!(number(row, "deterministic_pressure_pa") >= number(row, "target"));
            }
        }
    }
}

#[test]
fn what_no_run_wrote_is_not_destroyed() {
    let (_folder, spec, out) = small();
    fs::create_dir_all(out.join("small")).unwrap();
    fs::write(out.join("small/thesis.txt"), "years of work").unwrap();
    let output = experiment(&["run", spec.to_str().unwrap(), "--force"], out.parent().unwrap());
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("thesis.txt"), "{}", text(&output.stderr));
    assert_eq!(fs::read_to_string(out.join("small/thesis.txt")).unwrap(), "years of work");
}

#[test]
fn a_report_is_the_same_on_any_number_of_threads() {
    let (folder, spec, _) = small();
    let large = SMALL.replace("count = 2000", "count = 20000").replace("[\"1 MPa\"]", "[\"10 MPa\"]");
    fs::write(&spec, large).unwrap();
    let [one, two, five] = ["1", "2", "5"].map(|threads| {
        let out = folder.path().join(threads);
        run(&spec, &out, &["--threads", threads]);
        results::report(&out.join("small"))
    });
    assert!(one.contains_key("attribution.csv") && one == two && one == five);
}

#[test]
fn two_files_of_one_stem_are_refused() {
    let (folder, spec, out) = small();
    let other = folder.path().join("other");
    fs::create_dir(&other).unwrap();
    let twin = other.join("small.toml");
    fs::copy(&spec, &twin).unwrap();
    let said = refused(&["run", spec.to_str().unwrap(), twin.to_str().unwrap()], folder.path());
    assert!(said.contains("small") && !out.exists(), "{said}");
}

#[test]
fn check_runs_nothing_and_list_says_what_is_up_to_date() {
    let (folder, spec, out) = small();
    let output = succeeds(&["check", spec.to_str().unwrap()], folder.path());
    for words in ["small", "zmc(onset=0.89", "2000 asperities", "memory"] {
        assert!(text(&output.stdout).contains(words), "{words}: {}", text(&output.stdout));
    }
    assert!(!out.exists());

    let specs = folder.path().join("experiments");
    fs::create_dir(&specs).unwrap();
    for file in ["small.toml", "list.csv"] {
        fs::copy(folder.path().join(file), specs.join(file)).unwrap();
    }
    let listed = || text(&experiment(&["list"], folder.path()).stdout);
    assert!(listed().contains("to run"));
    // Without a command, all of experiments/ is run.
    succeeds(&[], folder.path());
    assert!(out.join("small/report.md").is_file());
    assert!(listed().contains("up to date"));
    // So is a report that came with a clone, until its spec or one of its files changes.
    fs::remove_file(out.join("small/manifest.json")).unwrap();
    assert!(listed().contains("up to date"));
    let list = specs.join("list.csv");
    fs::write(&list, fs::read_to_string(&list).unwrap() + "\n").unwrap();
    assert!(listed().contains("input changed"));
}

/// A spec of one population; `keys` are common keys, more asperities are more work.
fn population(folder: &Path, name: &str, keys: &str, pressure: &str, count: usize) {
    let spec = format!(
        "title = \"{name}\"\n{keys}\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\n\
         pressure = {pressure}\n{}",
        steel!(),
        results::population("a", count, "")
    );
    fs::write(folder.join(format!("{name}.toml")), spec).unwrap();
}

#[test]
fn of_several_specs_the_quick_ones_run_first_and_three_lines_end_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let specs = folder.path().join("experiments");
    fs::create_dir(&specs).unwrap();
    population(&specs, "a-large", "", "\"1 MPa\"", 50_000);
    population(&specs, "b-small", "group = \"laws\"", "\"1 MPa\"", 500);
    population(&specs, "c-long", "run = \"long\"", "\"1 MPa\"", 500);
    let said = |arguments: &[&str]| text(&experiment(arguments, folder.path()).stdout);
    let listed = |name: &str| said(&["list"]).lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(listed("c-long").contains("long, not run here") && listed("a-large").contains("to run"));

    let output = said(&[]);
    let lines: Vec<&str> = output.lines().collect();
    assert_eq!(lines.len(), 5, "{output}");
    assert!(lines[0].starts_with("1 of 2: reports/b-small written"), "{output}");
    assert!(lines[1].starts_with("2 of 2: reports/a-large written"), "{output}");
    assert_eq!(lines[2], "2 reports: 2 written, 0 unchanged, 0 failed");
    assert!(lines[4].ends_with("reports/index.html"));
    // What the last run took counts more than an estimate.
    let timing = folder.path().join("reports/b-small/timing.json");
    fs::write(&timing, r#"{ "total_s": 1e3 }"#).unwrap();
    let output = said(&["--force"]);
    assert!(output.starts_with("1 of 2: reports/a-large"), "{output}");

    let output = said(&["--full"]);
    assert!(output.contains("3 of 3: reports/c-long written"), "{output}");
    assert!(output.contains("3 reports: 1 written, 2 unchanged, 0 failed"), "{output}");
    assert!(listed("c-long").contains("up to date      long, 0 s"), "{}", listed("c-long"));
    let summary = folder.path().join("reports/c-long/summary.json");
    let other =
        fs::read_to_string(&summary).unwrap().replacen("library_sha256\":\"", "library_sha256\":\"0", 1);
    fs::write(&summary, other).unwrap();
    assert!(listed("c-long").contains("edited"));
    fs::remove_file(folder.path().join("reports/c-long/manifest.json")).unwrap();
    assert!(listed("c-long").contains("older library"), "{}", listed("c-long"));
    let index = fs::read_to_string(folder.path().join("reports/index.html")).unwrap();
    let place = |text: &str| index.find(text).unwrap_or_else(|| panic!("no {text}"));
    assert!(place("Your surfaces</h2>") < place("a-large/report.html"));
    assert!(
        place("a-large/report.html") < place("Laws</h2>")
            && place("Laws</h2>") < place("b-small/report.html")
    );
    assert!(!index.contains("Reality check</h2>"));
}

#[test]
fn an_edited_report_is_kept_with_a_warning() {
    let (_folder, spec, out) = small();
    run(&spec, &out, &[]);
    let report = out.join("small/report.md");
    fs::write(&report, "my remarks").unwrap();
    let output = run(&spec, &out, &["--quiet"]);
    let message = text(&output.stderr);
    assert!(message.contains("small/report.md.bak") && message.contains("edited"), "{message}");
    assert_eq!(fs::read_to_string(out.join("small/report.md.bak")).unwrap(), "my remarks");
    assert!(fs::read_to_string(&report).unwrap().len() > 100);
    // The kept file is in the way of nothing, and of no further warning.
    let again = run(&spec, &out, &["--force"]);
    assert!(!text(&again.stderr).contains("edited"), "{}", text(&again.stderr));
    assert!(out.join("small/report.md.bak").is_file());
}

#[test]
fn help_reaches_shells_and_editors() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = text(&experiment(&["completions", shell], folder.path()).stdout);
        assert!(script.contains("save-spec"), "{shell}: {script}");
    }
    for (arguments, instead) in [
        (&["columns"][..], "explain curves.csv"),
        (&["keys"], "experiment schema"),
        (&["man"], "--help"),
        (&["merge", "a.toml"], "asperity.distributed.sweep"),
        (&["run", "a.toml", "--part", "1/2"], "asperity.distributed.sweep"),
        (&["explain", "thicknes"], "thickness"),
    ] {
        let said = refused(arguments, folder.path());
        assert!(said.contains(instead), "{said}");
    }
    let schema = text(&experiment(&["schema"], folder.path()).stdout);
    assert!(serde_json::from_str::<serde_json::Value>(&schema).is_ok());
}

#[test]
fn verify_finds_a_report_that_no_longer_matches() {
    let (folder, spec, out) = small();
    let fresh = folder.path().join("fresh");
    run(&spec, &out, &[]);
    run(&spec, &fresh, &[]);
    let verify = || experiment(&["verify", "fresh", "--out", "reports"], folder.path());
    assert!(verify().status.success(), "{}", text(&verify().stderr));
    let table = out.join("small/verdicts.csv");
    let changed = fs::read_to_string(&table).unwrap().replacen("hertz", "hurtz", 1);
    fs::write(&table, changed).unwrap();
    assert_eq!(verify().status.code(), Some(1));
    assert!(text(&verify().stderr).contains("small/verdicts.csv, line 2, law"), "{}", text(&verify().stderr));
}

fn summary(out: &Path, stem: &str) -> serde_json::Value {
    serde_json::from_slice(&fs::read(out.join(stem).join("summary.json")).unwrap()).unwrap()
}

/// The cells of the first row of a report that begins with these words.
fn row(report: &str, name: &str) -> Vec<String> {
    let line = report.lines().find(|line| line.starts_with(&format!("| {name} |")));
    let line = line.unwrap_or_else(|| panic!("no row {name}"));
    line.trim_matches(['|', ' ']).split(" | ").map(|cell| cell.trim().to_owned()).collect()
}

fn close(found: f64, exact: f64, within: f64) {
    assert!((found / exact - 1.0).abs() < within, "{found} for {exact}");
}

/// A draw depends on the seed and on the surface's own name, not on the rest of the spec.
#[test]
fn each_surface_has_random_numbers_of_its_own() {
    let (folder, spec, out) = small();
    run(&spec, &out, &[]);
    let population = SMALL.split("[surface.drawn.population]").nth(1).unwrap();
    let rough = "\n[surface.rough.generate]\npoints = 64\npixel = \"1 um\"\nsigma = \"0.2 um\"\n\
                 spectrum.gaussian.correlation-length = \"3 um\"\n";
    let more = format!("{SMALL}\n[surface.other.population]{population}{rough}");
    let (more_spec, seed_spec) = (folder.path().join("more.toml"), folder.path().join("seed.toml"));
    fs::write(&more_spec, more).unwrap();
    let seeded = SMALL.replace("title = \"small\"", "title = \"small\"\nseed = 7");
    fs::write(&seed_spec, seeded + rough).unwrap();
    run(&more_spec, &out, &[seed_spec.to_str().unwrap()]);
    let drawn = &summary(&out, "small")["surfaces"]["drawn"]["sigma_m"];
    assert_eq!(drawn, &summary(&out, "more")["surfaces"]["drawn"]["sigma_m"]);
    assert_ne!(drawn, &summary(&out, "more")["surfaces"]["other"]["sigma_m"]);
    assert_ne!(drawn, &summary(&out, "seed")["surfaces"]["drawn"]["sigma_m"]);
    let rough = |stem: &str| summary(&out, stem)["surfaces"]["rough"]["sigma_m"].take();
    assert_ne!(rough("more"), rough("seed"));
}

/// As under `head`: the reader closes the pipe early.
#[test]
fn a_reader_may_leave() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_experiment"))
        .args(["list", "--out", "nowhere"])
        .current_dir(root)
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
