//! `figure = { width, font }`: figures in the size of a journal, as SVG.

use std::fs;

use asperity_contact_framework::folder;
use asperity_contact_framework::report::store::Store;

use crate::results::run;

const SPEC: &str = concat!(
    "title = \"t\"\n",
    "FIGURE",
    steel!(),
    "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\npressure = [\"1 MPa\", \"2 MPa\", \"5 MPa\"]\n",
    "[surface.a.population]\n",
    case_1!(),
    "count = 2000\n"
);

/// Names and contents of the files of a report.
fn files(figure: &str) -> Vec<(String, Vec<u8>)> {
    let home = tempfile::tempdir().unwrap();
    let report = folder(&*run(&SPEC.replace("FIGURE", figure)).unwrap(), "key").unwrap();
    Store::new(home.path()).write(&report).unwrap();
    report
        .names()
        .map(|name| (name.to_owned(), fs::read(home.path().join("t").join(name)).unwrap()))
        .collect()
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
