//! Columns of the tables: what a report holds is what `docs/reports.md` says.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use asperity_contact_framework::report::table::{Heading, Schema};
use asperity_experiment::kind::KINDS;

use crate::Report;
use crate::results::run_in;

/// Every table once, by its file.
fn schemas() -> BTreeMap<&'static str, Schema> {
    let mut all = BTreeMap::new();
    for schema in KINDS.iter().flat_map(|kind| (kind.tables)()) {
        let same = all.insert(schema.file, schema.clone());
        assert!(same.is_none_or(|same| same == schema), "two tables are called {}", schema.file);
    }
    all
}

#[test]
fn long_tables_are_not_under_version_control() {
    let ignored = committed(".gitignore");
    for (file, schema) in schemas() {
        assert_eq!(ignored.contains(&format!("/reports/*/{file}\n")), schema.is_long, "{file}");
    }
}

fn committed(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The columns of the tables that are read most.
#[test]
fn the_documentation_is_current() {
    let (page, schemas) = (committed("docs/reports.md"), schemas());
    for file in ["curves", "comparison", "differences", "verdicts", "robustness", "surfaces"] {
        let Schema { file, rows, columns, .. } = &schemas[format!("{file}.csv").as_str()];
        let lines = columns.iter().map(|column| {
            let Heading { name, unit, meaning, .. } = column;
            format!("| `{name}` | {unit} | {meaning} |\n")
        });
        let head = format!("## `{file}`\n\n{rows}\n\n| column | unit | meaning |\n|---|---|---|\n");
        let section = head + &lines.collect::<String>();
        assert!(page.contains(&section), "docs/reports.md does not hold the columns of {file}:\n\n{section}");
    }
}

/// The unit that the name of a column ends with.
fn unit_of(name: &str) -> Option<&'static str> {
    const SUFFIXES: [(&str, &str); 12] = [
        ("_s_per_m2", "S/m²"),
        ("_w_per_m2_k", "W/(m² K)"),
        ("curvature_per_m", "1/m"),
        ("_pa_per_m", "Pa/m"),
        ("_n_per_m", "N/m"),
        ("_per_m2", "1/m²"),
        ("_m2", "m²"),
        ("_m", "m"),
        ("_pa", "Pa"),
        ("_n", "N"),
        ("_bytes", "B"),
        ("_over_sigma", "1"),
    ];
    if name.starts_with("seconds_") {
        return Some("s");
    }
    SUFFIXES.iter().find(|(suffix, _)| name.ends_with(suffix)).map(|(_, unit)| *unit)
}

#[test]
fn headings_are_whole() {
    for (file, schema) in schemas() {
        assert!(schema.rows.starts_with("One row for each ") && schema.rows.ends_with('.'), "{file}");
        for (k, Heading { name, unit, meaning, .. }) in schema.columns.iter().enumerate() {
            let first = meaning.chars().next();
            assert!(
                first.is_some_and(char::is_uppercase) && meaning.ends_with('.'),
                "{file}, {name}: {meaning}"
            );
            assert!(!meaning.contains(['|', '\n']), "{file}, {name}: {meaning}");
            assert!(schema.columns[..k].iter().all(|other| other.name != *name), "{file}: {name} twice");
            match unit_of(name) {
                Some(expected) => assert_eq!(*unit, expected, "{file}, {name}"),
                None => assert!(
                    !["m", "m²", "Pa", "N", "s"].contains(unit),
                    "{file}, {name}: no suffix for {unit}"
                ),
            }
        }
    }
}

const COMPARE: &str = concat!(
    r#"
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
layer = { material = "lead", thickness = [0, "50 nm"], shear-strength = { tau0 = "33 MPa" } }
conductance = ["electrical", "thermal"]
shear-strength = { tau0 = "300 MPa", alpha = 0.05 }
models = ["statistical", "deterministic", "reference"]
separation = { values = [9, 2, 0] }
pressure = { values = ["20 MPa"] }
force = { values = ["1 mN"] }
"#,
    generated!("random", 256, "1 um", "100 nm", "40 um" to "3 um")
);

const CAUSES: &str = r#"
[causes]
rough = "steel"
flat = "steel"
law = "zmc"
skewness = [-0.5, 0]
wavelengths = [2, 4]
loads = [0.01]
realisations = 2
points = 256
cut-off-pixels = 8
hurst = 0.8
sigma = "100 nm"
gradient = 0.03
"#;

const LAWS: &str = r#"
[laws]
rough = "steel"
flat = "steel"
law = ["zmc", "hertz"]
asperity = { radius = "20 um" }
indentation = { from = 1e-2, to = 1e2, points = 5 }
pressure = { values = ["1 MPa", "10 MPa"] }
"#;

const SURFACE: &str = concat!("[surface.drawn.population]\ncount = 2000\n", case_1!());

const LIMIT: &str = concat!(
    "[limit]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\nseparation = { values = [1, 0] }\n\
     count = { values = [100, 1000] }\ndraws = 4\n",
    case_1!()
);

const INDENTATION: &str = r#"
[indentation]
ball = "steel"
radius = "1 mm"
flat = "steel"
layer = { material = "lead", thickness = "1 um" }
law = "zmc"
indentation = { from = "10 nm", to = "5 um", points = 5 }
overlay = "points.csv"
"#;

const SAMPLING_INTERVAL: &str = concat!(
    r#"
[sampling-interval]
rough = "steel"
flat = "steel"
law = "zmc"
pressure = { values = ["30 MPa"] }
intervals = [1, 2, 4]
s-filter = [1, 2, 3]
"#,
    generated!("random", 256, "0.5 um", "100 nm", "10 um" to "2 um")
);

const TILED: &str = concat!(
    "[tiled]\nrough = \"steel\"\nflat = \"lead\"\nlaw = \"zmc\"\nseparation = { from = 3, to = 0, points = 4 }\n",
    "[surface.a.population]\n",
    case_1!(),
    "count = 1000\n"
);

/// Programs whose short form is short.
const EVIDENCE: [&str; 4] = ["coverage", "coverage-of-small-maps", "grid-bounds", "solver-validation"];

/// The tables of a spec.
fn tables(spec: &str) -> Vec<(&'static str, Vec<u8>)> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("points.csv"), "indentation,load\n1e-7,1e-3\n3e-7,6e-3\n").unwrap();
    run_in(folder.path(), &format!("title = \"t\"\nseed = 1\n{spec}")).unwrap().files()
}

/// Whether a cell may stand in a column of this unit.
fn fits(cell: &str, unit: &str) -> bool {
    cell.is_empty()
        || match unit {
            "text" => cell.parse::<f64>().is_err(),
            "true/false" => cell.parse::<bool>().is_ok(),
            "count" => cell.parse::<u64>().is_ok(),
            _ => cell.parse::<f64>().is_ok_and(|number| !number.is_nan()),
        }
}

#[test]
fn every_kind_writes_the_tables_that_it_declares() {
    let bodies = concat!(steel!(), lead!());
    let specs = [
        ("causes", vec![[bodies, CAUSES].concat()]),
        ("compare", vec![[conducting!(), COMPARE].concat()]),
        ("evidence", EVIDENCE.map(|name| format!("[evidence]\nname = \"{name}\"\nfull = false\n")).to_vec()),
        ("indentation", vec![[bodies, INDENTATION].concat()]),
        ("laws", vec![[bodies, LAWS, SURFACE].concat()]),
        ("limit", vec![[bodies, LIMIT].concat()]),
        ("sampling-interval", vec![[bodies, SAMPLING_INTERVAL].concat()]),
        ("tiled", vec![[bodies, TILED].concat()]),
    ];
    assert!(KINDS.iter().map(|kind| kind.name).eq(specs.iter().map(|(kind, _)| *kind)));
    let all = KINDS.iter().zip(specs);
    for (kind, name, spec) in
        all.flat_map(|(kind, (name, all))| all.into_iter().map(move |spec| (kind, name, spec)))
    {
        let (declared, written) = ((kind.tables)(), tables(&spec));
        let files = |schemas: &[Schema]| schemas.iter().map(|schema| schema.file).collect::<Vec<_>>();
        // A table without rows may be left out.
        let names: Vec<&str> = written.iter().map(|(file, _)| *file).collect();
        let in_order = files(&declared).into_iter().filter(|file| names.contains(file));
        assert_eq!(in_order.collect::<Vec<_>>(), names, "{name}");
        for (file, content) in written {
            let schema = declared.iter().find(|schema| schema.file == file).unwrap();
            let mut reader = csv::Reader::from_reader(content.as_slice());
            let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
            // Reference and causes are there only where they were asked for, clusters of finite maps not here.
            let is_there = |heading: &&Heading| {
                heading.part.is_none_or(|part| name == "compare" && !part.ends_with("cluster"))
            };
            let columns: Vec<&Heading> = schema.columns.iter().filter(is_there).collect();
            assert_eq!(
                header,
                columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>(),
                "{file}"
            );
            let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
            assert!(!rows.is_empty(), "{name}, {file}");
            for (cell, Heading { name, unit, .. }) in
                rows.iter().flat_map(|row| row.iter().zip(columns.iter().copied()))
            {
                assert!(fits(cell, unit), "{file}, {name} [{unit}]: {cell}");
            }
        }
    }
}
