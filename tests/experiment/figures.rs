//! `figure = { width, font }`: figures in the size of a journal, as SVG.

use std::fs;
use std::path::Path;

use asperity_contact_framework::folder;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

const SPEC: &str = concat!(
    "title = \"t\"\n",
    "FIGURE",
    steel!(),
    "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\npressure = [\"1 MPa\", \"2 MPa\", \"5 MPa\"]\n",
    "[surface.a.population]\n",
    case_1!(),
    "count = 2000\n"
);

fn spec(folder: &Path, figure: &str) -> std::path::PathBuf {
    let path = folder.join("small.toml");
    fs::write(&path, SPEC.replace("FIGURE", figure)).unwrap();
    path
}

/// Names and contents of the files of a report.
fn files(figure: &str) -> Vec<(String, Vec<u8>)> {
    let home = tempfile::tempdir().unwrap();
    let experiment = Experiment::read(&spec(home.path(), figure)).unwrap();
    let report = folder(&*experiment.run(&Silent).unwrap(), "key").unwrap();
    let out = home.path().join("out");
    asperity_contact_framework::report::store::Store::new(&out).write(&report).unwrap();
    report.names().map(|name| (name.to_owned(), fs::read(out.join("small").join(name)).unwrap())).collect()
}

#[test]
fn every_figure_is_in_the_size_of_print() {
    let printed = files("figure = { width = \"85 mm\", font = \"8 pt\" }\n");
    let plain = files("");
    // The picture of the index has its own size.
    let is_figure = |name: &str| name != "card.svg" && name.ends_with(".svg");
    let named = |files: &[(String, Vec<u8>)]| {
        files.iter().map(|(name, _)| name.clone()).filter(|name| is_figure(name)).collect::<Vec<_>>()
    };
    let figures = named(&printed);
    assert!(figures.len() >= 3 && figures == named(&plain), "{figures:?}");
    for (name, content) in &printed {
        if is_figure(name) {
            assert!(String::from_utf8_lossy(content).contains("width=\"85mm\""), "{name}");
        }
    }
    // The page shows them as wide as itself, as without the key.
    let page =
        |files: &[(String, Vec<u8>)]| files.iter().find(|(name, _)| name == "report.html").unwrap().1.len();
    assert!(page(&printed).abs_diff(page(&plain)) < 2000);
}

#[test]
fn sizes_that_no_journal_prints_are_refused() {
    let home = tempfile::tempdir().unwrap();
    for (figure, words) in [
        ("{ width = \"10 mm\" }", "found a width of 10 mm; allowed: 40 mm to 500 mm"),
        ("{ width = \"85 mm\", font = \"30 pt\" }", "found \"30 pt\"; allowed: a size of 4 to 24 points"),
        ("{ width = \"85 mm\", font = \"8 px\" }", "found \"8 px\""),
        ("{ font = \"8 pt\" }", "width"),
        ("{ width = \"85 mm\", height = 3 }", "height"),
    ] {
        let error =
            Experiment::read(&spec(home.path(), &format!("figure = {figure}\n"))).err().unwrap().to_string();
        assert!(error.contains(words) && error.contains("small.toml"), "{error}");
    }
}
