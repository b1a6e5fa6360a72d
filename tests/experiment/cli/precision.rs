//! Run time against error, as a user meets it.

use std::fs;
use std::path::Path;

use super::{experiment, run, summary, text};
use crate::results::{Row, number, rows};

const SMALL: &str = concat!(
    r#"
title = "small"
"#,
    steel!(),
    r#"[precision]
rough = "steel"
flat = "steel"
law = "zmc"
[precision.case."one | two"]
"#,
    case_1!(),
    r#"[precision.integral]
separation = { values = [0, 2] }
[precision.sum]
count = { values = [1e3, 5e4] }
full-count = { values = [6e4] }
separations = { values = [1, 20] }
threads = { values = [1, 2] }
[precision.curve]
asperities = 3000
separations = 8000
tolerance = { values = [1e-2, 5e-3, 1e-6] }
[precision.list]
count = { values = [1e3, 2e6] }
full-count = { values = [3e6] }
separations = 4
[precision.sampling]
separation = { values = [0] }
count = { values = [100, 1e3, 1e4, 2e4, 4e4] }
draws = 4
[precision.grid]
points-per-length = { values = [2, 4, 8] }
lengths = { values = [10, 20] }
realisations = 2
"#
);

fn table(folder: &Path, name: &str) -> Vec<Row> {
    rows(&fs::read(folder.join(name)).unwrap())
}

fn written(more: &[&str]) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("small.toml");
    fs::write(&spec, SMALL).unwrap();
    let out = folder.path().join("reports");
    let output = run(&spec, &out, more);
    assert!(output.status.success(), "{}", text(&output.stderr));
    (folder, out)
}

#[test]
fn times_and_errors_are_what_they_should_be() {
    let (_folder, out) = written(&[]);
    let report = out.join("small");

    let rules = table(&report, "integral.csv");
    let error = |rule: &str, split: &str, substituted: &str, order: &str| {
        let is_it = |row: &&Row| {
            [&row["rule"], &row["split"], &row["substituted"], &row["order"]]
                == [rule, split, substituted, order]
        };
        let row = rules.iter().find(is_it).unwrap_or_else(|| panic!("no {rule} of order {order}"));
        number(row, "area_error").max(number(row, "load_error"))
    };
    let legendre = |order: &str| error("gauss-legendre", "true", "true", order);
    assert!(legendre("4") > 3.0 * legendre("8") && legendre("8") > 30.0 * legendre("16"));
    assert!(legendre("16") > 30.0 * legendre("48") && legendre("64") < 1e-13);
    assert!(error("gauss-legendre", "false", "true", "64") > 1e3 * legendre("64"));
    assert!(error("gauss-legendre", "true", "false", "64") > 1e2 * legendre("64"));
    assert!(error("shipped", "true", "true", "") < 1e-13);
    assert!(rules.iter().all(|row| number(row, "seconds_per_separation") > 0.0));
    let names: std::collections::HashSet<&String> = rules.iter().map(|row| &row["rule"]).collect();
    assert_eq!(names.len(), 12, "{names:?}");

    let sums = table(&report, "sum.csv");
    assert_eq!(sums.len(), 2 * 8 + 2 * 4 + 2 * 4);
    let of_largest = |way: &str| {
        let is_it =
            |row: &&Row| row["varied"] == "asperities" && row["way"] == way && row["asperities"] == "50000";
        let row = sums.iter().find(is_it).unwrap();
        number(row, "area_error").max(number(row, "load_error"))
    };
    for order in ["", ", ordered"] {
        let compensated = of_largest(&format!("compensated{order}"));
        assert!(compensated < 3e-16 && of_largest(&format!("naive{order}")) > 2.0 * compensated);
    }

    let curves = table(&report, "curve.csv");
    assert_eq!(curves.len(), 2 * (1 + 3));
    for model in ["statistical", "deterministic"] {
        let of_model: Vec<&Row> = curves.iter().filter(|row| row["model"] == model).collect();
        let [exact, all, within @ ..] = &of_model[..] else { panic!("{curves:?}") };
        assert!(exact["tolerance"].is_empty() && exact["asked"] == "8000" && all["asked"] == "8000");
        for row in within {
            let error = number(row, "area_error").max(number(row, "load_error"));
            assert!(error > 0.0 && error <= number(row, "tolerance"), "{row:?}");
            assert!(number(row, "asked") < 8000.0 && row["separations"] == "8000");
        }
        assert!(number(within[1], "asked") < number(within[0], "asked"), "{within:?}");
    }

    let lists = table(&report, "list.csv");
    assert_eq!(lists.len(), 2);
    assert!(number(&lists[1], "seconds_to_read") > number(&lists[0], "seconds_to_read"));
    assert!(number(&lists[1], "seconds_to_sum") > number(&lists[0], "seconds_to_sum"));
    if cfg!(target_os = "linux") {
        // The file and its columns, 16 bytes each, and no copy beside.
        let each = number(&lists[1], "added_bytes") / 2e6;
        assert!((16.0..40.0).contains(&each), "{each} bytes an asperity");
    }

    let winners = table(&report, "winners.csv");
    assert_eq!(winners.len(), 3 + 4);
    for row in winners.iter().filter(|row| !row["fastest"].is_empty()) {
        assert!(number(row, "error") <= number(row, "largest_error"), "{row:?}");
        assert!(row["shipped_over_fastest"].is_empty() || number(row, "shipped_over_fastest") >= 1.0);
    }

    let sets = table(&report, "sampling.csv");
    assert_eq!(sets.len(), 5);
    let [first, last] = [&sets[0], &sets[4]].map(|row| number(row, "load_stated_error"));
    assert!((first / last / 20.0 - 1.0).abs() < 0.5, "{first} {last}");

    let maps = table(&report, "grid.csv");
    assert_eq!(maps.len(), 3 * 2);
    let bias = |row: &Row| number(row, "radius_bias").abs();
    assert!(bias(&maps[0]) > 3.0 * bias(&maps[2]) && bias(&maps[2]) > 3.0 * bias(&maps[4]));

    let page = fs::read_to_string(report.join("report.md")).unwrap();
    for words in [
        "The integral, one \\| two",
        "the shipped method",
        "√10",
        "Size of the surface",
        "8,000 separations of the integral take ",
        " times the time of the exact curve within 0.01 (error found: ",
        " within 0.005 (error found: ",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("NaN") && report.join("one---two-rules.svg").is_file());
    let precision = &summary(&out, "small")["precision"];
    assert_eq!(precision["full"], false);
    assert_eq!(precision["lists"][0]["asperities"], 2_000_000);
    let times = precision["curves"][0]["time_over_exact"].as_f64().unwrap();
    let seconds = |row: &Row| number(row, "seconds_per_curve");
    assert_eq!(times, seconds(&curves[1]) / seconds(&curves[0]));
}

#[test]
fn the_largest_sets_are_run_only_in_full() {
    let (folder, out) = written(&["--full", "--quiet"]);
    let sums = table(&out.join("small"), "sum.csv");
    assert_eq!(sums.len(), 3 * 8 + 2 * 4 + 2 * 4);
    assert!(sums.iter().any(|row| row["asperities"] == "60000" && row["varied"] == "asperities"));
    assert!(sums.iter().all(|row| row["asperities"] != "60000" || row["varied"] != "threads"));
    assert_eq!(summary(&out, "small")["precision"]["full"], true);
    assert_eq!(summary(&out, "small")["precision"]["lists"][0]["asperities"], 3_000_000);
    // In full it is another experiment.
    let again = |more: &[&str]| text(&run(&folder.path().join("small.toml"), &out, more).stdout);
    assert!(again(&["--full"]).contains("unchanged"));
    let check = |more: &[&str]| {
        let mut arguments = vec!["check", "small.toml"];
        arguments.extend(more);
        text(&experiment(&arguments, folder.path()).stdout)
    };
    assert!(!check(&[]).contains("60000") && check(&["--full"]).contains("60000"));
}

/// Lists are removed, whether they could be written or not.
#[test]
fn lists_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let temporary = folder.path().join("temporary");
    fs::create_dir(&temporary).unwrap();
    let spec = folder.path().join("small.toml");
    let begin = SMALL.split("[precision.integral]").next().unwrap();
    fs::write(
        &spec,
        format!("{begin}[precision.list]\ncount = {{ values = [1e3, 1e5] }}\nseparations = 2\n"),
    )
    .unwrap();
    let run_there = |temporary: &Path| {
        std::process::Command::new(env!("CARGO_BIN_EXE_experiment"))
            .args(["run", "small.toml", "--out", "reports", "--force", "--quiet"])
            .env("TMPDIR", temporary)
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let output = run_there(&temporary);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(folder.path().join("reports/small/list.csv").is_file());
    assert_eq!(fs::read_dir(&temporary).unwrap().count(), 0);
    let output = run_there(&temporary.join("none"));
    assert!(!output.status.success());
    let message = text(&output.stderr);
    assert!(message.contains("case one | two: a list of 1000 asperities cannot be written"), "{message}");
    assert!(message.contains("with room for 16000 bytes"), "{message}");
}

/// The memory for a list follows from its rows: 56 bytes each, 16 of them kept.
#[test]
fn a_long_list_is_no_more_than_its_asperities() {
    const ROWS: u64 = 100_000;
    let folder = tempfile::tempdir().unwrap();
    let head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({ROWS}, 2), }}");
    let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    bytes.extend(format!("{head:<117}\n").bytes());
    bytes.extend((0..ROWS).flat_map(|row| [row as f64 * 1e-12, 1e-6]).flat_map(f64::to_le_bytes));
    fs::write(folder.path().join("long.npy"), bytes).unwrap();
    let spec = "title = \"long\"\n[material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\nhardness = \"7.6 GPa\"\n\
                [compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\nmodels = [\"deterministic\"]\n\
                separation = { from = 4, to = 0, points = 50 }\n\
                [surface.long.asperities]\nfile = \"long.npy\"\nnominal-area = \"1 mm^2\"\n";
    fs::write(folder.path().join("long.toml"), spec).unwrap();
    let output = experiment(&["check", "long.toml"], folder.path());
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("memory: at most 7.2 MB;"), "{}", text(&output.stdout));
}

/// Invalid curves and lists are rejected with their position.
#[test]
fn curves_and_lists_have_their_limits() {
    let folder = tempfile::tempdir().unwrap();
    for (from, to, words) in [
        (
            "tolerance = { values = [1e-2, 5e-3, 1e-6] }",
            "tolerance = { values = [1e-2, 1e-13] }",
            "found the tolerance 1e-13; allowed: 1e-12 to 0.01",
        ),
        ("separations = 8000", "separations = 1", "found 1; allowed: 2 to 100000 separations"),
        ("asperities = 3000", "asperities = 0", "found 0; allowed: 1 to 1000000000000 asperities"),
        ("separations = 4\n", "separations = 0\n", "found 0; allowed: 1 to 100000 separations"),
    ] {
        assert!(SMALL.contains(from));
        let spec = folder.path().join("bad.toml");
        fs::write(&spec, SMALL.replace(from, to)).unwrap();
        let output = run(&spec, &folder.path().join("reports"), &[]);
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(words), "{}", text(&output.stderr));
    }
}

/// Times differ between runs: only the structure is compared.
#[test]
fn verify_compares_times_by_their_shape() {
    let (folder, _) = written(&["--quiet"]);
    let spec = folder.path().join("small.toml");
    assert!(run(&spec, &folder.path().join("fresh"), &["--quiet"]).status.success());
    let verify = || experiment(&["verify", "fresh", "--out", "reports"], folder.path());
    assert!(verify().status.success(), "{}", text(&verify().stderr));
    let sums = folder.path().join("reports/small/sum.csv");
    fs::write(&sums, fs::read_to_string(&sums).unwrap() + "\n1,2\n").unwrap();
    assert_eq!(verify().status.code(), Some(1));
}
