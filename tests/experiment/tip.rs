//! The stylus or tip of a measured map: what it adds to summits is taken off, and summits as sharp as it are cautioned.

use asperity_contact_framework::Outcome;

use crate::results::{self, ON_STEEL, Row, number, table};

/// Crossed waves with summits of about 51 µm, as a blunt tip has traced them or not; and noise on every 7th point.
fn run(tip: &str, noise: f64) -> Box<dyn Outcome> {
    let folder = tempfile::tempdir().unwrap();
    let wave = |k: usize| (std::f64::consts::TAU * k as f64 / 40.0).cos();
    let row = |x: usize| {
        let height = |y: usize| {
            let of_noise = if (x * 200 + y).is_multiple_of(7) { noise } else { 0.0 };
            let uneven = 1.0 + 0.1 * (x as f64 / 23.0).sin() * (y as f64 / 31.0).cos();
            format!("{:e}", 2e-7 * (wave(x) + wave(y)) * uneven + of_noise)
        };
        (0..200).map(height).collect::<Vec<_>>().join(" ")
    };
    let map = (0..200).map(row).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.path().join("map.txt"), map).unwrap();
    let spec = format!(
        "{ON_STEEL}robustness = false\nseparation = {{ values = [1] }}\n\
         [surface.s.file]\npath = \"map.txt\"\npixel = \"0.5 um\"\n{tip}\n"
    );
    results::run_in(folder.path(), &spec).unwrap()
}

/// The row of the check; `None` where it was not made.
fn check(outcome: &dyn Outcome) -> Option<Row> {
    table(outcome, "fitness.csv").unwrap().into_iter().find(|row| row["check"] == "tip")
}

fn mean_radius(outcome: &dyn Outcome) -> f64 {
    number(&table(outcome, "surfaces.csv").unwrap()[0], "mean_radius_m")
}

#[test]
fn a_tip_is_taken_off_the_summits_and_cautioned_where_they_are_as_sharp() {
    let without = run("", 0.0);
    assert!(check(&*without).is_none());
    let map = &table(&*without, "height_maps.csv").unwrap()[0];
    assert!(map["tip_radius_m"].is_empty() && map["tip_unreached_share"].is_empty());

    let sharp = run("tip = \"5 um\"", 0.0);
    let row = check(&*sharp).unwrap();
    assert_eq!((&*row["measure"], &*row["result"]), ("summit-radius-over-tip", "passed"), "{row:?}");
    let taken = mean_radius(&*without) - mean_radius(&*sharp);
    assert!((taken / 5e-6 - 1.0).abs() < 0.1, "{taken:e}");

    let blunt = run("tip = \"30 um\"", 0.0);
    let row = check(&*blunt).unwrap();
    assert_eq!((&*row["result"], &*row["blocks"]), ("caution", "false"), "{row:?}");
    assert!(number(&row, "value") < 2.0);
    let map = &table(&*blunt, "height_maps.csv").unwrap()[0];
    assert_eq!(number(map, "tip_radius_m"), 30e-6);
}

/// Points that stand out of what the tip can trace.
#[test]
fn noise_was_not_traced_by_the_tip() {
    let untraced = |noise: f64| {
        let outcome = run("tip = \"5 um\"", noise);
        number(&table(&*outcome, "height_maps.csv").unwrap()[0], "tip_untraced_share")
    };
    assert_eq!(untraced(0.0), 0.0);
    assert!(untraced(5e-8) > 0.1, "{}", untraced(5e-8));
}
