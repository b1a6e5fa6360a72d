//! Surfaces in tiles: as one run, in tasks, and beside `[compare]` on the same surface.

use std::fs;
use std::path::Path;

use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

use crate::results::{Row, column, number, report, rows, succeeds, typed};

const CONTACT: &str = concat!(
    "rough = \"steel\"\nflat = \"steel\"\nlaw = [\"zmc\", \"hertz\"]\nseparation = { from = 3, to = -1, points = 9 }\n\n",
    steel!()
);

/// A population of another distribution, in two realisations.
const POPULATION: &str = concat!(
    "[surface.a.population]\n",
    case_1!(),
    "count = 300_000\nrealisations = 2\nheights.johnson = { skewness = -1, kurtosis = 4.5 }\n"
);
const LIST: &str = "[surface.a.asperities]\nfile = \"list.npy\"\nnominal-area = \"1 mm^2\"\n";
const MAP: &str =
    "[surface.a.file]\npath = \"map.npy\"\npixel = \"1 um\"\nlevel = \"none\"\nfilter.s = \"3 um\"\n";
const GENERATED: &str =
    concat!(generated!("a", 64, "1 um", "0.1 um", "20 um" to "4 um"), "realisations = 9\n");

fn spec(kind: &str, surface: &str) -> String {
    format!("title = \"tiles\"\nseed = 3\n\n[{kind}]\n{CONTACT}\n{surface}")
}

/// Numbers from 0 to 1 that look random.
fn noise(count: usize) -> impl Iterator<Item = f64> {
    let mut state = 1u64;
    (0..count).map(move |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    })
}

/// Rows of the list.
const ROWS: usize = 600_000;

/// A folder with a spec, a list of [`ROWS`] asperities at a height of 1 m, and a map of 1500 x 300 points in steps of 10 nm with
/// missing points.
fn folder(spec: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.toml"), spec).unwrap();
    let file = |name: &str| fs::File::create(folder.path().join(name)).unwrap();
    if spec.contains("list.npy") {
        let mut random = noise(2 * ROWS);
        let list = (0..2 * ROWS).map(|k| {
            let value = random.next().unwrap();
            if k % 2 == 0 { 1.0 + 1e-7 * value * value } else { 1e-5 * (1.0 + value) }
        });
        asperity::npy::write(file("list.npy"), [ROWS, 2], list).unwrap();
    }
    let map =
        noise(450_000).map(|value| if value < 0.001 { f64::NAN } else { 1e-8 * (40.0 * value).round() });
    asperity::npy::write(file("map.npy"), [1500, 300], map).unwrap();
    folder
}

/// Runs the spec into a folder of reports.
fn run(folder: &Path, out: &str) {
    succeeds(&["run", "a.toml", "--out", out, "--quiet"], folder);
}

#[test]
fn any_number_of_threads_gives_the_bytes_of_one() {
    for surface in [POPULATION, LIST, MAP, GENERATED] {
        let folder = folder(&spec("tiled", surface));
        let folder = folder.path();
        let [one, three] = ["1", "3"].map(|threads| {
            succeeds(&["run", "a.toml", "--out", threads, "--quiet", "--threads", threads], folder);
            report(&folder.join(threads).join("a"))
        });
        assert!(one.len() > 5 && one == three, "{surface}");
    }
}

/// Tasks in any order, of a tile or of several, and those of the second pass where there is one.
#[test]
fn tasks_have_the_results_of_one_run() {
    let several = POPULATION.replace("300_000", "500").replace("realisations = 2", "realisations = 600");
    for (surface, wanted) in
        [(POPULATION, [10, 1]), (&several, [200, 1]), (LIST, [10, 2]), (MAP, [23, 2]), (GENERATED, [9, 2])]
    {
        let folder = folder(&spec("tiled", surface));
        let experiment = Experiment::read(&folder.path().join("a.toml")).unwrap();
        let key = experiment.key().unwrap();
        let [tasks, passes] = experiment.tasks().unwrap();
        assert_eq!([tasks, passes], wanted, "{surface}");
        let mut found: Vec<Vec<String>> = Vec::new();
        for _ in 0..passes {
            let pass = (0..tasks).rev().map(|task| experiment.run_task(task, &found, &Silent).unwrap());
            let mut pass: Vec<String> = pass.collect();
            pass.reverse();
            found.push(pass);
        }
        let csv = |outcome: &dyn Outcome| {
            outcome.tables().iter().map(|table| table.csv().unwrap()).collect::<Vec<_>>()
        };
        let divided = experiment.results_of_tasks(&found, &key, &Silent).unwrap();
        assert_eq!(csv(&*divided), csv(&*experiment.run(&Silent).unwrap()), "{surface}");
        assert!(experiment.results_of_tasks(&found, "of another input", &Silent).is_err());
        found[0].pop();
        assert!(experiment.results_of_tasks(&found, &key, &Silent).is_err());
    }
}

fn curves(folder: &Path, out: &str) -> Vec<Row> {
    rows(&fs::read(folder.join(out).join("a/curves.csv")).unwrap())
}

/// The same asperities, statistics and sums, to rounding.
#[test]
fn tiles_of_a_list_a_map_and_a_population_sum_to_the_whole() {
    // Without the filter the map is full of plateaus.
    let unfiltered = MAP.replace("filter.s = \"3 um\"\n", "");
    for surface in [LIST, MAP, &unfiltered, &POPULATION.replace("realisations = 2\n", "")] {
        let folder = folder(&spec("tiled", surface));
        let folder = folder.path();
        run(folder, "tiled");
        let whole = spec("compare", surface)
            .replace("[compare]", "[compare]\nrobustness = false\nattribution = false");
        fs::write(folder.join("a.toml"), whole).unwrap();
        run(folder, "whole");
        let [tiled, whole] = ["tiled", "whole"].map(|out| curves(folder, out));
        assert_eq!(tiled.len(), 2 * 2 * 9);
        for (tiled, whole) in tiled.iter().zip(&whole) {
            for name in ["model", "law", "target", "separation_over_sigma", "limits"] {
                assert_eq!(tiled[name], whole[name], "{name}");
            }
            for name in
                ["pressure_pa", "area_ratio", "contact_density_per_m2", "stiffness_pa_per_m", "separation_m"]
            {
                let (found, wanted) = (number(tiled, name), number(whole, name));
                assert!(
                    (found - wanted).abs() <= 1e-12 * wanted.abs(),
                    "{name}: {found} for {wanted} on {surface}"
                );
            }
        }
    }
}

/// The sum of a Gaussian population is within its interval of the integral, that of a skew list is not.
#[test]
fn the_finding_holds_where_the_heights_are_gaussian_and_not_where_they_are_skew() {
    /// The error of the integral over its standard error, and at how many separations of how many it is within the interval.
    fn found(surface: &str) -> (f64, usize, usize) {
        let folder = folder(&spec("tiled", surface));
        run(folder.path(), "out");
        let points = typed(rows(&fs::read(folder.path().join("out/a/separations.csv")).unwrap()));
        let at_one = points.iter().find(|point| point["separation_over_sigma"] == 1.0).unwrap();
        let value = |name: &str| at_one[name].as_f64().unwrap();
        let ratio = value("statistical_over_deterministic_pressure");
        let page = fs::read_to_string(folder.path().join("out/a/report.md")).unwrap();
        let (_, counts) = page.split_once("interval of the sum's pressure at ").unwrap();
        let mut words = counts.split(' ');
        let [inside, all] = [0, 1].map(|place| words.nth(place).unwrap().parse().unwrap());
        ((ratio - 1.0).abs() / value("relative_standard_error_from_tiles"), inside, all)
    }
    let gaussian = POPULATION.lines().filter(|line| !line.contains("johnson")).collect::<Vec<_>>().join("\n");
    let (in_errors, inside, all) = found(&gaussian);
    assert!(in_errors < 3.0 && inside == all && all > 0, "{in_errors}: {inside} of {all}");
    let (in_errors, inside, all) = found(LIST);
    assert!(in_errors > 10.0 && inside < all, "{in_errors}: {inside} of {all}");
}

/// Tiles of quantiles are sorted heights: no sample, and no interval.
#[test]
fn heights_at_the_quantiles_have_no_interval() {
    let folder = folder(&spec(
        "tiled",
        &format!("{}draw = \"quantiles\"\n", POPULATION.replace("realisations = 2\n", "")),
    ));
    run(folder.path(), "out");
    let page = fs::read_to_string(folder.path().join("out/a/report.md")).unwrap();
    assert!(page.contains("The sum has no interval"), "{page}");
    let points = rows(&fs::read(folder.path().join("out/a/separations.csv")).unwrap());
    assert!(points.iter().all(|point| point["relative_standard_error_from_tiles"].is_empty()));
}

/// The scatter of the tiles is that of independent asperities where they are independent.
#[test]
fn standard_errors_from_tiles_agree_with_those_of_independent_asperities() {
    let folder = folder(&spec("tiled", &POPULATION.replace("300_000", "4_000_000")));
    run(folder.path(), "out");
    let errors = typed(rows(&fs::read(folder.path().join("out/a/separations.csv")).unwrap())).into_iter();
    // None where fewer than eight tiles are in contact.
    let errors = errors.map(|point| point["relative_standard_error_from_tiles"].as_f64());
    let sums: Vec<Row> = curves(folder.path(), "out")
        .into_iter()
        .filter(|row| row["model"] == "deterministic" && row["law"] == "zmc")
        .collect();
    let relative = column(&sums, "pressure_standard_error_pa").into_iter().zip(column(&sums, "pressure_pa"));
    let both: Vec<_> = errors.zip(relative).filter_map(|(from_tiles, by)| Some((from_tiles?, by))).collect();
    assert!(both.len() >= 7);
    for (from_tiles, (error, pressure)) in both {
        // 124 tiles give a standard error to 6 %.
        assert!((from_tiles * pressure / error - 1.0).abs() < 0.3, "{from_tiles} for {}", error / pressure);
    }
}
