//! The program as a user meets it: exit codes, messages, what is written and what is left alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use asperity_contact_framework::report::format;

use crate::results::{self, Row, number};

mod every_input;
mod export;
mod heights;
mod input;
mod laws;
mod load;
mod reach;
mod realisations;
mod sphere;
mod surface;

fn experiment(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_experiment")).args(arguments).current_dir(folder).output().unwrap()
}

fn run(spec: &Path, out: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["run", spec.to_str().unwrap(), "--out", out.to_str().unwrap()];
    arguments.extend(more);
    experiment(&arguments, out.parent().unwrap())
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
    let spec = concat!(
        "title = \"t\"\nseed = 1\n",
        steel!(),
        "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\npressure = [\"2 MPa\", \"4 MPa\"]\n[surface.a.population]\n",
        case_1!(),
        "count = 20000\n"
    );
    fs::write(folder.path().join("joint.toml"), spec).unwrap();
    let export = |out: &str| experiment(&["export", "interface", "joint.toml", "--out", out], folder.path());
    let output = export("tables/new");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(folder.path().join("tables/new/joint.csv").is_file());
    let output = export("joint.toml");
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--out joint.toml: "), "{}", text(&output.stderr));
}

#[test]
fn a_new_spec_runs_unchanged_and_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    assert!(experiment(&["new", "mine"], folder.path()).status.success());
    let output = experiment(&["run", "mine.toml"], folder.path());
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).starts_with("reports/mine written: "));
    for file in ["report.md", "report.html", "curves.csv", "comparison.csv", "summary.json", "timing.json"] {
        assert!(folder.path().join("reports/mine").join(file).is_file(), "{file}");
    }
    for page in ["README.md", "index.html"] {
        assert!(
            fs::read_to_string(folder.path().join("reports").join(page)).unwrap().contains("mine/report")
        );
    }
    assert_eq!(experiment(&["new", "mine"], folder.path()).status.code(), Some(2));
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
    let said = |more: &[&str]| {
        let output = run(&spec, &out, more);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    assert!(said(&[]).contains("written"));
    assert!(said(&[]).contains("unchanged"));
    assert!(said(&["--force"]).contains("written"));
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
fn an_unchanged_experiment_does_nothing() {
    let (_folder, spec, out) = small();
    let output = run(&spec, &out, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = &summary(&out, "small")["work"];
    let count = |item: &str| summary[item].as_u64().unwrap();
    assert_eq!((count("files_read"), count("surfaces_made"), count("coating_calls")), (1, 2, 0));
    assert!(["asperities_touched", "nodes", "single_contacts"].iter().all(|item| count(item) > 0));
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
    let before = times();
    assert!(before.len() > 8);
    let output = run(&spec, &out, &[]);
    assert!(text(&output.stdout).contains("is unchanged") && !text(&output.stdout).contains("written"));
    assert_eq!(times(), before);
    // Only then is a written report new.
    assert!(text(&run(&spec, &out, &["--force"]).stdout).contains("written"));
    assert!(times() != before);
}

#[test]
fn the_tables_have_the_columns_and_rows_of_the_contract() {
    let (_folder, spec, out) = small();
    assert!(run(&spec, &out, &["--silent"]).stdout.is_empty());
    let curves = rows(&out, "small", "curves.csv");
    let header = fs::read_to_string(out.join("small/curves.csv")).unwrap();
    assert_eq!(
        header.lines().next().unwrap(),
        "surface,realisation,law,layer_thickness_m,model,control,target,separation_m,separation_over_sigma,\
         pressure_pa,load_ratio,area_ratio,contact_density_per_m2,mean_real_pressure_pa,stiffness_pa_per_m,\
         elastic_load_share,elastic_plastic_load_share,plastic_load_share,elastic_area_share,\
         elastic_plastic_area_share,plastic_area_share,pressure_standard_error_pa,area_ratio_standard_error,\
         beyond_model,effective_contacts,largest_load_share,large_strain_load_share,limits,contact_radius_over_thickness,\
         raw_area_ratio"
    );
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
    let output = run(&spec, &out, &["--force"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("thesis.txt"), "{}", text(&output.stderr));
    assert_eq!(fs::read_to_string(out.join("small/thesis.txt")).unwrap(), "years of work");
}

#[test]
fn a_report_is_the_same_on_any_number_of_threads() {
    let (folder, spec, _) = small();
    let outs = ["1", "2", "5"].map(|threads| {
        let out = folder.path().join(threads);
        assert!(run(&spec, &out, &["--threads", threads]).status.success());
        out.join("small")
    });
    for entry in fs::read_dir(&outs[0]).unwrap() {
        let name = entry.unwrap().file_name();
        if name == "timing.json" || name == "manifest.json" {
            continue;
        }
        let bytes = outs.each_ref().map(|out| fs::read(out.join(&name)).unwrap());
        assert!(bytes[0] == bytes[1] && bytes[0] == bytes[2], "{name:?} differs");
    }
}

#[test]
fn two_files_of_one_stem_are_refused() {
    let (folder, spec, out) = small();
    let other = folder.path().join("other");
    fs::create_dir(&other).unwrap();
    let twin = other.join("small.toml");
    fs::copy(&spec, &twin).unwrap();
    let output = run(&spec, &out, &[twin.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("small"), "{}", text(&output.stderr));
    assert!(!out.exists());
}

#[test]
fn check_runs_nothing_and_list_says_what_is_up_to_date() {
    let (folder, spec, out) = small();
    let output = experiment(&["check", spec.to_str().unwrap()], folder.path());
    assert!(output.status.success());
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
    assert!(experiment(&[], folder.path()).status.success());
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
fn population(folder: &Path, name: &str, keys: &str, count: usize) {
    let spec = format!(
        concat!(
            "title = \"{}\"\n{}\n",
            steel!(),
            "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\npressure = \"1 MPa\"\n[surface.a.population]\n",
            case_1!(),
            "count = {}\n"
        ),
        name, keys, count
    );
    fs::write(folder.join(format!("{name}.toml")), spec).unwrap();
}

#[test]
fn of_several_specs_the_quick_ones_run_first_and_three_lines_end_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let specs = folder.path().join("experiments");
    fs::create_dir(&specs).unwrap();
    population(&specs, "a-large", "", 50_000);
    population(&specs, "b-small", "group = \"laws\"", 500);
    population(&specs, "c-long", "run = \"long\"", 500);
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
    assert!(run(&spec, &out, &[]).status.success());
    let report = out.join("small/report.md");
    fs::write(&report, "my remarks").unwrap();
    let output = run(&spec, &out, &["--quiet"]);
    let message = text(&output.stderr);
    assert!(message.contains("small/report.md.bak") && message.contains("edited"), "{message}");
    assert_eq!(fs::read_to_string(out.join("small/report.md.bak")).unwrap(), "my remarks");
    assert!(fs::read_to_string(&report).unwrap().len() > 100);
    // The kept file is in the way of nothing, and of no further warning.
    let again = run(&spec, &out, &["--force"]);
    assert!(again.status.success() && !text(&again.stderr).contains("edited"), "{}", text(&again.stderr));
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
    ] {
        let refused = experiment(arguments, folder.path());
        assert_eq!(refused.status.code(), Some(2));
        assert!(text(&refused.stderr).contains(instead), "{}", text(&refused.stderr));
    }
    let refused = experiment(&["explain", "thicknes"], folder.path());
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("thickness"), "{}", text(&refused.stderr));
    let schema = text(&experiment(&["schema"], folder.path()).stdout);
    assert!(serde_json::from_str::<serde_json::Value>(&schema).is_ok());
}

#[test]
fn verify_finds_a_report_that_no_longer_matches() {
    let (folder, spec, out) = small();
    let fresh = folder.path().join("fresh");
    assert!(run(&spec, &out, &[]).status.success());
    assert!(run(&spec, &fresh, &[]).status.success());
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
    assert!(run(&spec, &out, &[]).status.success());
    let population = SMALL.split("[surface.drawn.population]").nth(1).unwrap();
    let rough = "\n[surface.rough.generate]\npoints = 64\npixel = \"1 um\"\nsigma = \"0.2 um\"\n\
                 spectrum.gaussian.correlation-length = \"3 um\"\n";
    let more = format!("{SMALL}\n[surface.other.population]{population}{rough}");
    let (more_spec, seed_spec) = (folder.path().join("more.toml"), folder.path().join("seed.toml"));
    fs::write(&more_spec, more).unwrap();
    let seeded = SMALL.replace("title = \"small\"", "title = \"small\"\nseed = 7");
    fs::write(&seed_spec, seeded + rough).unwrap();
    assert!(run(&more_spec, &out, &[seed_spec.to_str().unwrap()]).status.success());
    let drawn = &summary(&out, "small")["surfaces"]["drawn"]["sigma_m"];
    assert_eq!(drawn, &summary(&out, "more")["surfaces"]["drawn"]["sigma_m"]);
    assert_ne!(drawn, &summary(&out, "more")["surfaces"]["other"]["sigma_m"]);
    assert_ne!(drawn, &summary(&out, "seed")["surfaces"]["drawn"]["sigma_m"]);
    let rough = |stem: &str| summary(&out, stem)["surfaces"]["rough"]["sigma_m"].take();
    assert_ne!(rough("more"), rough("seed"));
}

#[test]
fn the_measured_surfaces_end_to_end() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments");
    let ground = specs.join("quantised-ground.toml");
    let output = run(&specs.join("measured-fine-finish.toml"), &out, &[ground.to_str().unwrap()]);
    assert!(output.status.success(), "{}", text(&output.stderr));

    let fine = &summary(&out, "measured-fine-finish")["surfaces"]["fine-finish"];
    let pixel = 196.73303177114576e-9;
    let number = |key: &str| fine[key].as_f64().unwrap();
    assert_eq!(fine["asperities"], 24714);
    assert!((number("nominal_area_m2") / (304_784.0 * pixel * pixel) - 1.0).abs() < 1e-14);
    assert!((number("density_per_m2") * number("nominal_area_m2") / 24714.0 - 1.0).abs() < 1e-14);
    assert_eq!(fine["height_map"]["missing_points"], 116);
    assert_eq!(fine["warnings"].as_array().unwrap().len(), 0);

    // The instrument's step is said in the summary and the report, and in the terminal of one run.
    let alone = text(&run(&ground, &folder.path().join("alone"), &[]).stderr).to_owned();
    assert!(alone.contains("height steps of 3.91 nm"), "{alone}");
    let report = fs::read_to_string(out.join("quantised-ground/report.md")).unwrap();
    assert!(report.contains("| steps | height step over median") && report.contains("map is fit: 7 spikes"));
    let warnings = &summary(&out, "quantised-ground")["surfaces"]["ground"]["warnings"];
    assert!(warnings.to_string().contains("20 distinct curvatures"));

    let mut near_the_limit = 0;
    for row in rows(&out, "measured-fine-finish", "curves.csv") {
        let area = results::number(&row, "area_ratio");
        assert_eq!(row["beyond_model"] == "true", area > 0.05, "{area}");
        near_the_limit += usize::from((0.05..0.06).contains(&area));
    }
    assert!(near_the_limit > 0);
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
