//! docs/tutorial.md, word for word: its commands run in a shell, its spec is saved, and what it quotes is in their output.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The fenced blocks of a document: their language and their text.
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
    let mut kinds = BTreeSet::new();
    for (language, text) in blocks(&tutorial) {
        kinds.insert(language.to_owned());
        match language {
            // Each block is a shell of its own, and `cd` holds for those after it.
            "sh" => {
                printed = run(&text, &folder);
                for line in text.lines() {
                    folder = line.strip_prefix("cd ").map_or(folder.clone(), |to| folder.join(to));
                }
            }
            "toml" => fs::write(folder.join("coating.toml"), text).unwrap(),
            "text" => {
                let report = fs::read_to_string(folder.join("reports/coating/report.md")).unwrap_or_default();
                for line in text.lines() {
                    assert!(printed.contains(line) || report.contains(line), "{line}\nis not in\n{printed}");
                }
            }
            "console" => {}
            other => panic!("a block of {other}"),
        }
    }
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), ["console", "sh", "text", "toml"]);

    // The numbers of its sentences.
    let curves = fs::read_to_string(folder.join("reports/coating/curves.csv")).unwrap();
    let elastic = |model: &str, thickness: &str| -> f64 {
        let row = curves.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let mut row = row.filter(|row| row[4] == model && row[3] == thickness && row[6] == "10000000.0");
        row.next().unwrap()[15].parse().unwrap()
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
    let mut header = curves.lines().next().unwrap().split(',');
    let column = header.position(|name| name == "contact_radius_over_thickness").unwrap();
    let widest = |thickness: &str| {
        let rows = curves.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let rows = rows.filter(|row| row[3] == thickness).filter_map(|row| row[column].parse::<f64>().ok());
        rows.reduce(f64::max).unwrap()
    };
    assert!(widest("1e-7") > 1.0 && widest("2e-7") < 1.0, "wider than the layer below 200 nm only");
    assert!(elastic("statistical", "2e-8") > 0.9995);
}
