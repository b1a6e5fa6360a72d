//! Comparison of new reports with committed ones: structure and counts exactly, numbers
//! to 1e-9, timings and reports on them for their shape only, errors of the size of a rounding and where they occur
//! not at all (the summary says whether they are within their bounds), pictures, pages and their answer neither. Of contacts that were
//! counted only whether there were any: the rounds of a search for a load end by the last digits, which machines with
//! other registers do not share. Files and surfaces are counted exactly.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::Path;

use serde_json::Value;

/// Relative tolerance of a number.
const TOLERANCE: f64 = 1e-9;

/// Scale of a relative error, whose own rounding is that of the numbers near 1 that it compares.
const ERROR_SCALE: f64 = 1e-3;

/// Scale of differences between laws: separations in sigma, ratios and jumps of a law are of order 1.
const LAW_SCALE: f64 = 1.0;

/// The key of a summary that holds the first sentences of the page.
const ANSWER: &str = "answer";

/// The key of a summary that identifies a report of `[precision]`.
const ON_TIMES: &str = "precision";

/// Differences between the reports in `fresh` and those in `committed`, one line each; empty if
/// nothing does.
///
/// # Errors
/// A folder or file that cannot be read.
pub fn differences(fresh: &Path, committed: &Path) -> io::Result<Vec<String>> {
    let mut found = Vec::new();
    let (new, old) = (reports(fresh)?, reports(committed)?);
    for name in new.symmetric_difference(&old) {
        let place = if new.contains(name) { "is not committed" } else { "was not made again" };
        found.push(format!("{name}: {place}"));
    }
    for name in new.intersection(&old) {
        compare_folders(&fresh.join(name), &committed.join(name), name, &mut found)?;
    }
    Ok(found)
}

/// Names of the folders that hold a `summary.json`.
fn reports(folder: &Path) -> io::Result<BTreeSet<String>> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.path().join("summary.json").is_file() {
            names.insert(entry.file_name().to_string_lossy().into_owned());
        }
    }
    Ok(names)
}

fn compare_folders(fresh: &Path, committed: &Path, name: &str, found: &mut Vec<String>) -> io::Result<()> {
    let files = |folder: &Path| -> io::Result<BTreeSet<String>> {
        let names = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
        names.filter(|name| !matches!(name, Ok(name) if name == "manifest.json")).collect()
    };
    let (new, old) = (files(fresh)?, files(committed)?);
    found.extend(new.symmetric_difference(&old).map(|file| format!("{name}/{file}: in one of them only")));
    let read_json = |path: &Path| -> io::Result<Value> { Ok(serde_json::from_slice(&fs::read(path)?)?) };
    // In a report of `[precision]` the fastest method may differ between machines.
    let is_on_times = read_json(&committed.join("summary.json"))?.get(ON_TIMES).is_some();
    for file in new.intersection(&old) {
        let place = format!("{name}/{file}");
        let (new, old) = (fresh.join(file), committed.join(file));
        if file.ends_with(".csv") {
            compare_tables(&new, &old, is_on_times, &place, found)?;
        } else if file.ends_with(".json") {
            let [new, old] = [read_json(&new)?, read_json(&old)?];
            compare_values(&new, &old, file == "timing.json", &place, found);
        }
    }
    Ok(())
}

fn compare_tables(
    new: &Path,
    old: &Path,
    shape_only: bool,
    place: &str,
    found: &mut Vec<String>,
) -> io::Result<()> {
    let read = |path: &Path| -> io::Result<Vec<csv::StringRecord>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_path(path)?;
        Ok(reader.records().collect::<Result<_, _>>()?)
    };
    let (new, old) = (read(new)?, read(old)?);
    let (Some(header), true) = (new.first(), new.first() == old.first() && new.len() == old.len()) else {
        found.push(format!("{place}: another header or number of rows"));
        return Ok(());
    };
    if shape_only {
        return Ok(());
    }
    for (line, (a, b)) in new.iter().zip(&old).enumerate().skip(1) {
        for (k, column) in header.iter().enumerate() {
            // A difference of two results is as accurate as they are, not relative to itself.
            let scale = match column.strip_prefix("difference_") {
                Some(quantity) => header
                    .iter()
                    .position(|name| name == format!("statistical_{quantity}"))
                    .and_then(|index| a.get(index)?.parse::<f64>().ok())
                    .unwrap_or(0.0),
                None if is_between_laws(place, column) => LAW_SCALE,
                None if is_error(place, column) => ERROR_SCALE,
                None => 0.0,
            };
            let (a, b) = (a.get(k).unwrap_or_default(), b.get(k).unwrap_or_default());
            if is_of_rounding(place, column) && a.is_empty() == b.is_empty() {
                continue;
            }
            if !same_text(a, b, scale) {
                found.push(format!("{place}, line {}, {column}: now {a}, committed {b}", line + 1));
            }
        }
    }
    Ok(())
}

/// Whether a column contains errors of results against exact ones.
fn is_error(place: &str, column: &str) -> bool {
    let tables = ["convergence.csv", "benchmarks.csv"];
    tables.iter().any(|table| place.ends_with(table)) && column.ends_with("_error")
}

/// Whether a column contains differences between laws or jumps of one.
fn is_between_laws(place: &str, column: &str) -> bool {
    (place.ends_with("boundaries.csv") && column.ends_with("_jump"))
        || (place.ends_with("influence.csv") && !column.ends_with("_pa"))
}

/// Whether a column contains rounding errors, which vary between machines, or their positions.
fn is_of_rounding(place: &str, column: &str) -> bool {
    let is_either = |tables: [&str; 2]| tables.iter().any(|table| place.ends_with(table));
    is_either(["stability.csv", "maps.csv"]) && (column.ends_with("_error") || column.starts_with("worst_"))
}

fn same_text(a: &str, b: &str, scale: f64) -> bool {
    if a == b {
        return true;
    }
    let is_count = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    match (a.parse(), b.parse()) {
        (Ok(x), Ok(y)) if !(is_count(a) && is_count(b)) => same_number(x, y, scale),
        _ => false,
    }
}

fn same_number(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()).max(scale.abs())
}

/// Whether a number of a summary counts contacts.
fn is_of_contacts(place: &str) -> bool {
    let items = ["asperities_touched", "nodes", "single_contacts", "coating_calls"];
    place.rsplit_once(", work, ").is_some_and(|(_, item)| items.contains(&item))
}

fn compare_values(new: &Value, old: &Value, shape_only: bool, place: &str, found: &mut Vec<String>) {
    match (new, old) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            for (key, value) in a {
                let shape_only = shape_only || key == ON_TIMES || key == ANSWER;
                compare_values(value, &b[key], shape_only, &format!("{place}, {key}"), found);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (a, b)) in a.iter().zip(b).enumerate() {
                compare_values(a, b, shape_only, &format!("{place}[{k}]"), found);
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            let same = match (a.as_u64(), b.as_u64(), a.as_f64(), b.as_f64()) {
                (Some(a), Some(b), ..) => a == b,
                (_, _, Some(a), Some(b)) => {
                    let is_of_laws =
                        [", laws, influence[", ", laws, boundaries["].iter().any(|part| place.contains(part));
                    same_number(a, b, if is_of_laws { LAW_SCALE } else { 0.0 })
                }
                _ => false,
            };
            let is_of_rounding = place.contains(", stability, ") && place.ends_with(", worst_error");
            let is_same_work = is_of_contacts(place) && (a.as_u64() == Some(0)) == (b.as_u64() == Some(0));
            if !(same || shape_only || is_of_rounding || is_same_work) {
                found.push(format!("{place}: now {a}, committed {b}"));
            }
        }
        _ if new == old => {}
        // Another method may be the fastest, or none accurate enough.
        (
            Value::String(_) | Value::Number(_) | Value::Null,
            Value::String(_) | Value::Number(_) | Value::Null,
        ) if shape_only => {}
        _ => found.push(format!("{place}: now {new}, committed {old}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reports_with(table: &str, summary: &str) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let report = folder.path().join("one");
        fs::create_dir(&report).unwrap();
        fs::write(report.join("curves.csv"), table).unwrap();
        fs::write(report.join("summary.json"), summary).unwrap();
        fs::write(report.join("timing.json"), format!("{{\"total_s\": {}}}", table.len())).unwrap();
        folder
    }

    fn count(table: &str, summary: &str) -> usize {
        let committed = reports_with("n,difference_x,statistical_x\n12,1e-17,3.5\n", "{\"sigma_m\": 6.7e-9}");
        differences(reports_with(table, summary).path(), committed.path()).unwrap().len()
    }

    #[test]
    fn only_what_matters_differs() {
        let same = "{\"sigma_m\": 6.7e-9}";
        assert_eq!(count("n,difference_x,statistical_x\n12,1e-17,3.5\n", same), 0);
        assert_eq!(count("n,difference_x,statistical_x\n12,-3e-16,3.5000000001\n", same), 0);
        assert_eq!(count("n,difference_x,statistical_x\n13,1e-17,3.5\n", same), 1);
        assert_eq!(count("n,difference_x,statistical_x\n12,1e-17,3.50001\n", same), 1);
        assert_eq!(count("n,difference_x,statistical_x\n12,1e-17,\n", same), 1);
        assert_eq!(count("n,difference_x,y\n12,1e-17,3.5\n", same), 1);
        assert_eq!(count("n,difference_x,statistical_x\n12,1e-17,3.5\n", "{\"sigma_m\": 6.7001e-9}"), 1);
        assert_eq!(count("n,difference_x,statistical_x\n12,1e-17,3.5\n", "{\"sigma\": 6.7e-9}"), 1);
    }

    #[test]
    fn the_answer_is_that_of_the_page() {
        let committed = reports_with("n\n1\n", "{\"answer\": \"8.34 %\", \"kind\": \"compare\"}");
        let count = |summary: &str| {
            differences(reports_with("n\n1\n", summary).path(), committed.path()).unwrap().len()
        };
        assert_eq!(count("{\"answer\": \"8.35 %\", \"kind\": \"compare\"}"), 0);
        assert_eq!(count("{\"answer\": \"8.34 %\", \"kind\": \"laws\"}"), 1);
        assert_eq!(count("{\"kind\": \"compare\"}"), 1);
    }

    #[test]
    fn a_report_on_times_has_its_shape_compared() {
        let summary = |rows: &str| format!("{{\"seed\": 1, \"precision\": {{\"winners\": [{rows}]}}}}");
        let row = "{\"fastest\": \"simpson\", \"error\": 1e-9}";
        let committed = reports_with("n,s\n1,2e-6\n", &summary(row));
        let count = |table: &str, summary: &str| {
            differences(reports_with(table, summary).path(), committed.path()).unwrap().len()
        };
        let other = "{\"fastest\": null, \"error\": null}";
        assert_eq!(count("n,s\n1,3e-6\n", &summary(other)), 0);
        assert_eq!(count("n,t\n1,2e-6\n", &summary(row)), 1);
        assert_eq!(count("n,s\n1,2e-6\n2,2e-6\n", &summary(row)), 1);
        assert_eq!(count("n,s\n1,2e-6\n", &summary(&format!("{row}, {row}"))), 1);
        assert_eq!(count("n,s\n1,2e-6\n", &summary(row).replace("\"seed\": 1", "\"seed\": 2")), 1);
    }

    #[test]
    fn what_tells_laws_apart_is_as_exact_as_their_answers() {
        let between = |place: &str, column: &str| is_between_laws(place, column);
        assert!(
            between("laws/boundaries.csv", "load_jump") && !between("laws/boundaries.csv", "load_below_n")
        );
        assert!(
            between("laws/influence.csv", "models_first_law")
                && !between("laws/influence.csv", "pressure_pa")
        );
        let laws = |place: &str, value: f64| {
            let of = |value: f64| serde_json::json!({ "laws": { place: [{ "largest": value }] } });
            let mut found = Vec::new();
            compare_values(&of(value), &of(1e-5), false, "laws/summary.json", &mut found);
            found.len()
        };
        assert_eq!(
            [laws("influence", 1e-5 + 1e-12), laws("influence", 1.1e-5), laws("other", 1e-5 + 1e-12)],
            [0, 1, 1]
        );
    }

    #[test]
    fn errors_of_the_size_of_a_rounding_are_not_compared() {
        let is_free = |place: &str, column: &str| is_of_rounding(place, column);
        assert!(
            is_free("stability/stability.csv", "worst_error")
                && is_free("stability/stability.csv", "worst_inputs")
                && is_free("stability/stability.csv", "worst_bound")
        );
        assert!(
            !is_free("stability/stability.csv", "bound") && !is_free("limit/convergence.csv", "worst_error")
        );
        let of = |worst: f64, holds: bool| serde_json::json!({ "stability": { "families": [{ "within_bounds": holds, "worst_error": worst }] } });
        let count = |new: &Value| {
            let mut found = Vec::new();
            compare_values(new, &of(1e-16, true), false, "stability/summary.json", &mut found);
            found.len()
        };
        assert_eq!([count(&of(3e-16, true)), count(&of(1e-16, false))], [0, 1]);
    }

    #[test]
    fn of_contacts_only_whether_there_are_any_is_compared() {
        let work = |item: &str, count: u64| serde_json::json!({ "work": { item: count } });
        let differs = |item: &str, now: u64, before: u64| {
            let mut found = Vec::new();
            compare_values(&work(item, now), &work(item, before), false, "one/summary.json", &mut found);
            !found.is_empty()
        };
        for item in ["asperities_touched", "nodes", "single_contacts", "coating_calls"] {
            assert!(
                !differs(item, 7, 8) && !differs(item, 0, 0) && differs(item, 0, 8) && differs(item, 7, 0)
            );
        }
        assert!(differs("files_read", 1, 2) && differs("surfaces_made", 7, 8));
        assert!(!differs("files_read", 2, 2));
    }

    #[test]
    fn a_report_that_is_missing_is_said() {
        let committed = reports_with("a\n", "{}");
        let fresh = tempfile::tempdir().unwrap();
        assert_eq!(differences(fresh.path(), committed.path()).unwrap(), ["one: was not made again"]);
    }
}
