//! Specs without a file, and surfaces in memory: the results of the same in files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::{AsperityList, HeightMap};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::input::{InMemory, InputError, Source};
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use indexmap::IndexMap;

use crate::Report;
use crate::results::{number, table};

const COMPARE: &str = concat!(
    "title = \"t\"\n[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\nseparation = [1, 0]\nrobustness = false\n",
    steel!()
);
const LIST: &str = "[surface.a.asperities]\nfile = \"list.npy\"\nnominal-area = \"1 mm^2\"\n";
const MAP: &str = "[surface.a.file]\npath = \"map.npy\"\nlevel = \"none\"\n";
const POINTS: [usize; 2] = [24, 30];

fn run(folder: &Path, surface: &str, held: Vec<(&str, InMemory)>) -> Result<Box<dyn Outcome>, InputError> {
    let held: IndexMap<PathBuf, InMemory> =
        held.into_iter().map(|(path, held)| (path.into(), held)).collect();
    let source = Source::in_memory(folder, format!("{COMPARE}{surface}")).with_in_memory(held);
    Experiment::parse(source, "mine")?.run(&Silent)
}

/// A wave of two lengths, shifted along x.
fn heights(shift: usize) -> Vec<f64> {
    let turn = |index: usize, count: usize| std::f64::consts::TAU * index as f64 / count as f64;
    let height = |k: usize| {
        let (x, y) = ((k / POINTS[1] + shift) % POINTS[0], k % POINTS[1]);
        1e-7 * ((3.0 * turn(x, POINTS[0])).cos()
            + (2.0 * turn(y, POINTS[1])).sin()
            + turn(x, POINTS[0]).sin())
    };
    (0..POINTS[0] * POINTS[1]).map(height).collect()
}

fn map(shift: usize) -> InMemory {
    let map = HeightMap::new(POINTS, [1e-6; 2], heights(shift), f64::EPSILON).unwrap();
    InMemory::Map { rows: Arc::new(map), caveats: vec!["its file says `unit`.".to_owned()] }
}

fn list() -> (Vec<f64>, Vec<f64>) {
    (
        (0..40).map(|k| 1e-8 * f64::from(k * k % 41)).collect(),
        (0..40).map(|k| 1e-5 * f64::from(1 + k % 3)).collect(),
    )
}

#[test]
fn surfaces_in_memory_are_those_of_files() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::File::create(folder.path().join(name)).unwrap();
    asperity::npy::write(file("map.npy"), POINTS, heights(0)).unwrap();
    let (heights, radii) = list();
    let rows = heights.iter().zip(&radii).flat_map(|(z, r)| [*z, *r]);
    asperity::npy::write(file("list.npy"), [heights.len(), 2], rows).unwrap();
    let held = InMemory::List(Arc::new(AsperityList::new(heights, radii, None)));
    let with_pixel = format!("{MAP}pixel = \"1 um\"\n");
    for (in_files, in_memory, held) in
        [(LIST, LIST, ("list.npy", held)), (&*with_pixel, MAP, ("map.npy", map(0)))]
    {
        let files = run(folder.path(), in_files, Vec::new()).unwrap().files();
        let elsewhere = tempfile::tempdir().unwrap();
        assert_eq!(run(elsewhere.path(), in_memory, vec![held]).unwrap().files(), files);
    }
}

#[test]
fn a_map_in_memory_is_no_list() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |surface: &str, held| run(folder.path(), surface, vec![held]).err().unwrap().to_string();
    assert!(refused(LIST, ("list.npy", map(0))).contains("is a height map; allowed: a list of asperities"));
    let (heights, radii) = list();
    let list = InMemory::List(Arc::new(AsperityList::new(heights, radii, None)));
    let message = refused(MAP, ("map.npy", list));
    assert!(
        message.contains("is a list of asperities; allowed: a height map") && message.contains("dictionary")
    );
}

/// A periodic map has no border: all of its points are tested, wherever it begins.
#[test]
fn a_periodic_map_has_the_same_asperities_wherever_it_begins() {
    let folder = tempfile::tempdir().unwrap();
    let contacts = |surface: &str, shift| {
        let outcome = run(folder.path(), surface, vec![("map.npy", map(shift))]).unwrap();
        let rows = table(&*outcome, "comparison.csv").unwrap();
        let density = number(&rows[1], "deterministic_contact_density_per_m2");
        let summary = outcome.records();
        (density, summary["surfaces"]["a"]["asperities"].as_u64().unwrap())
    };
    let periodic = format!("{MAP}periodic = true\n");
    let found = [0, 5, 11].map(|shift| contacts(&periodic, shift));
    // Three waves along x and two along y.
    assert_eq!(found.map(|(_, asperities)| asperities), [6; 3]);
    assert!(found.iter().all(|(density, _)| (density / found[0].0 - 1.0).abs() < 1e-12));
    // At shift 0 a crest lies on the border of the map that does not continue.
    assert_eq!(contacts(MAP, 0).1, 4);
}

#[test]
fn the_page_of_a_spec_without_a_file_holds_the_spec() {
    let folder = tempfile::tempdir().unwrap();
    let (heights, radii) = list();
    let list = InMemory::List(Arc::new(AsperityList::new(heights, radii, None)));
    let outcome = run(folder.path(), LIST, vec![("list.npy", list)]).unwrap();
    let page = outcome.outline().files(None);
    let text = page.markdown;
    let again = text.split("How to run it again").nth(1).unwrap();
    assert!(again.contains("separation = [1, 0]") && !again.contains("experiment run dictionary"), "{again}");
}
