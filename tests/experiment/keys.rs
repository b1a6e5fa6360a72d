//! The schema of specs (what it allows is in `tests/test_schema.py`), and what `experiment explain` says of keys, tables and columns.

use std::fs;
use std::path::{Path, PathBuf};

use asperity_contact_framework::keys::{Default, keys};
use asperity_experiment::Experiment;
use asperity_experiment::keys::{explain, spec_schema};
use serde_json::Value;

fn specs(folder: &str) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut specs: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|of| of == "toml")).collect();
    specs.sort();
    assert!(specs.len() > 5, "{folder}");
    specs
}

#[test]
fn the_committed_schema_is_that_of_the_program() {
    let text = fs::read_to_string("docs/spec.schema.json").unwrap();
    let committed: Value = serde_json::from_str(&text).unwrap();
    assert!(committed == spec_schema(), "docs/spec.schema.json: run `experiment schema`");
}

#[test]
fn every_key_is_explained() {
    let keys = keys(&spec_schema());
    assert!(keys.len() > 150);
    for key in &keys {
        let name = key.name();
        assert!(key.meaning.ends_with(['.', '?']), "{name}: {}", key.meaning);
        assert!(key.is_table || !key.kind.is_empty() && key.kind != "any", "{name}: {}", key.kind);
        for example in &key.examples {
            assert!(format!("value = {example}").parse::<toml::Table>().is_ok(), "{name}: {example}");
        }
        let text = explain(&name).unwrap();
        assert!(text.starts_with(&name) && text.contains(&key.meaning), "{text}");
        // Every key that may be left out of a spec says what holds then, or its meaning does.
        if !key.is_table {
            assert!(
                !key.examples.is_empty() || key.default != Default::Open,
                "{name} has neither example nor default"
            );
        }
    }
}

/// Values at and beyond the ends of each whole-number range that a spec of the project sets are read and refused.
#[test]
fn ranges_are_those_of_the_reader() {
    let keys = keys(&spec_schema());
    let folder = tempfile::tempdir().unwrap();
    let mut tried = 0;
    for path in specs("experiments") {
        let text = fs::read_to_string(&path).unwrap();
        let spec = toml::Value::Table(text.parse().unwrap());
        for key in keys.iter().filter(|key| !key.is_table) {
            let Some(end) = key.range.as_deref().and_then(upper_end) else { continue };
            for place in 0..numbers(&mut spec.clone(), &key.path).len() {
                let mut changed = spec.clone();
                *numbers(&mut changed, &key.path)[place] = toml::Value::Float(end * 10.0 + 10.0);
                absolute(&mut changed, Path::new("experiments"));
                let file = folder.path().join("changed.toml");
                fs::write(&file, toml::to_string(&changed).unwrap()).unwrap();
                let error = Experiment::read(&file)
                    .err()
                    .unwrap_or_else(|| panic!("{}: {} beyond {end}", path.display(), key.name()));
                assert!(error.to_string().contains("allowed"), "{error}");
                tried += 1;
            }
        }
    }
    assert!(tried >= 30, "{tried}");
}

/// The upper end of "2 to 1000".
fn upper_end(range: &str) -> Option<f64> {
    let (from, to) = range.split_once(" to ")?;
    from.parse::<f64>().ok()?;
    to.parse().ok()
}

/// The numbers that a spec holds at the path of a key.
fn numbers<'a>(value: &'a mut toml::Value, path: &[String]) -> Vec<&'a mut toml::Value> {
    match (path, value) {
        ([], value) if value.is_integer() || value.is_float() => vec![value],
        ([name, rest @ ..], toml::Value::Table(table)) => {
            let named = table.iter_mut().filter(|(key, _)| name == "NAME" || *key == name);
            named.flat_map(|(_, value)| numbers(value, rest)).collect()
        }
        _ => Vec::new(),
    }
}

/// Makes the files of a spec readable from another folder.
fn absolute(value: &mut toml::Value, folder: &Path) {
    match value {
        toml::Value::String(text) if text.contains('.') && folder.join(&*text).is_file() => {
            *text = fs::canonicalize(folder.join(&*text)).unwrap().display().to_string();
        }
        toml::Value::Table(table) => table.iter_mut().for_each(|(_, value)| absolute(value, folder)),
        toml::Value::Array(values) => values.iter_mut().for_each(|value| absolute(value, folder)),
        _ => {}
    }
}

#[test]
fn an_unknown_name_has_similar_ones() {
    let message = explain("thicknes").unwrap_err();
    assert!(message.contains("similar: thickness"), "{message}");
    let message = explain("area_ration").unwrap_err();
    assert!(message.contains("similar: area_ratio"), "{message}");
    assert!(explain("curve.csv").unwrap_err().contains("curves.csv"));
    assert!(!explain("qqqq").unwrap_err().contains("similar"));
}

#[test]
fn a_key_is_found_by_its_end_and_by_names_of_a_spec() {
    let by_end = explain("layer.thickness").unwrap();
    assert!(by_end.starts_with("compare.layer.thickness\n"), "{by_end}");
    assert_eq!(explain("[surface.mine.file]").unwrap(), explain("surface.NAME.file").unwrap());
    let law = explain("onset").unwrap();
    assert!(law.contains("law.zmc.onset"), "{law}");
    let table = explain("accept").unwrap();
    assert!(table.contains("keys:    area, separation, stiffness"), "{table}");
}

#[test]
fn tables_columns_and_terms_are_explained() {
    let table = explain("curves.csv").unwrap();
    assert!(table.starts_with("curves.csv of ") && table.contains("[compare]"), "{table}");
    assert!(table.contains("  area_ratio ") && table.contains("One row for each "), "{table}");
    assert_eq!(explain("curves").unwrap(), table);
    let column = explain("effective_contacts").unwrap();
    assert!(column.contains("unit:    1\n  tables:  curves.csv"), "{column}");
    // A key that is a column too.
    let both = explain("law").unwrap();
    assert!(both.contains("compare.law\n") && both.contains("law\n  Contact law of an asperity."), "{both}");
    assert!(explain("effective contacts").unwrap().contains("squared load shares"));
}
