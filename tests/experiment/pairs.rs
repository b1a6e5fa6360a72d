//! `[surface.NAME.pair]`: two rough bodies.

use std::path::Path;

use asperity::compare::{ComparedQuantity, Estimate, Repeats};
use asperity::study::Basis;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use asperity_experiment::kind::compare::results::CompareResults;

use crate::Report;

const BODIES: &str = r#"
title = "t"
seed = 3
[material.steel]
young = "210 GPa"
poisson = 0.3
hardness = "7.6 GPa"
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
pressure = ["5 MPa", "10 MPa", "20 MPa"]
"#;

/// A generated surface.
fn body(name: &str, sigma: &str, points: usize) -> String {
    format!(
        "[surface.{name}.generate]\npoints = {points}\npixel = \"1 um\"\nsigma = \"{sigma}\"\n\
         spectrum.self-affine = {{ hurst = 0.8, roll-off = \"40 um\", cut-off = \"8 um\" }}\n"
    )
}

fn run(surfaces: &[&str]) -> Result<CompareResults, String> {
    compared("", surfaces)
}

fn compared(compare: &str, surfaces: &[&str]) -> Result<CompareResults, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pair.toml");
    std::fs::write(&path, [BODIES, compare, "\n", &surfaces.join("\n")].concat()).unwrap();
    let experiment = Experiment::read(&path).map_err(|error| error.to_string())?;
    let results: Box<dyn Outcome> = experiment.run(&Silent).map_err(|error| error.to_string())?;
    Ok(crate::downcast(results))
}

fn pair(keys: &str) -> String {
    format!("[surface.both.pair]\na = \"a\"\nb = \"b\"\n{keys}\n")
}

#[test]
fn a_rough_body_against_a_smooth_one_is_that_body() {
    let surfaces = [body("a", "100 nm", 512), body("b", "0.001 nm", 512), pair("shifts = 1")];
    let surfaces: Vec<&str> = surfaces.iter().map(String::as_str).collect();
    let results = compared("surfaces = [\"a\", \"both\"]", &surfaces).unwrap();
    let [alone, both] = &results.surfaces[..] else { panic!("two surfaces") };
    let points = |surface: usize| {
        let case = &results.surfaces[surface].cases[0];
        let at = case.results_at(1e7);
        at.models.iter().map(|model| model.point).collect::<Vec<_>>()
    };
    let files = (&results as &dyn Outcome).files();
    let (_, content) = files.iter().find(|(file, _)| *file == "smooth_bodies.csv").unwrap();
    let mut reader = csv::Reader::from_reader(&content[..]);
    let column = reader.headers().unwrap().iter().position(|name| name == "area_error").unwrap();
    let errors: Vec<f64> = reader.records().map(|row| row.unwrap()[column].parse().unwrap()).collect();
    assert!(errors.len() == 2 && errors.iter().all(|error| error.abs() < 1e-3), "{errors:?}");
    for (alone, both) in points(0).into_iter().zip(points(1)) {
        assert!((both.area_ratio / alone.area_ratio - 1.0).abs() < 1e-3, "{alone:?} {both:?}");
    }
    assert_eq!(alone.surface.set.count(), both.surface.set.count());
    assert_eq!((both.surface.repeats, both.cases[0].verdicts.shifts), (Repeats::Shifts, 1));
}

/// The heights of bodies that are independent add their variances, and asperities of the sum are higher and sharper than those of one.
#[test]
fn the_heights_of_both_bodies_add_up() {
    let results =
        run(&[&body("a", "60 nm", 512), &body("b", "80 nm", 512), &pair("shifts = 2\nrotations = true")])
            .unwrap();
    let sq = |surface: usize| results.surfaces[surface].surface.map.as_ref().unwrap().roughness.moments.sq;
    let expected = sq(0).hypot(sq(1));
    assert!((sq(2) / expected - 1.0).abs() < 0.05, "{} {expected}", sq(2));
    assert!(results.surfaces[2].surface.warnings.iter().any(|warning| warning.contains("turned by 0, 90")));
}

/// The interval of several relative positions holds that of the first alone, by blocks, and their scatter.
#[test]
fn relative_positions_share_the_heights() {
    let of = |keys: &str| {
        let results = run(&[&body("a", "100 nm", 1024), &body("b", "50 nm", 1024), &pair(keys)]).unwrap();
        results.surfaces.into_iter().nth(2).unwrap().cases.remove(0)
    };
    let [one, four] = [of("shifts = 1"), of("shifts = 4")];
    assert!(matches!(four.verdicts.basis, Basis::Blocks { .. }), "{:?}", four.verdicts.basis);
    let area = |at: usize, case: &asperity::study::CaseStudy| -> Estimate {
        case.verdicts.differences[at].estimates[ComparedQuantity::Area as usize].unwrap()
    };
    for at in 0..3 {
        let each: Vec<f64> = four
            .realisations
            .iter()
            .map(|case| case.differences[at].estimates[ComparedQuantity::Area as usize].unwrap().contrast)
            .collect();
        assert_eq!(each[0], area(at, &one).contrast, "the first position");
        let mean = each.iter().sum::<f64>() / 4.0;
        let variance = each.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / 3.0 / 4.0;
        let expected = (area(at, &one).error.unwrap().powi(2) + variance).sqrt();
        let found = area(at, &four);
        assert!(
            (found.error.unwrap() / expected - 1.0).abs() < 1e-12 && (found.contrast - mean).abs() < 1e-14
        );
        assert_eq!(found.quantile, area(at, &one).quantile);
    }
    let at = four.results_at(1e7);
    let sum = &at.models[1];
    let [low, high] = sum.intervals[ComparedQuantity::Area as usize].unwrap();
    assert!(low < sum.point.area_ratio && sum.point.area_ratio < high);
}

/// Maps that do not repeat count where they overlap; the finer one is resampled.
#[test]
fn measured_maps_overlap() {
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces/opd-1.npy");
    let map = map.display();
    let a = format!("[surface.a.file]\npath = \"{map}\"\npixel = \"200 nm\"\n");
    let b = format!("[surface.b.file]\npath = \"{map}\"\npixel = \"100 nm\"\ntranspose = true\n");
    let results = run(&[&a, &b, &pair("shifts = 2")]).unwrap();
    let [a, _, both] = &results.surfaces[..] else { panic!("three surfaces") };
    let facts = both.surface.map.as_ref().unwrap();
    assert_eq!(facts.pixel, [200e-9; 2]);
    assert!(facts.points[0] < a.surface.map.as_ref().unwrap().points[0]);
    let caveat = both.surface.warnings.iter().find(|warning| warning.contains("two rough bodies")).unwrap();
    assert!(
        caveat.contains("2 random relative positions") && caveat.contains("% of the smaller map"),
        "{caveat}"
    );
}

#[test]
fn bodies_without_one_map_are_refused() {
    let population = format!("[surface.b.population]\n{}count = 1000\n", case_1!());
    let a = body("a", "100 nm", 128);
    let refused = |b: &str, keys: &str, words: &str| {
        let error = run(&[&a, b, &pair(keys)]).unwrap_err();
        assert!(error.contains(words), "{error}");
    };
    refused(&population, "", "whose asperities have no height map");
    refused(
        &body("b", "50 nm", 128).replace("sigma", "realisations = 2\nsigma"),
        "",
        "2 realisations of \"b\"",
    );
    refused(&body("c", "50 nm", 128), "", "found \"b\"; allowed: a surface of this file");
    refused(&body("b", "50 nm", 256), "", "maps that repeat after 128 x 128 points");
    refused(&body("b", "50 nm", 128), "shifts = 0", "found 0; allowed: 1 to 1000");
    let second = "[surface.c.pair]\na = \"a\"\nb = \"both\"\n";
    let error = run(&[&a, &body("b", "50 nm", 128), &pair(""), second]).unwrap_err();
    assert!(error.contains("which is a pair"), "{error}");
}
