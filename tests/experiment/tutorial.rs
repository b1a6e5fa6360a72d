//! docs/tutorial.md, word for word: its commands run in a shell, each spec is saved under the name beside `toml`, and what it quotes is in their
//! output or in the report of the last spec that ran. Its Python is run by `crates/asperity-python/tests/test_tutorial.py`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::results::{Row, number, rows};

/// The fenced blocks of a document: their language (and the name of a file) and their text.
fn blocks(markdown: &str) -> Vec<(&str, String)> {
    let mut blocks = Vec::new();
    let mut open: Option<(&str, String)> = None;
    for line in markdown.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(language), None) => open = Some((language, String::new())),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some((_, text))) => {
                text.push_str(line);
                text.push('\n');
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is not closed");
    blocks
}

/// Runs a command as a user would, after the others in `folder`, and returns all that it printed.
fn run(script: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_experiment")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let output =
        Command::new("sh").args(["-c", script]).env("PATH", path).current_dir(folder).output().unwrap();
    [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat()
}

#[test]
fn the_tutorial_holds_what_it_says() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR"));
    let home = tempfile::tempdir().unwrap();
    let surfaces = home.path().join("experiments/surfaces");
    fs::create_dir_all(&surfaces).unwrap();
    fs::copy(repository.join("experiments/surfaces/opd-1.npy"), surfaces.join("opd-1.npy")).unwrap();
    let tutorial = fs::read_to_string(repository.join("docs/tutorial.md")).unwrap();

    let mut folder = home.path().to_owned();
    let mut printed = String::new();
    let mut report = String::new();
    let mut kinds = BTreeSet::new();
    for (info, text) in blocks(&tutorial) {
        let (language, name) = info.split_once(' ').unwrap_or((info, ""));
        kinds.insert(language.to_owned());
        match language {
            // Each block is a shell of its own, and `cd` holds for those after it.
            "sh" => {
                printed = run(&text, &folder);
                for line in text.lines() {
                    folder = line.strip_prefix("cd ").map_or(folder.clone(), |to| folder.join(to));
                }
                let spec = text
                    .lines()
                    .rev()
                    .find_map(|line| line.strip_prefix("experiment run ")?.strip_suffix(".toml"));
                if let Some(spec) = spec {
                    report = fs::read_to_string(folder.join("reports").join(spec).join("report.md")).unwrap();
                }
            }
            "toml" => fs::write(folder.join(name), text).unwrap(),
            "text" => {
                for line in text.lines() {
                    assert!(printed.contains(line) || report.contains(line), "{line}\nis not in\n{printed}");
                }
            }
            "console" | "python" => {}
            other => panic!("a block of {other}"),
        }
    }
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), ["console", "python", "sh", "text", "toml"]);
    coating_sentences(&tutorial, &folder);
    design_sentences(&tutorial, &folder);
}

/// The numbers in the sentences of part 1.
fn coating_sentences(tutorial: &str, folder: &Path) {
    let curves = table(folder, "coating", "curves.csv");
    let elastic = |model: &str, thickness: &str| {
        let cells = [("model", model), ("layer_thickness_m", thickness), ("target", "10000000.0")];
        cell(&curves, &cells, "elastic_load_share")
    };
    for (model, thickness, percent) in [
        ("deterministic", "0.0", "42 % of the load is carried by elastic contacts"),
        ("deterministic", "1e-8", "raise this to 73 %"),
        ("deterministic", "2e-6", "2 µm to 81 %"),
        ("statistical", "0.0", "it has 89 % of the load elastic"),
    ] {
        assert!(tutorial.contains(percent), "{percent}");
        let stated: f64 = percent.split(" %").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
        assert!((100.0 * elastic(model, thickness) - stated).abs() <= 0.5, "{percent}");
    }
    let growth = elastic("deterministic", "2e-6") - elastic("deterministic", "2e-7");
    assert!((100.0 * growth - 3.0).abs() <= 0.5, "{growth}");
    let widest = |thickness: &str| {
        let rows = curves.iter().filter(|row| row["layer_thickness_m"] == thickness);
        let ratios = rows.filter_map(|row| row["contact_radius_over_thickness"].parse::<f64>().ok());
        ratios.reduce(f64::max).unwrap()
    };
    assert!(widest("1e-7") > 1.0 && widest("2e-7") < 1.0, "wider than the layer below 200 nm only");
    assert!(elastic("statistical", "2e-8") > 0.9995);
}

fn table(folder: &Path, report: &str, name: &str) -> Vec<Row> {
    rows(&fs::read(folder.join("reports").join(report).join(name)).unwrap())
}

/// The number in a column of the first row whose cells are as given.
fn cell(rows: &[Row], cells: &[(&str, &str)], column: &str) -> f64 {
    let is_it = |row: &&Row| cells.iter().all(|(name, cell)| row[*name] == *cell);
    number(rows.iter().find(is_it).unwrap(), column)
}

/// The numbers in the sentences of part 2: each part begins with the number that is compared.
fn design_sentences(tutorial: &str, folder: &Path) {
    let sum = [("model", "deterministic")];
    let results = table(folder, "design", "results.csv");
    let result = |column: &str| cell(&results, &sum, column);
    let verdicts = table(folder, "design", "verdicts.csv");
    let verdict = |quantity: &str, column: &str| 100.0 * cell(&verdicts, &[("quantity", quantity)], column);
    let area = result("real_area_m2");
    let fine = cell(&table(folder, "sq-0.1", "results.csv"), &sum, "elastic_load_share");
    let of_area = [("quantity", "area")];
    let finest = ["sq-0.2", "sq-0.1", "sq-0.05"]
        .map(|report| cell(&table(folder, report, "verdicts.csv"), &of_area, "difference"));
    let layers = table(folder, "thickness", "results.csv");
    let under = |t: &str| cell(&layers, &[sum[0], ("layer_thickness_m", t)], "real_area_m2");
    for (sentence, value, rounding) in [
        ("36 µm² on average", 1e12 * area / result("contacts"), 0.5),
        ("97 % of the load on contacts that have yielded", 100.0 * result("elastic_plastic_load_share"), 0.5),
        ("16 to 20 %, more than the 10 %", verdict("area", "low"), 0.5),
        ("20 %, more than the 10 %", verdict("area", "high"), 0.5),
        ("4,100 µm² at 1.22 GPa; the bronze", 1e12 * area, 5.0),
        ("18 % too much area.", verdict("area", "difference"), 0.5),
        ("4,100 µm² (95 % interval of the mean", 1e12 * area, 5.0),
        ("4,030 to 4,170 µm²)", 1e12 * result("real_area_low_m2"), 5.0),
        ("4,170 µm²)", 1e12 * result("real_area_high_m2"), 5.0),
        ("0.1 % of the nominal area", 100.0 * result("area_ratio"), 0.05),
        ("114 contacts at a mean contact pressure", result("contacts"), 0.5),
        ("1.22 GPa.", 1e-9 * result("mean_real_pressure_pa"), 0.005),
        (
            "97 % of the load is carried by elastic-plastic contacts",
            100.0 * result("elastic_plastic_load_share"),
            0.5,
        ),
        ("2.6 % more than", 100.0 * (under("5e-6") / under("0.0") - 1.0), 0.05),
        ("89 % of the load elastic", 100.0 * fine, 0.5),
        ("18 % too much area (16", verdict("area", "difference"), 0.5),
        ("16 to 20 %), and", verdict("area", "low"), 0.5),
        ("20 %), and", verdict("area", "high"), 0.5),
        ("32 % at finer finishes", 100.0 * finest.into_iter().fold(0.0, f64::max), 0.5),
        ("4 to 13.5 %", verdict("stiffness", "low"), 0.5),
        ("13.5 %", verdict("stiffness", "high"), 0.05),
    ] {
        assert!(tutorial.contains(sentence), "{sentence}");
        let stated: f64 = sentence.split(' ').next().unwrap().replace(',', "").parse().unwrap();
        assert!((value - stated).abs() <= rounding, "{sentence}: {value}");
    }
    assert!(result("plastic_load_share") == 0.0, "none of them fully plastic");
    // The bronze is the softest body: the effective hardness of the coated one decides nothing, although contacts are wider than the layer.
    let report = fs::read_to_string(folder.join("reports/design/report.md")).unwrap();
    assert!(!report.contains("shares of yielding are uncertain"));
}
