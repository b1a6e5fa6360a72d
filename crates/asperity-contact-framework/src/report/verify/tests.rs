use std::fmt;

use super::*;
use crate::input::{InputError, Spanned, SpecFile};
use crate::kind::{Kind, Memory, Outcome, Plan, RunContext};
use crate::metadata::Metadata;
use crate::report::Page;
use crate::report::table::Tables;
use crate::rows;

/// A row of a table with a column of each comparison.
struct Point(usize);

rows! { Point => "points.csv", records "points";
    "One row for each point.";
    row =>
    n["count"] = row.0, "n.";
    x["1"] = row.0 as f64, "x.";
    difference_x["1", scale_of("x")] = row.0 as f64, "Difference of x.";
    jump["1", scale(1.0)] = row.0 as f64, "Jump.";
    seconds["s", ignored] = row.0 as f64, "Time.";
}

/// A kind whose table holds times.
struct Points;

struct Never;

impl fmt::Display for Never {
    fn fmt(&self, _: &mut fmt::Formatter) -> fmt::Result {
        Ok(())
    }
}

impl Plan for Never {
    fn memory(&self) -> Memory {
        Memory::default()
    }

    fn work(&self) -> u128 {
        0
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Err(InputError::file(&context.source.path, "is not run"))
    }
}

impl Outcome for Never {
    fn metadata(&self) -> &Metadata {
        unreachable!("no run ends")
    }

    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    fn page(&self, _: &Tables) -> Page {
        Page::new("")
    }
}

impl Kind for Points {
    const NAME: &'static str = "points";
    type Spec = bool;
    type Plan = Never;

    fn plan(_: &SpecFile, _: &Spanned<bool>) -> Result<Never, InputError> {
        Ok(Never)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<Point>()]
    }
}

const KINDS: [RegisteredKind; 1] = [RegisteredKind::of::<Points>()];

/// A folder with one report of some files, all of them committed.
fn report(kind: &str, facts: &str, files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("one");
    fs::create_dir(&report).unwrap();
    let mut committed = serde_json::Map::new();
    for (name, content) in files {
        fs::write(report.join(name), content).unwrap();
        committed.insert((*name).to_owned(), serde_json::json!(format!("hash of {content}")));
    }
    let committed = serde_json::Value::Object(committed);
    let summary = format!("{{\"kind\": \"{kind}\", \"committed\": {committed}, \"facts\": {facts}}}");
    fs::write(report.join(SUMMARY), summary).unwrap();
    folder
}

fn count(new: &tempfile::TempDir, old: &tempfile::TempDir) -> usize {
    verified(new.path(), old.path(), &KINDS).unwrap().differences.len()
}

#[test]
fn cells_are_compared_as_their_columns_say() {
    let table = |row: &str| {
        report("points", "{}", &[("points.csv", &format!("n,x,difference_x,jump,seconds\n{row}\n"))])
    };
    let old = table("12,3.5,1e-17,1e-5,0.1");
    for same in ["12,3.5,-3e-16,1e-5,0.1", "12,3.5000000001,1e-17,1.00001e-5,7", "12,3.5,1e-17,1e-5,0.2"] {
        assert_eq!(count(&table(same), &old), 0, "{same}");
    }
    for other in [
        "13,3.5,1e-17,1e-5,0.1",
        "12,3.50001,1e-17,1e-5,0.1",
        "12,,1e-17,1e-5,0.1",
        "12,3.5,1e-8,1e-5,0.1",
        "12,3.5,1e-17,1.1e-5,0.1",
        "12,3.5,1e-17,1e-5,",
    ] {
        assert_eq!(count(&table(other), &old), 1, "{other}");
    }
    let renamed =
        report("points", "{}", &[("points.csv", "n,y,difference_x,jump,seconds\n12,3.5,1e-17,1e-5,0.1\n")]);
    assert_eq!(count(&renamed, &old), 1);
}

#[test]
fn sums_of_long_tables_are_compared_as_their_columns() {
    let digest = |changed: &[(&str, &str)]| {
        let mut text = "table,column,rows,empty,sum,magnitude,least,largest,weighted\n".to_owned();
        for (column, sums) in [
            ("x", "9,0,1.5,400,-9,12,0.5"),
            ("difference_x", "9,0,1e-17,1e-16,-1e-17,2e-17,0"),
            ("seconds", "9,0,1,1,1,1,1"),
        ] {
            let sums = changed.iter().find(|(name, _)| *name == column).map_or(sums, |(_, sums)| sums);
            text.push_str(&format!("points.csv,{column},{sums}\n"));
        }
        report("points", "{}", &[("digest.csv", &text)])
    };
    let old = digest(&[]);
    let same = digest(&[
        ("x", "9,0,1.5000001,400,-9,12,0.5"),
        ("difference_x", "9,0,-3e-15,1e-15,-4e-15,2e-17,0"),
        ("seconds", "9,0,2,2,2,2,2"),
    ]);
    assert_eq!(count(&same, &old), 0);
    for other in [
        ("x", "9,0,1.51,400,-9,12,0.5"),
        ("x", "9,0,1.5,400,-9,12.1,0.5"),
        ("difference_x", "9,0,1e-6,1e-16,-1e-17,2e-17,0"),
        ("seconds", "9,1,1,1,1,1,1"),
    ] {
        assert_eq!(count(&digest(&[other]), &old), 1, "{other:?}");
    }
}

#[test]
fn summaries_are_compared_by_number_and_records_by_column() {
    let with = |facts: &str| report("points", facts, &[]);
    let old = with("{\"sigma_m\": 6.7e-9, \"work\": {\"nodes\": 1}}");
    assert_eq!(count(&with("{\"sigma_m\": 6.7e-9, \"work\": {\"nodes\": 1}}"), &old), 0);
    assert_eq!(count(&with("{\"sigma_m\": 6.7001e-9, \"work\": {\"nodes\": 1}}"), &old), 1);
    assert_eq!(count(&with("{\"sigma\": 6.7e-9, \"work\": {\"nodes\": 1}}"), &old), 1);
    let summary = |points: &str| {
        let folder = with("{}");
        let text = format!("{{\"kind\": \"points\", \"committed\": {{}}, \"answer\": \"8.34 %\", {points}}}");
        fs::write(folder.path().join("one").join(SUMMARY), text).unwrap();
        folder
    };
    let old = summary(
        "\"points\": [{\"x\": 2.0, \"difference_x\": 1e-17, \"jump\": 1e-5, \"seconds\": 1}], \"work\": {\"nodes\": 7, \"files_read\": 1}",
    );
    let same = "\"points\": [{\"x\": 2.0, \"difference_x\": -4e-17, \"jump\": 1.00001e-5, \"seconds\": 2}], \"work\": {\"nodes\": 8, \"files_read\": 1}";
    assert_eq!(count(&summary(same), &old), 0);
    for (was, is) in [
        ("\"x\": 2.0", "\"x\": 2.1"),
        ("-4e-17", "1e-6"),
        ("1.00001e-5", "2e-5"),
        ("\"nodes\": 8", "\"nodes\": 0"),
        ("\"files_read\": 1", "\"files_read\": 2"),
    ] {
        assert_eq!(count(&summary(&same.replace(was, is)), &old), 1, "{is}");
    }
    let other_answer = fs::read_to_string(old.path().join("one").join(SUMMARY)).unwrap();
    let changed = with("{}");
    fs::write(changed.path().join("one").join(SUMMARY), other_answer.replace("8.34", "8.36")).unwrap();
    assert_eq!(count(&changed, &old), 1);
    fs::write(changed.path().join("one").join(SUMMARY), other_answer.replace("8.34", "8.35")).unwrap();
    assert_eq!(count(&changed, &old), 0);
}

#[test]
fn pages_and_pictures_out_of_date_are_noticed_except_of_times() {
    let times = ("points.csv", "n,x,difference_x,jump,seconds\n");
    for (tables, differing) in [(&[][..], 2), (&[times][..], 0)] {
        let with = |page: &str, picture: &str| {
            report("points", "{}", &[&[("report.md", page), ("a.svg", picture)], tables].concat())
        };
        let old = with("area 12.3 %", "M1.25,3");
        assert_eq!(count(&with("area 12.4 %", "M1.26,3"), &old), 0);
        assert_eq!(count(&with("area 15 %", "M1.5,3"), &old), differing, "{tables:?}");
    }
}

#[test]
fn a_report_or_file_that_is_missing_is_said() {
    let old = report("points", "{}", &[("report.md", "a")]);
    let fresh = tempfile::tempdir().unwrap();
    assert_eq!(verified(fresh.path(), old.path(), &KINDS).unwrap().differences, ["one: was not made again"]);
    let long = report("points", "{}", &[]);
    fs::write(long.path().join("one").join(SUMMARY), r#"{"kind": "points", "run": "long"}"#).unwrap();
    let found = verified(fresh.path(), long.path(), &KINDS).unwrap();
    assert!(found.differences.is_empty() && found.not_run == ["one"], "{found:?}");
    let without = report("points", "{}", &[]);
    let lines = verified(without.path(), old.path(), &KINDS).unwrap().differences;
    assert_eq!(lines, ["one/report.md: is missing"]);
    fs::remove_file(old.path().join("one/report.md")).unwrap();
    let new = report("points", "{}", &[("report.md", "a")]);
    assert_eq!(verified(new.path(), old.path(), &KINDS).unwrap().differences, ["one/report.md: is missing"]);
}

#[test]
fn numbers_may_differ_in_the_last_shown_digit_and_words_may_not() {
    let is_same = |new: &str, old: &str| first_difference(new, old).is_none();
    for (new, old) in [
        ("area 12.3 % too large", "area 12.4 % too large"),
        ("M10.25,-3.5L4", "M10.24,-3.5L4"),
        ("1e-4 of it", "9.99e-5 of it"),
        ("12 m", "12.1 m"),
        ("+0.1", "+0.2"),
    ] {
        assert!(is_same(new, old), "{new}");
    }
    for (new, old) in [
        ("area 12.3 % too large", "area 12.5 % too large"),
        ("within 3 %", "beyond 3 %"),
        ("247 contacts", "248 contacts"),
        ("one line", "one line\nand another"),
        ("0.1 µm", "0.1 nm"),
    ] {
        assert!(!is_same(new, old), "{new}");
    }
    let line = first_difference("a\nb 1.0\nc", "a\nb 2.0\nc").unwrap();
    assert_eq!(line, "line 2: now b 1.0, committed b 2.0");
}
