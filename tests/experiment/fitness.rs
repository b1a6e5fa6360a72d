//! Fitness of measured maps: each fault planted in a good map is found, blocks the verdict, and its remedy gives the verdict
//! back; the verdicts under other treatments of a map.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use asperity::MeanRadius;
use asperity::compare::{ComparedQuantity, Difference, Verdict};
use asperity::study::{Choice, Treatment};
use asperity::surface::Surface;
use asperity::topography::Level;
use asperity::topography::fitness::Check;
use asperity::topography::summits::Neighbours;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use asperity_experiment::kind::compare::results::{CompareResults, SurfaceResults};
use asperity_experiment::surface::fitness::in_short;
use rand::{RngExt, SeedableRng};

use crate::Report;
use crate::results::{table, waves, write_map};

const SIDE: usize = 640;

/// A map of Sq 0.1 um on pixels of 1 um, with the shortest waves `cut_off` pixels long.
fn good(cut_off: f64) -> Vec<f64> {
    waves(SIDE, [32.0, cut_off], 9)
}

fn write(folder: &Path, name: &str, height: impl Fn(usize, usize) -> f64) {
    write_map(folder.join(name), [SIDE; 2], height);
}

/// Both models on maps, each a name, a file and further keys.
fn run(folder: &Path, more: &str, maps: &[(&str, &str, &str)]) -> Box<dyn Outcome> {
    Experiment::read(&spec(folder, more, maps)).unwrap().run(&Silent).unwrap()
}

/// The spec of such a comparison.
fn spec(folder: &Path, more: &str, maps: &[(&str, &str, &str)]) -> PathBuf {
    let surfaces: String = maps
        .iter()
        .map(|(name, file, keys)| {
            format!("[surface.{name}.file]\npath = \"{file}\"\npixel = \"1 um\"\n{keys}\n")
        })
        .collect();
    let spec = format!(
        "title = \"t\"\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n\
         pressure = {{ from = \"1 MPa\", to = \"40 MPa\", points = 9 }}\n{more}\n{surfaces}",
        steel!()
    );
    let path = folder.join("fitness.toml");
    std::fs::write(&path, spec).unwrap();
    path
}

fn failed(found: &SurfaceResults) -> Vec<Check> {
    found
        .surface
        .fitness()
        .iter()
        .filter(|finding| finding.is_blocking())
        .map(|finding| finding.check)
        .collect()
}

/// The verdict on each quantity at each load, where it is valid.
fn verdicts(found: &SurfaceResults) -> Vec<Option<Verdict>> {
    let verdicts = &found.cases[0].verdicts;
    let at_each = verdicts.differences.iter().flat_map(|at| {
        ComparedQuantity::ALL.map(|quantity| {
            let estimate = at.estimates[quantity as usize].filter(|_| at.exceeded().is_none())?;
            Some(Verdict::from_estimate(&estimate, verdicts.accepted.band(quantity)))
        })
    });
    at_each.collect()
}

/// How many of two lists of verdicts are the same, and how many contradict each other.
fn agreement(one: &SurfaceResults, other: &SurfaceResults) -> (usize, usize, usize) {
    let pairs: Vec<(Verdict, Verdict)> =
        verdicts(one).into_iter().zip(verdicts(other)).filter_map(|(a, b)| Some((a?, b?))).collect();
    let same = pairs.iter().filter(|(a, b)| a == b).count();
    let is_told = |verdict: Verdict| verdict != Verdict::CannotTell;
    let opposite = pairs.iter().filter(|(a, b)| a != b && is_told(*a) && is_told(*b)).count();
    (pairs.len(), same, opposite)
}

#[test]
fn planted_faults_are_found_and_their_remedies_give_the_verdict_back() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(8.0);
    let at = |i: usize, j: usize| base[i * SIDE + j];
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(4);
    let offsets: Vec<f64> = (0..SIDE).map(|_| rng.random_range(-1e-7..1e-7)).collect();
    let bad: Vec<[usize; 2]> = (0..6).map(|_| [0; 2].map(|_| rng.random_range(0..SIDE))).collect();
    let step = 2.5e-8;
    let from_centre = |i: usize| i as f64 / (0.5 * SIDE as f64) - 1.0;
    write(folder.path(), "good.npy", at);
    write(folder.path(), "spikes.npy", |i, j| at(i, j) + if bad.contains(&[i, j]) { 2e-6 } else { 0.0 });
    write(folder.path(), "form.npy", |i, j| at(i, j) + 2e-7 * from_centre(i).powi(2));
    write(folder.path(), "lines.npy", |i, j| at(i, j) + offsets[j]);
    write(folder.path(), "steps.npy", |i, j| (at(i, j) / step).round() * step);
    write(folder.path(), "lay.npy", |i, j| at(i, j) + 1.5e-7 * (TAU * (i + j) as f64 / 20.0).sin());
    let filter = "filter = { s = \"12 um\" }";
    let results: CompareResults = crate::downcast(run(
        folder.path(),
        "robustness = false",
        &[
            ("good", "good.npy", ""),
            ("smooth", "good.npy", filter),
            ("spikes", "spikes.npy", ""),
            ("form", "form.npy", ""),
            ("lines", "lines.npy", ""),
            ("steps", "steps.npy", ""),
            ("lay", "lay.npy", ""),
            ("no-spikes", "spikes.npy", "outliers = \"remove\""),
            ("no-form", "form.npy", "level = \"quadratic\""),
            ("no-lines", "lines.npy", "align-lines = \"x\""),
            ("no-steps", "steps.npy", filter),
            ("eight", "lay.npy", "neighbours = \"eight\""),
        ],
    ));
    let of = |name: &str| results.surfaces.iter().find(|found| found.surface.name == name).unwrap();
    assert!(failed(of("good")).is_empty(), "{:?}", of("good").surface.fitness());
    assert!(verdicts(of("good")).contains(&Some(Verdict::Within)));
    for (name, check) in [
        ("spikes", Check::Spikes),
        ("form", Check::Form),
        ("lines", Check::Lines),
        ("steps", Check::Steps),
        ("lay", Check::Lay),
    ] {
        assert!(failed(of(name)).contains(&check), "{name}: {:?}", of(name).surface.fitness());
        assert!(of(name).cases[0].verdicts.is_blocked);
        // A lay is part of the surface, which only another measurement can turn.
        if check == Check::Lay {
            assert!(failed(of("eight")).contains(&Check::Lay));
            continue;
        }
        let remedied = of(&format!("no-{name}"));
        assert!(failed(remedied).is_empty(), "{name}: {:?}", remedied.surface.fitness());
        let reference = match check {
            Check::Steps => of("smooth"),
            _ => of("good"),
        };
        let (count, same, opposite) = agreement(reference, remedied);
        assert!(
            count > 12 && opposite == 0 && 10 * same >= 9 * count,
            "{name}: {same} of {count}, {opposite}"
        );
    }
    // Each fault is found for what it is.
    assert_eq!(failed(of("spikes")), [Check::Spikes]);
    assert_eq!(failed(of("form"))[0], Check::Form);
    let summary = (&results as &dyn Outcome).records();
    let blocked = |name: &str| {
        let rows = summary["verdicts"].as_array().unwrap().iter().filter(|row| row["surface"] == name);
        rows.map(|row| row["verdict"] == "blocked").collect::<Vec<bool>>()
    };
    assert!(blocked("spikes").iter().all(|is_blocked| *is_blocked) && !blocked("spikes").is_empty());
    assert!(blocked("good").iter().all(|is_blocked| !is_blocked));
    // A blocked map gets neither a cause nor a model to use.
    let said = |file: &str, column: &str, name: &str| {
        let rows = table(&results, file).unwrap();
        rows.iter().filter(|row| row["surface"] == name && !row[column].is_empty()).count()
    };
    for [file, column] in [["statistical_models.csv", "cheapest_within"], ["verdicts.csv", "largest_on_map"]]
    {
        assert!(said(file, column, "good") > 0 && said(file, column, "spikes") == 0, "{file}, {column}");
    }
    let page = (&results as &dyn Outcome).outline().markdown();
    assert!(page.contains("unfit map in 6."), "{page}");
}

/// The preparation that `fit` finds gives the same to the bit as its keys written by hand, which it states, and remedies what was
/// planted; keys beside it are kept.
#[test]
fn a_fit_remedies_planted_faults_as_its_keys_by_hand_do() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(8.0);
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(4);
    let offsets: Vec<f64> = (0..SIDE).map(|_| rng.random_range(-5e-8..5e-8)).collect();
    let bad: Vec<[usize; 2]> = (0..6).map(|_| [0; 2].map(|_| rng.random_range(0..SIDE))).collect();
    let from_centre = |i: usize| i as f64 / (0.5 * SIDE as f64) - 1.0;
    let noise: Vec<f64> = (0..SIDE * SIDE).map(|_| rng.random_range(-1e-8..1e-8)).collect();
    write(folder.path(), "faulty.npy", |i, j| {
        let spike = if bad.contains(&[i, j]) { 2e-6 } else { 0.0 };
        base[i * SIDE + j] + noise[i * SIDE + j] + offsets[j] + 2e-7 * from_centre(i).powi(2) + spike
    });
    let fitted = "fit = \"auto\"";
    let found: CompareResults = crate::downcast(run(
        folder.path(),
        "robustness = false",
        &[("fitted", "faulty.npy", fitted), ("kept", "faulty.npy", "fit = \"auto\"\noutliers = \"keep\"")],
    ));
    assert!(failed(&found.surfaces[0]).is_empty(), "{:?}", found.surfaces[0].surface.fitness());
    assert_eq!(failed(&found.surfaces[1]), [Check::Spikes]);
    let rows = table(&found, "fit_steps.csv").unwrap();
    let steps = |name: &str| {
        let rows = rows.iter().filter(|row| row["surface"] == name);
        rows.map(|row| ["check", "remedy", "result"].map(|column| row[column].clone())).collect::<Vec<_>>()
    };
    let of = steps("fitted");
    let applied: Vec<&str> = of.iter().map(|[check, ..]| check.as_str()).collect();
    assert_eq!(applied, ["spikes", "lines", "form", "fine-pixel"], "{of:?}");
    assert!(of.iter().all(|[_, _, result]| result == "applied"));
    let kept = &steps("kept");
    assert!(kept.iter().any(|[check, _, result]| check == "spikes" && result == "refused"), "{kept:?}");
    let page = (&found as &dyn Outcome).outline().markdown();
    let (_, block) = page.split_once("# The same by hand").unwrap();
    let keys = block.split("```").nth(1).unwrap().strip_prefix("toml\n").unwrap();
    assert!(keys.contains("align-lines = \"x\"") && keys.contains("filter = { s = "), "{keys}");
    assert!(page.contains("fitted-heights-before.svg"));
    let by_hand: CompareResults =
        crate::downcast(run(folder.path(), "robustness = false", &[("fitted", "faulty.npy", keys)]));
    let [auto, hand] = [&found, &by_hand].map(|results| &results.surfaces[0].surface);
    assert_eq!(auto.set.heights(), hand.set.heights());
    assert_eq!(auto.set.radii(), hand.set.radii());
    assert_eq!(verdicts(&found.surfaces[0]), verdicts(&by_hand.surfaces[0]));
    assert!(hand.fit.is_none() && auto.warnings[0].contains("found by `fit`"), "{:?}", auto.warnings);
}

/// The fault of a map that is not fit on a card, in full, and its warnings.
fn said(surface: &Surface) -> String {
    format!("{} {}", in_short(surface)[0], surface.warnings.join(" "))
}

/// A map that blocks names its next step and `--fit`, unless `fit` is there or cannot help: steep flanks, and units.
#[test]
fn the_next_step_names_the_fit_where_it_helps() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(8.0);
    write(folder.path(), "bow.npy", |i, j| base[i * SIDE + j] + 1e-11 * (i as f64 - 320.0).powi(2));
    write(folder.path(), "flanks.npy", |i, j| 80.0 * base[i * SIDE + j]);
    write(folder.path(), "units.npy", |i, j| 1e6 * base[i * SIDE + j]);
    write(folder.path(), "many.npy", |i, j| base[i * SIDE + j] + if i % 8 + j % 8 == 0 { 3e-6 } else { 0.0 });
    let maps = [
        ("bow", "bow.npy", ""),
        ("flanks", "flanks.npy", ""),
        ("units", "units.npy", ""),
        ("many", "many.npy", ""),
        ("fitted", "many.npy", "fit = \"auto\""),
    ];
    let results: CompareResults = crate::downcast(run(folder.path(), "robustness = false", &maps));
    let step = |k: usize| said(&results.surfaces[k].surface);
    assert!(step(0).contains("; `level = \"quadratic\"`; try `fit = \"auto\"`."), "{}", step(0));
    assert!(step(1).contains("steep flanks") && step(1).contains("assumes small slopes"), "{}", step(1));
    assert!(!step(1).contains("units") && !step(1).contains("auto"), "{}", step(1));
    assert!(step(2).contains("in different units") && !step(2).contains("auto"), "{}", step(2));
    // More than single wrong points: no advice to remove them, and none that a fit refused.
    assert!(
        step(3).contains("more than 1 % of the points stand out") && !step(3).contains("outliers"),
        "{}",
        step(3)
    );
    assert!(
        step(4).contains("`fit` refused `outliers = \"remove\"`, because 1.56 % of the points"),
        "{}",
        step(4)
    );
}

/// Where `fit` refused an L filter the waves belong to the surface: the next step is a larger map, of a size, in all places that
/// name a remedy.
#[test]
fn waves_that_belong_to_the_surface_need_a_larger_map() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    std::fs::copy(root.join("experiments/surfaces/unfit/di-4.npy"), folder.path().join("di.npy")).unwrap();
    let maps =
        [("di", "di.npy", "fit = \"auto\"\noutliers = \"remove\"\nlevel = \"cubic\"\nalign-lines = \"x\"")];
    let results: CompareResults = crate::downcast(run(folder.path(), "robustness = false", &maps));
    let surface = &results.surfaces[0].surface;
    let finding = surface.fitness().iter().find(|finding| finding.check == Check::LongWaves).unwrap();
    assert!(finding.is_blocking(), "{finding:?}");
    let side = 512e-6 * finding.value / finding.threshold();
    let warning = surface.warnings.iter().find(|warning| warning.starts_with("long-waves")).unwrap();
    let (_, stated) = warning.split_once("Remedy: a larger map, at least ").unwrap();
    let (x, rest) = stated.split_once(" µm along x and ").unwrap();
    let stated = 1e-6 * x.parse::<f64>().unwrap();
    assert!(stated >= 0.999 * side && stated < 1.1 * side, "{stated} {side}");
    assert!(rest.starts_with(x) && rest.contains("`fit` refused `filter = { l = "), "{rest}");
    assert!(!warning.contains("part of the map") && !warning.contains("or an L filter"), "{warning}");
    let blocking: Vec<Check> = failed(&results.surfaces[0]);
    if blocking == [Check::LongWaves] {
        let step = &in_short(surface)[0];
        assert!(step.contains("it is too small for its long waves; a larger map, at least "), "{step}");
    }
    let fitted = surface.warnings.iter().find(|warning| warning.starts_with("`fit`")).unwrap();
    assert!(fitted.contains("long-waves") && fitted.contains("no verdict may rest on it"), "{fitted}");
}

/// Heights cut off at the top, or missing points written as 0, block the verdict and are named; heights on steps, and measured
/// surfaces, have no such height.
#[test]
fn heights_that_many_points_share_block_and_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(8.0);
    let at = |i: usize, j: usize| base[i * SIDE + j];
    write(folder.path(), "clipped.npy", |i, j| at(i, j).min(2e-7));
    write(folder.path(), "filled.npy", |i, j| {
        if (100..160).contains(&i) && (200..260).contains(&j) { 0.0 } else { at(i, j) }
    });
    write(folder.path(), "stepped.npy", |i, j| (at(i, j) / 4e-9).round() * 4e-9);
    let mut maps = vec![
        ("clipped", "clipped.npy", ""),
        ("filled", "filled.npy", ""),
        ("marked", "filled.npy", "missing = 0"),
        ("stepped", "stepped.npy", ""),
        ("good", "filled.npy", "missing = 0\nfit = \"auto\""),
    ];
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces");
    let measured = ["al3d-1", "opd-1", "plu-1", "unfit/bcrf-1", "unfit/mi-1", "unfit/sur-2", "unfit/tmd-1"];
    let names: Vec<String> =
        measured.iter().map(|name| format!("{}.npy", root.join(name).display())).collect();
    let plain: Vec<String> = measured.iter().map(|name| name.replace('/', "-")).collect();
    maps.extend(plain.iter().zip(&names).map(|(name, path)| (name.as_str(), path.as_str(), "")));
    let results: CompareResults = crate::downcast(run(folder.path(), "robustness = false", &maps));
    let of = |name: &str| results.surfaces.iter().find(|found| found.surface.name == name).unwrap();
    let next = |name: &str| said(&of(name).surface);
    for name in ["clipped", "filled"] {
        assert_eq!(failed(of(name))[0], Check::EqualHeights, "{name}");
        assert!(of(name).cases[0].verdicts.is_blocked, "{name}");
    }
    let clipped = next("clipped");
    assert!(clipped.contains("; a measurement whose range holds the highest points"), "{clipped}");
    assert!(
        clipped.contains("exactly the height 200 nm, the largest: the instrument was saturated"),
        "{clipped}"
    );
    assert!(clipped.contains("`missing = 2e-7`"), "{clipped}");
    let filled = next("filled");
    assert!(
        filled.contains("; `missing = 0`.")
            && filled.contains("3,600 points (0.879 %) have exactly the height 0 m"),
        "{filled}"
    );
    let others =
        results.surfaces.iter().filter(|found| !["clipped", "filled"].contains(&&*found.surface.name));
    for found in others {
        let fitness = found.surface.fitness();
        assert!(fitness.iter().all(|finding| finding.check != Check::EqualHeights), "{}", found.surface.name);
    }
    assert!(failed(of("marked")).is_empty(), "{:?}", of("marked").surface.fitness());
}

/// On a measured fine finish the shortest waves decide, on a Gaussian surface that the grid resolves they do not.
#[test]
fn a_verdict_that_depends_on_the_cut_off_says_so_and_a_robust_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(8.0);
    write(folder.path(), "good.npy", |i, j| base[i * SIDE + j]);
    let fine = concat!(env!("CARGO_MANIFEST_DIR"), "/experiments/surfaces/opd-1.npy");
    std::fs::copy(fine, folder.path().join("fine.npy")).unwrap();
    // Filtered, the fine finish holds blocks for an interval.
    let maps = [
        ("good", "good.npy", ""),
        ("fine", "fine.npy", "filter = { l = \"100 um\" }"),
        ("short", "fine.npy", ""),
    ];
    let accept = "accept = { area = \"30 %\", separation = 0.3, stiffness = \"40 %\" }";
    let results: CompareResults = crate::downcast(run(folder.path(), accept, &maps));
    let choices = |surface: usize| -> Vec<Choice> {
        results.surfaces[surface].cases[0].dependences.iter().map(|one| one.choice).collect()
    };
    assert!(choices(0).is_empty(), "{:?}", choices(0));
    assert!(choices(1).contains(&Choice::ShortWaves), "{:?}", choices(1));
    assert!(choices(2).contains(&Choice::ShortWaves), "{:?}", choices(2));
    let page = (&results as &dyn Outcome).outline().markdown();
    for name in ["good", "fine", "short"] {
        assert!(page.contains(&format!("## {name}: other treatments of the map")), "{name}");
    }
    let summary = (&results as &dyn Outcome).records();
    let rows = summary["verdicts"].as_array().unwrap();
    let depends =
        |row: &serde_json::Value| row["depends_on"].to_string().contains("short-wavelength-cut-off");
    assert!(rows.iter().any(|row| row["surface"] == "fine" && depends(row)));
    assert!(!rows.iter().any(|row| row["surface"] == "good" && depends(row)));
    let off = run(folder.path(), "robustness = false", &maps[..1]);
    assert!(crate::downcast::<CompareResults>(off).surfaces[0].cases[0].treated.is_empty());
}

/// Sharp asperities carry loads at strains too large for spheres; an S filter, which makes them blunt, is named where it makes loads
/// admissible.
#[test]
fn an_s_filter_that_makes_loads_admissible_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(2.5);
    write(folder.path(), "sharp.npy", |i, j| 5.0 * base[i * SIDE + j]);
    write(folder.path(), "blunt.npy", |i, j| base[i * SIDE + j]);
    let page = |file: &str, keys: &str| {
        let outcome = run(folder.path(), "", &[("a", file, keys)]);
        outcome.outline().markdown().lines().take(12).collect::<Vec<_>>().join("\n")
    };
    let sharp = page("sharp.npy", "");
    assert!(
        sharp.contains("Neither model is for this load: ") && sharp.contains("at a/R above 0.3"),
        "{sharp}"
    );
    assert!(sharp.contains("No compared load is admissible."), "{sharp}");
    let (_, named) = sharp.split_once("An S filter of ").unwrap_or_else(|| panic!("{sharp}"));
    let index = named.split_once(" µm").unwrap().0;
    let filtered = page("sharp.npy", &format!("filter = {{ s = \"{index} um\" }}"));
    assert!(filtered.contains("; admissible "), "{filtered}");
    let blunt = page("blunt.npy", "");
    assert!(!blunt.contains("An S filter of "), "{blunt}");
}

/// Bytes per point that a plan names, for a map that stays on disk.
#[test]
fn the_memory_of_a_filter_and_of_other_treatments_is_that_of_a_map() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "map.npy", |i, j| ((i * 7 + j * 13) % 101) as f64 * 1e-9);
    let bytes = |more: &str, keys: &str| {
        let path = spec(folder.path(), more, &[("a", "map.npy", keys)]);
        let plan = Experiment::read(&path).unwrap().to_string();
        let (_, memory) = plan.split_once("at most ").unwrap();
        1e6 * memory.split_once(" MB").unwrap().0.parse::<f64>().unwrap() / (SIDE * SIDE) as f64
    };
    let bare = bytes("robustness = false", "");
    // Printed to 0.1 MB, a quarter of a byte per point.
    let above = |more: &str, keys: &str| bytes(more, keys) - bare;
    assert!((above("robustness = false", "filter = { s = \"8 um\" }") - 8.0).abs() < 0.5);
    assert!((above("", "") - 8.0).abs() < 0.5, "other S filters");
    assert!((above("", "filter = { s = \"8 um\" }") - 8.0).abs() < 0.5, "one at a time");
    let long = above("robustness = false", "filter = { l = \"400 um\" }");
    assert!(long > 50.0 && long < 100.0, "{long}");
}

/// A treatment gives what a spec gives that asks for it; searches for other sets of loads round differently.
#[test]
fn treatments_are_those_of_specs() {
    let folder = tempfile::tempdir().unwrap();
    let base = good(4.0);
    write(folder.path(), "good.npy", |i, j| base[i * SIDE + j]);
    let of = |more: &str, keys: &str| -> CompareResults {
        crate::downcast(run(folder.path(), more, &[("a", "good.npy", keys)]))
    };
    let examined = of("", "");
    let examined_case = &examined.surfaces[0].cases[0];
    let inverse = "statistical = { mean-radius = \"inverse-mean-curvature\" }\nrobustness = false";
    let off = "robustness = false";
    for (treatment, results) in [
        (Treatment::MeanRadius(MeanRadius::InverseMeanCurvature), of(inverse, "")),
        (Treatment::ShortWaves(Some(4e-6)), of(off, "filter = { s = \"4 um\" }")),
        (Treatment::Level(Level::Quadratic), of(off, "level = \"quadratic\"")),
        (Treatment::Summits(Neighbours::Eight), of(off, "neighbours = \"eight\"")),
    ] {
        let treated = examined_case.treated.iter().find(|one| one.treatment == treatment).unwrap();
        let own = &examined.surfaces[0].cases[0].verdicts.differences;
        let asked = &results.surfaces[0].cases[0].verdicts.differences;
        let contrast = |all: &[Difference], load: f64| {
            let at = all.iter().find(|at| at.load == load).unwrap();
            at.estimates[ComparedQuantity::Separation as usize].unwrap().contrast
        };
        assert!(treated.differences.len() > 3);
        for at in &treated.differences {
            let found = contrast(&treated.differences, at.load);
            assert!((found - contrast(asked, at.load)).abs() < 1e-12, "{treatment:?}");
            assert!((found - contrast(own, at.load)).abs() > 1e-6, "{treatment:?}");
        }
    }
}
