//! Specs that are refused get the messages in `tests/specs/bad.txt`: file, line, key, what was found and what is allowed.
//! `RENEW=1 cargo test --test experiment bad_specs` writes the messages anew, and a review reads what has changed.

use std::fs;
use std::path::{Path, PathBuf};

#[path = "../specs/mod.rs"]
mod specs;

use specs::BadSpec;

use crate::results::experiment;

/// Maps that they name, besides those of `tests/specs/data`.
const MAPS: [&str; 2] = ["surface_int32_binary.x3p", "samples/st-al3d-1.al3d"];

/// A folder with the files that they name under `data`.
fn folder(root: &Path) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    fs::create_dir(&data).unwrap();
    let listed = fs::read_dir(root.join("tests/specs/data")).unwrap().map(|entry| entry.unwrap().path());
    let maps = MAPS.map(|name| root.join("crates/asperity/tests/library/formats").join(name));
    for file in listed.chain(maps).collect::<Vec<PathBuf>>() {
        fs::copy(&file, data.join(file.file_name().unwrap())).unwrap();
    }
    folder
}

/// A message without the memory of this machine.
fn of_any_machine(message: &str) -> String {
    match message.split_once("available: ") {
        Some((before, after)) => format!("{before}available: ...{}", after.trim_start_matches(|c| c != ' ')),
        None => message.to_owned(),
    }
}

#[test]
fn every_bad_spec_gets_its_message_and_writes_nothing() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("tests/specs/bad.txt");
    let text = fs::read_to_string(&path).unwrap();
    let folder = folder(root);
    let (mut renewed, mut wrong) = (Vec::new(), Vec::new());
    for bad in BadSpec::all(&text) {
        let file = format!("{}.toml", bad.name);
        fs::write(folder.path().join(&file), bad.spec()).unwrap();
        let output = experiment(&["run", &file, "--out", "reports"], folder.path());
        let message = of_any_machine(&String::from_utf8(output.stderr).unwrap());
        assert_eq!(output.status.code(), Some(2), "{file}: {message}");
        assert!(message.contains(&file) && !message.contains("panicked"), "{file}: {message}");
        let message = message
            .trim_end()
            .lines()
            .map(|line| format!("> {line}").trim_end().to_owned())
            .collect::<Vec<_>>()
            .join("\n");
        if message != bad.message {
            wrong.push(format!("{}\n{message}", bad.name));
        }
        renewed.push(format!("=== {}\n{}{message}\n", bad.name, bad.written));
    }
    assert!(!folder.path().join("reports").exists(), "something is written");
    if std::env::var_os("RENEW").is_some() {
        fs::write(path, renewed.join("\n")).unwrap();
    } else {
        assert!(wrong.is_empty(), "other messages than in tests/specs/bad.txt:\n{}", wrong.join("\n"));
    }
}
