//! What messages advise can be typed: each remedy with an input that causes it, applied in a spec and on the command line
//! (`tests/remedies.toml`; in Python by its package).

use std::fs;
use std::path::Path;

use asperity_contact_framework::remedy::{FrontEnd, REMEDIES};
use toml::{Table, Value};

use crate::results::{experiment, write_map};

const SIDE: usize = 160;

/// Heights of random waves of 7 points and more, r.m.s. 0.1 µm, as `test_remedies.py` makes them.
fn waves() -> Vec<f64> {
    let mut state = 12345_u64;
    let mut random = || {
        state = (state * 1103515245 + 12345) % (1 << 31);
        state as f64 / (1u64 << 31) as f64
    };
    let mut heights = vec![0.0; SIDE * SIDE];
    for _ in 0..150 {
        let [x, y, phase] = [0; 3].map(|_| random());
        let q = [x, y].map(|share| (48.0 * share).floor() - 24.0);
        let size = q[0].hypot(q[1]);
        if !(2.0..=24.0).contains(&size) {
            continue;
        }
        for (k, z) in heights.iter_mut().enumerate() {
            let along = q[0] * (k / SIDE) as f64 + q[1] * (k % SIDE) as f64;
            *z += size.powf(-1.8) * (std::f64::consts::TAU * (along / SIDE as f64 + phase)).cos();
        }
    }
    let rms = (heights.iter().map(|z| z * z).sum::<f64>() / heights.len() as f64).sqrt();
    heights.iter().map(|z| 1e-7 * z / rms).collect()
}

fn text_of(heights: &[f64], unit: f64) -> String {
    let line = |row: &[f64]| row.iter().map(|z| format!("{:.5}", z / unit)).collect::<Vec<_>>().join(" ");
    heights.chunks(SIDE).map(line).collect::<Vec<_>>().join("\n")
}

/// Writes an input and returns the name of its file.
fn input(folder: &Path, name: &str) -> String {
    let good = waves();
    let text = |text: String| {
        fs::write(folder.join("map.txt"), text).unwrap();
        "map.txt".to_owned()
    };
    let map = |height: &dyn Fn(usize, usize) -> f64| {
        write_map(folder.join("map.npy"), [SIDE; 2], height);
        "map.npy".to_owned()
    };
    let at = |i: usize, j: usize| good[i * SIDE + j];
    let random =
        |i: usize, j: usize| ((i * 7919 + j * 104729 + 13) * 2654435761 % 4294967296) as f64 / 4294967296.0;
    match name {
        "good" => map(&at),
        "ridges" => map(&|i, j| {
            let y = j as f64;
            0.05 * at(i, j) + 1e-7 * (0.9 * y + 2.5 * (0.37 * y).sin() + 1.7 * (0.113 * y).sin()).sin()
        }),
        "matrix" => text(text_of(&good, 1e-6)),
        "tall" => text(text_of(&good, 1e-9)),
        "marked" => {
            let marked = |(k, z): (usize, &f64)| if k % 900 < 2 { -9999e-6 } else { *z };
            text(text_of(&good.iter().enumerate().map(marked).collect::<Vec<f64>>(), 1e-6))
        }
        "columns" => {
            let line = |k: usize| format!("{} {} {:.3}\n", k % SIDE, k / SIDE, good[k] * 1e9);
            text("x[px] y[px] z[nm]\n".to_owned() + &(0..SIDE * SIDE).map(line).collect::<String>())
        }
        "channels" => {
            let samples =
                Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/asperity/tests/library/formats/samples");
            fs::copy(samples.join("st-nid-1.nid"), folder.join("map.nid")).unwrap();
            "map.nid".to_owned()
        }
        "debris" => map(&|i, j| at(i, j) + if i < 32 && random(i, j) < 0.08 { 3e-6 } else { 0.0 }),
        "debris-along-y" => map(&|i, j| at(i, j) + if j < 32 && random(i, j) < 0.08 { 3e-6 } else { 0.0 }),
        "spikes" => map(&|i, j| at(i, j) + if (i * SIDE + j) % 4999 == 17 { 2e-6 } else { 0.0 }),
        "lines" => map(&|i, j| at(i, j) + 1e-7 * random(0, j)),
        "form" => map(&|i, j| at(i, j) + 2e-7 * (i as f64 / 80.0 - 1.0).powi(2)),
        "long" => map(&|i, j| at(i, j) + 4e-7 * (std::f64::consts::TAU * 1.5 * i as f64 / SIDE as f64).sin()),
        "steps" => map(&|i, j| (at(i, j) / 1e-8).round() * 1e-8),
        "plateaus" => map(&|i, j| match (i % 2, j % 2, random(i, j)) {
            (1, 1, share) if share < 0.1 => 1e-12,
            (1, 1, share) => 1e-9 * (0.5 + share),
            _ => 0.0,
        }),
        "list" => {
            let line = |k: usize| format!("{:e},{:e}\n", 48e-9 * (2.0 * random(k, 3) - 1.0), 2e-5);
            let rows: String = (0..500).map(line).collect();
            fs::write(folder.join("list.csv"), format!("height [m],radius [m]\n{rows}")).unwrap();
            "list.csv".to_owned()
        }
        other => panic!("no input {other}"),
    }
}

/// What a run says in the terminal, and in the files of its report, which keep the keys of a spec; and whether it refused its input.
fn said(folder: &Path, arguments: &[String]) -> ([String; 2], bool) {
    let out = folder.join("out");
    let _ = fs::remove_dir_all(&out);
    let arguments = arguments.iter().map(String::as_str).chain(["--out", "out"]);
    let output = experiment(&arguments.collect::<Vec<_>>(), folder);
    let said =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    let mut written = String::new();
    for report in fs::read_dir(&out).into_iter().flatten().flatten() {
        for file in ["report.md", "fitness.csv"] {
            written += &fs::read_to_string(report.path().join(file)).unwrap_or_default();
        }
    }
    ([said, written], output.status.code() == Some(2))
}

/// The beginning of what was said.
fn short(said: &str) -> String {
    said.chars().take(1500).collect()
}

/// The words of a command line as a shell reads them.
fn shell(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), String::new(), None);
    for c in line.chars() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, ' ') => words.push(std::mem::take(&mut word)),
            _ => word.push(c),
        }
    }
    words.push(word);
    words
}

/// `key = value` of a spec, of a key with a point as a table.
fn assigned(key: &str, value: &Value) -> String {
    match key.split_once('.') {
        Some((table, key)) => format!("{table} = {{ {key} = {value} }}"),
        None if key == "hardness" => format!("material.PTFE.hardness = {value}"),
        None => format!("{key} = {value}"),
    }
}

#[test]
fn every_remedy_can_be_typed() {
    let cases: Table = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/remedies.toml"))
        .unwrap()
        .parse()
        .unwrap();
    let cases: Vec<&Table> =
        cases["remedy"].as_array().unwrap().iter().map(|case| case.as_table().unwrap()).collect();
    let covered = |key: &str| cases.iter().any(|case| case["key"].as_str() == Some(key));
    for remedy in REMEDIES {
        assert!(covered(remedy.key), "no input in tests/remedies.toml causes the advice of `{}`", remedy.key);
    }
    let mut wrong = Vec::new();
    for case in cases {
        let key = case["key"].as_str().unwrap();
        let remedy = REMEDIES.iter().find(|remedy| remedy.key == key).unwrap_or_else(|| panic!("{key}"));
        let says = case["says"].as_str().unwrap();
        let keys = |name: &str| case.get(name).and_then(Value::as_table).cloned().unwrap_or_default();
        let (mut of_file, mut of_compare) = (keys("file"), keys("compare"));
        let folder = tempfile::tempdir().unwrap();
        let file = input(folder.path(), case["input"].as_str().unwrap());
        let advice = assigned(key, &case["value"]);

        // In a spec.
        let spec = |of_file: &Table, of_compare: &Table, more: &str| {
            let lines = |table: &Table| {
                table.iter().map(|(key, value)| format!("{key} = {value}\n")).collect::<String>()
            };
            let mut compare = of_compare.clone();
            let is_list = remedy.table == "asperities";
            if !compare.contains_key("separation") {
                compare.insert("pressure".to_owned(), Value::from("1 MPa"));
            }
            let [top, compare_more, surface_more] = match remedy.table {
                "material" => [more, "", ""],
                "compare" => ["", more, ""],
                _ => ["", "", more],
            };
            let law = if more.starts_with("law") { "" } else { "law = \"zmc\"\n" };
            let surface = if is_list {
                format!("asperities]\nfile = \"{file}\"\nnominal-area = \"8e-9 m^2\"")
            } else {
                format!("file]\npath = \"{file}\"")
            };
            let text = format!(
                "title = \"t\"\nmaterial.steel.from = \"steel-100Cr6\"\nmaterial.PTFE.from = \"PTFE\"\n{top}\n[compare]\nrough = \"steel\"\n\
                 flat = \"steel\"\n{law}{}{compare_more}\n[surface.a.{surface}\n{}{surface_more}\n",
                lines(&compare),
                lines(of_file),
            );
            fs::write(folder.path().join("t.toml"), text).unwrap();
            said(folder.path(), &["run".to_owned(), "t.toml".to_owned()])
        };
        let name = |front_end: FrontEnd| {
            let of_key =
                if key == "hardness" { "material.PTFE.hardness" } else { key.split('.').next().unwrap() };
            match front_end {
                FrontEnd::Terminal => remedy.flag.unwrap_or("--set ").to_owned(),
                _ => of_key.to_owned(),
            }
        };
        let mut check = |front_end: FrontEnd, before: ([String; 2], bool), after: ([String; 2], bool)| {
            let case = format!("{key} ({front_end:?})");
            let [said, written] = before.0;
            let is_there = |texts: &[String; 2]| texts.iter().any(|text| text.contains(says));
            let advises = |text: &str, front_end| text.contains(says) && text.contains(&name(front_end));
            if !said.contains(says) && !written.contains(says) {
                wrong.push(format!("{case}: not said without it: {}", short(&said)));
            } else if !advises(&said, front_end) && !advises(&written, FrontEnd::Spec) {
                wrong.push(format!("{case}: does not advise {}: {}", name(front_end), short(&said)));
            } else if is_there(&after.0) || after.1 {
                wrong.push(format!("{case}: still there, or refused, with it: {}", short(&after.0[0])));
            }
        };
        of_file.remove(key);
        let before = spec(&keys("file"), &of_compare, "");
        let after = spec(&of_file, &of_compare, &advice);
        check(FrontEnd::Spec, before, after);

        // On the command line, of a measured file.
        if remedy.table == "asperities" {
            continue;
        }
        let typed = |table: &Table| -> Vec<String> {
            let one = |(key, value): (&String, &Value)| {
                shell(&FrontEnd::Terminal.text(&format!("`{key} = {value}`")).replace('`', ""))
            };
            table.iter().flat_map(one).collect()
        };
        let layer =
            of_compare.remove("layer").map_or_else(Vec::new, |_| shell("--layer PTFE --thickness '2 um'"));
        let set: Vec<String> = of_compare
            .iter()
            .flat_map(|(key, value)| ["--set".to_owned(), format!("compare.{key}={value}")])
            .collect();
        let look = |of_file: &Table, more: &[String]| {
            let begin = ["surface".to_owned(), file.clone()];
            said(folder.path(), &[&begin[..], &typed(of_file), &layer, &set, more].concat())
        };
        let more = shell(&FrontEnd::Terminal.text(&format!("`{advice}`")).replace('`', ""));
        let before = look(&keys("file"), &[]);
        let after = look(&of_file, &more);
        check(FrontEnd::Terminal, before, after);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
