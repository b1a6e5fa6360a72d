//! Run time against error, as a user meets it.

use std::fs;
use std::path::Path;

use super::{experiment, run, text};
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
huge-count = { values = [6e4] }
[precision.surface]
points-per-length = { values = [2, 4, 8] }
lengths = { values = [10, 20] }
realisations = 2
[precision.reference]
pixels = { values = [4, 8, 16] }
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

fn error(row: &Row) -> f64 {
    number(row, "area_error").abs().max(number(row, "load_error").abs())
}

/// Each method is more accurate where it takes more, and a page holds a figure of each.
#[test]
fn times_and_errors_are_what_they_should_be() {
    let (_folder, out) = written(&[]);
    let report = out.join("small");
    let rules = table(&report, "integral.csv");
    let of =
        |method: &str| -> Vec<&Row> { rules.iter().filter(|row| row["rule"].contains(method)).collect() };
    let shipped = of("shipped");
    assert!(!shipped.is_empty() && shipped.iter().all(|row| error(row) < 1e-13), "{shipped:?}");
    let split = of("split");
    assert!(error(split[0]) > 1e3 * error(split[split.len() - 1]), "{split:?}");
    assert!(rules.iter().all(|row| number(row, "seconds_per_separation") > 0.0));

    let sums = table(&report, "sum.csv");
    let of_largest = |method: &str| {
        let is_it = |row: &&Row| row["method"] == method && row["asperities"] == "50000";
        error(sums.iter().find(is_it).unwrap_or_else(|| panic!("no {method}: {sums:?}")))
    };
    assert!(of_largest("compensated") < 3e-16 && of_largest("naive") > 2.0 * of_largest("compensated"));
    assert!(sums.iter().all(|row| row["asperities"] != "60000"));

    assert_eq!(table(&report, "surface.csv").len(), 3 * 2);
    let contacts = table(&report, "boundary_elements.csv");
    assert!(error(&contacts[0]) > 3.0 * error(&contacts[2]), "{contacts:?}");
    let page = fs::read_to_string(report.join("report.md")).unwrap();
    assert!(page.contains("one \\| two") && !page.contains("NaN"), "{page}");
}

#[test]
fn the_largest_sets_are_run_only_where_they_are_asked_for() {
    let (folder, out) = written(&["--huge", "--quiet"]);
    assert!(table(&out.join("small"), "sum.csv").iter().any(|row| row["asperities"] == "60000"));
    // With them it is another experiment.
    let again = |more: &[&str]| text(&run(&folder.path().join("small.toml"), &out, more).stdout);
    assert!(again(&["--huge"]).contains("unchanged"));
    let check = |more: &[&str]| {
        let mut arguments = vec!["check", "small.toml"];
        arguments.extend(more);
        text(&experiment(&arguments, folder.path()).stdout)
    };
    assert!(!check(&[]).contains("60000") && check(&["--huge"]).contains("60000"));
}

/// Times of another run differ, and are not compared.
#[test]
fn verify_does_not_compare_times() {
    let (folder, out) = written(&[]);
    let fresh = folder.path().join("fresh");
    assert!(run(&folder.path().join("small.toml"), &fresh, &[]).status.success());
    let verified = experiment(&["verify", "fresh", "--out", "reports"], folder.path());
    assert!(verified.status.success(), "{}", text(&verified.stderr));
    let table = out.join("small/sum.csv");
    let changed = fs::read_to_string(&table).unwrap().replacen("naive", "knave", 1);
    fs::write(&table, changed).unwrap();
    assert!(!experiment(&["verify", "fresh", "--out", "reports"], folder.path()).status.success());
}
