//! The schema of specs, and what documentation and `experiment explain` say of their keys.

use std::fs;
use std::path::{Path, PathBuf};

use asperity_contact_framework::keys::{Default, Key, keys};
use asperity_experiment::keys::{all_keys, explain, spec_schema};
use asperity_experiment::{Experiment, TEMPLATE};
use jsonschema::Validator;
use serde_json::Value;

fn validator() -> Validator {
    jsonschema::draft7::new(&spec_schema()).unwrap()
}

fn json(toml: &str) -> Value {
    serde_json::to_value(toml.parse::<toml::Table>().unwrap()).unwrap()
}

fn specs(folder: &str) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut specs: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|of| of == "toml")).collect();
    specs.sort();
    assert!(specs.len() > 5, "{folder}");
    specs
}

#[test]
fn the_schema_allows_every_spec_that_is_read() {
    let validator = validator();
    let templates = [("template", TEMPLATE.to_owned())].map(|(name, text)| (PathBuf::from(name), text));
    let files =
        specs("experiments").into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap()));
    for (path, text) in files.chain(templates) {
        let errors: Vec<String> =
            validator.iter_errors(&json(&text)).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", path.display());
    }
}

#[test]
fn the_schema_refuses_what_is_refused() {
    let validator = validator();
    let valid = "title = \"t\"\nmaterial.a = { young = \"1 GPa\", poisson = 0.3 }\n[laws]\nrough = \"a\"\nflat = \"a\"\n\
                 law = [\"hertz\", \"zmc\"]\nasperity.radius = \"1 um\"\nindentation = [1, 2]\npressure = \"1 MPa\"\n";
    assert!(validator.is_valid(&json(valid)));
    for (from, to) in [
        ("title = \"t\"\n", ""),
        ("poisson = 0.3", "poisson = 0.5"),
        ("poisson = 0.3", "poisson = \"0.3\""),
        ("young = \"1 GPa\"", "young = -1"),
        ("young = ", "youngs = "),
        ("\"hertz\"", "\"herz\""),
        ("\"zmc\"", "{ zmc = { ratio = 2 } }"),
        ("[laws]", "[law]"),
        ("[1, 2]", "{ from = 1, to = 2 }"),
        ("[1, 2]", "[]"),
        ("\n[laws]", "\n[limit]\n[laws]"),
    ] {
        assert_ne!(valid.replace(from, to), valid);
        assert!(!validator.is_valid(&json(&valid.replace(from, to))), "{from} -> {to}");
    }
}

#[test]
fn committed_pages_are_those_of_the_program() {
    let read = |path: &str| fs::read_to_string(path).unwrap();
    assert!(read("docs/keys.md").trim_end() == all_keys().trim_end(), "docs/keys.md: run `experiment keys`");
    let committed: Value = serde_json::from_str(&read("docs/spec.schema.json")).unwrap();
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

#[test]
fn examples_are_allowed() {
    let schema = spec_schema();
    for key in keys(&schema) {
        let of_key = subschema(&schema, &key.path).unwrap_or_else(|| panic!("{}", key.name()));
        let validator = jsonschema::draft7::new(of_key).unwrap();
        for example in &key.examples {
            let value = &json(&format!("value = {example}"))["value"];
            assert!(validator.is_valid(value), "{}", key.line(example));
        }
        // Editors insert defaults.
        if let Some(default) = of_key.get("default") {
            assert!(validator.is_valid(default), "{}", key.line(&default.to_string()));
        }
    }
}

/// The schema of a key.
fn subschema<'a>(schema: &'a Value, path: &[String]) -> Option<&'a Value> {
    let [first, rest @ ..] = path else { return Some(schema) };
    let of_first = schema["properties"]
        .get(first)
        .or_else(|| schema.get("additionalProperties").filter(|of| of.is_object() && first == "NAME"));
    let of_alternatives = || {
        let lists = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema[key].as_array());
        lists.flatten().find_map(|one| subschema(one, path))
    };
    of_first.and_then(|below| subschema(below, rest)).or_else(of_alternatives)
}

/// Values at and beyond the ends of each whole-number range that a spec of the project sets are read and refused.
#[test]
fn ranges_are_those_of_the_reader() {
    let keys = keys(&spec_schema());
    let folder = tempfile::tempdir().unwrap();
    let mut tried = 0;
    for path in specs("experiments") {
        let text = fs::read_to_string(&path).unwrap();
        let spec: toml::Table = text.parse().unwrap();
        for key in keys.iter().filter(|key| !key.is_table) {
            let Some(end) = key.range.as_deref().and_then(upper_end) else { continue };
            for place in places(&spec, key) {
                let mut changed = toml::Value::Table(spec.clone());
                *at(&mut changed, &place) = toml::Value::Float(end * 10.0 + 10.0);
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

/// Where a spec holds a single number for a key.
fn places(spec: &toml::Table, key: &Key) -> Vec<Vec<String>> {
    let root = toml::Value::Table(spec.clone());
    let mut found: Vec<(Vec<String>, toml::Value)> = vec![(Vec::new(), root)];
    for name in &key.path {
        let below = found.into_iter().flat_map(|(path, value)| {
            let table = value.as_table().cloned().unwrap_or_default();
            let keys: Vec<String> =
                if name == "NAME" { table.keys().cloned().collect() } else { vec![name.clone()] };
            keys.into_iter().filter_map(move |name| {
                let value = table.get(&name)?.clone();
                Some(([path.clone(), vec![name]].concat(), value))
            })
        });
        found = below.collect();
    }
    found
        .into_iter()
        .filter(|(_, value)| value.is_integer() || value.is_float())
        .map(|(path, _)| path)
        .collect()
}

fn at<'a>(value: &'a mut toml::Value, path: &[String]) -> &'a mut toml::Value {
    path.iter().fold(value, |value, name| &mut value[name.as_str()])
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
fn an_unknown_key_names_similar_ones() {
    let message = explain("thicknes").unwrap_err();
    assert!(message.contains("similar: thickness"), "{message}");
    assert!(explain("qqqq").unwrap_err().contains("`experiment keys` lists all"));
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
