//! What is taken as independent in a list of asperities: the same summits as a map, as a list with and without places, and as draws.

use std::fmt::Write;

use asperity::HeightMap;
use asperity::surface::{Independence, Preparation, SummitSearch, Surface};
use asperity::topography::summits::Neighbours;
use asperity_contact_framework::Outcome;

use crate::results::{ON_STEEL, run_in, table, waves};

/// The summits of a random surface of waves up to `roll_off` (µm) on a map of 512 µm.
fn surface(roll_off: f64) -> Surface {
    let map = HeightMap::new([512; 2], [1e-6; 2], waves(512, [roll_off, 4.0], 3), 0.0).unwrap();
    let search = SummitSearch::new(Preparation::none(Neighbours::Four));
    SummitSearch { keeps_map: true, ..search }.surface("map", &map).unwrap()
}

/// A list of its summits with the places in µm, and without.
fn lists(surface: &Surface) -> [String; 2] {
    let prepared = surface.prepared.as_ref().unwrap();
    let [_, ny] = prepared.map.points();
    let mut lists = ["height [m], radius [m], x [um], y [um]\n".to_owned(), "height,radius\n".to_owned()];
    let both = surface.set.heights().iter().zip(surface.set.radii());
    for ((z, radius), place) in both.zip(&prepared.positions) {
        writeln!(lists[0], "{z:e},{radius:e},{},{}", place / ny, place % ny).unwrap();
        writeln!(lists[1], "{z:e},{radius:e}").unwrap();
    }
    lists
}

fn run(surface: &Surface) -> Box<dyn Outcome> {
    run_with_places_in(surface, "um")
}

/// The same where the places are said to be in another unit.
fn run_with_places_in(surface: &Surface, unit: &str) -> Box<dyn Outcome> {
    let folder = tempfile::tempdir().unwrap();
    let [with_places, plain] = lists(surface);
    let with_places = with_places.replace("[um]", &format!("[{unit}]"));
    let list = |name: &str, content: &str, key: &str| {
        std::fs::write(folder.path().join(format!("{name}.csv")), content).unwrap();
        let area = surface.set.nominal_area();
        format!("[surface.{name}.asperities]\nfile = \"{name}.csv\"\nnominal-area = {area:e}\n{key}\n")
    };
    let surfaces = list("places", &with_places, "")
        + &list("plain", &plain, "")
        + &list("drawn", &with_places, "independent = true");
    let loads = "pressure = { from = \"5 MPa\", to = \"60 MPa\", points = 5 }\n";
    run_in(folder.path(), &format!("{ON_STEEL}{loads}{surfaces}")).unwrap()
}

fn basis(outcome: &dyn Outcome, surface: &str) -> String {
    let rows = table(outcome, "cases.csv").unwrap();
    rows.iter().find(|row| row["surface"] == surface).unwrap()["basis"].clone()
}

/// Short waves leave enough blocks, of similar sides; waves as long as the map leave none, whichever way the summits are given.
#[test]
fn a_list_with_places_is_divided_as_its_map_is() {
    let short = surface(16.0);
    let of_list = |surface: &Surface| {
        let prepared = surface.prepared.as_ref().unwrap();
        let place = |axis: usize| {
            let at = move |&place: &usize| if axis == 0 { place / 512 } else { place % 512 };
            prepared.positions.iter().map(move |place| at(place) as f64 * 1e-6).collect::<Vec<f64>>()
        };
        Independence::of_places(surface.set.heights(), [&place(0), &place(1)])
    };
    let (Independence::Blocks(map), (Independence::Blocks(list), Some(halves))) =
        (&short.independence, &of_list(&short))
    else {
        panic!("{:?}", short.independence)
    };
    for axis in 0..2 {
        let ratio = list.correlation.lengths[axis] / map.correlation.lengths[axis];
        assert!((0.8..3.0).contains(&ratio), "{ratio}");
    }
    let half = halves.only(&short.set, 0).unwrap().count() as f64 / short.set.count() as f64;
    assert!((half - 0.5).abs() < 0.05, "{half}");
    let outcome = run(&short);
    assert_eq!(
        ["places", "plain", "drawn"].map(|name| basis(&*outcome, name)),
        ["blocks", "none", "independent"]
    );
    let warnings = outcome.warnings();
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert!(warning.contains("plain") && warning.contains("`independent = true`"), "{warning}");
    assert!(warning.contains("columns `x` and `y`"), "{warning}");

    let long = surface(500.0);
    assert!(matches!(long.independence, Independence::TooSmall(_)));
    assert!(matches!(of_list(&long).0, Independence::TooSmall(_)));
    let outcome = run(&long);
    assert_eq!(
        ["places", "plain", "drawn"].map(|name| basis(&*outcome, name)),
        ["none", "none", "independent"]
    );
    // Only what is said to be drawn carries a verdict.
    let rows = table(&*outcome, "verdicts.csv").unwrap();
    let told = |name: &str| {
        rows.iter().any(|row| row["surface"] == name && ["within", "beyond"].contains(&&*row["verdict"]))
    };
    assert_eq!(["places", "plain", "drawn"].map(told), [false, false, true]);
    let limits: Vec<_> = rows.iter().filter(|row| row["surface"] == "plain").collect();
    assert!(!limits.is_empty() && limits.iter().all(|row| row["low"].is_empty()));
}

#[test]
fn places_in_another_unit_are_noticed() {
    let warnings = |unit: &str| run_with_places_in(&surface(16.0), unit).warnings();
    let are_noticed =
        |warnings: &[String]| warnings.iter().any(|warning| warning.contains("the columns x and y span"));
    assert!(are_noticed(&warnings("mm")) && !are_noticed(&warnings("um")));
}
