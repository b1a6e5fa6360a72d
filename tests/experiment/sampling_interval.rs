//! `[sampling-interval]` from the spec to the statements of the report.

use asperity_contact_framework::Outcome;

use crate::Report;
use crate::results::{self, Row, table};

/// A surface of waves down to `cut_off` pixels, on a grid of `points`.
fn run(points: usize, cut_off: f64, keys: &str) -> Box<dyn Outcome> {
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[sampling-interval]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n{keys}\n\
         [surface.random.generate]\npoints = {points}\npixel = \"0.1 um\"\nsigma = \"20 nm\"\n\
         spectrum.self-affine = {{ hurst = 0.8, roll-off = \"4 um\", cut-off = \"{:.3} um\" }}\n",
        steel!(),
        0.1 * cut_off,
    );
    results::run(&spec).unwrap()
}

fn outcome_of(outcome: &dyn Outcome, variation: &str, quantity: &str) -> String {
    let limits = table(outcome, "sampling_interval_limits.csv").unwrap();
    let is_wanted = |limit: &&Row| limit["variation"] == variation && limit["quantity"] == quantity;
    limits.iter().find(is_wanted).unwrap()["outcome"].clone()
}

/// 32 pixels per shortest wave at one pixel, 8 at four.
#[test]
fn a_finely_sampled_surface_has_limits() {
    let outcome = run(2048, 32.0, "pressure = [\"30 MPa\"]\nintervals = [1, 2, 4]\ns-filter = []");
    for quantity in ["density", "statistical-area", "deterministic-area"] {
        assert_eq!(outcome_of(&*outcome, "interval", quantity), "limit", "{quantity}");
    }
    let page = outcome.outline().markdown();
    assert!(
        page.contains("Gap between the models at 30 MPa")
            && !page.contains("The gap between the models is not given")
    );
    assert!(page.contains("on 0 of 1 surfaces, the contact area on 1."), "the radius cannot be told: {page}");
}

/// A load that fewer than 30 contacts carry at every length.
#[test]
fn without_a_valid_load_no_gap_is_given() {
    let outcome = run(256, 8.0, "pressure = [\"1 Pa\"]\nintervals = [1, 2, 4]\ns-filter = []");
    let page = outcome.outline().markdown();
    assert!(page.contains("at no length is a load admissible for both models."), "{page}");
    assert!(!page.contains("Gap between the models at"));
}

/// Waves down to two pixels, sampled from two pixels on: the finest interval has waves below it, as the others.
#[test]
fn a_surface_that_is_rough_down_to_the_pixel_has_none() {
    let outcome = run(1024, 2.0, "pressure = [\"30 MPa\"]\nintervals = [2, 4, 8]\ns-filter = [1, 2, 4]");
    for variation in ["interval", "s-filter"] {
        for quantity in ["density", "mean-radius", "statistical-area"] {
            assert_eq!(outcome_of(&*outcome, variation, quantity), "no-limit", "{variation}");
        }
    }
    let density = table(&*outcome, "sampling_interval_limits.csv").unwrap();
    let density = density.iter().find(|row| row["quantity"] == "density").unwrap();
    let exponent: f64 = density["exponent"].parse().unwrap();
    assert!((-2.0..-1.2).contains(&exponent), "{exponent}");
}

#[test]
fn tables_hold_every_scale_and_parts_that_add_up() {
    let keys = "pressure = [\"1 MPa\", \"30 MPa\"]\nintervals = [1, 2, 4, 32]\ns-filter = [1, 2, 4]\nnesting-index = \"1 um\"";
    let outcome = run(512, 8.0, keys);
    let number = |text: &String| text.parse::<f64>().unwrap();
    let scales = table(&*outcome, "sampling_interval.csv").unwrap();
    let lengths: Vec<f64> = scales.iter().map(|row| number(&row["length_m"])).collect();
    let expected = [1e-7, 2e-7, 4e-7, 3.2e-6, 1e-6, 2e-6, 4e-6];
    assert!(lengths.iter().zip(expected).all(|(found, expected)| (found / expected - 1.0).abs() < 1e-12));
    assert_eq!(lengths.len(), expected.len());
    let density = |index: usize| number(&scales[index]["density_per_m2"]);
    let count = |index: usize| number(&scales[index]["asperities"]);
    for index in 0..3 {
        // A periodic surface: all its points are tested at each interval.
        assert!((density(index) * 51.2e-6f64.powi(2) / count(index) - 1.0).abs() < 1e-9);
    }
    let gaps = table(&*outcome, "sampling_interval_gaps.csv").unwrap();
    assert_eq!(gaps.len(), 7 * 2 * 2);
    let mut divided = 0;
    for row in &gaps {
        // No number not admissible.
        assert_eq!(row["limits"].is_empty(), !row["difference"].is_empty(), "{row:?}");
        if row["limits"].is_empty() && row["quantity"] == "separation" {
            let parts = ["from_heights", "from_radii", "from_correlation"].map(|part| number(&row[part]));
            assert!((parts.iter().sum::<f64>() - number(&row["difference"])).abs() < 1e-9, "{row:?}");
            divided += 1;
        }
    }
    assert!(divided > 3, "{divided}");
    let few = |row: &&Row| row["length_m"].starts_with("3.2") && !row["limits"].is_empty();
    assert!(gaps.iter().filter(few).count() > 0, "16 points per axis carry no load by 30 contacts");
    let leads = table(&*outcome, "sampling_interval_leads.csv").unwrap();
    for row in &leads {
        let count = row["leading_causes"].split("; ").count();
        assert_eq!(row["lengths"], count.to_string(), "{row:?}");
    }
}

/// Steps of an instrument.
#[test]
fn a_map_that_is_not_fit_carries_no_conclusion() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/experiments/surfaces/plu-1.npy");
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[sampling-interval]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n\
         pressure = [\"10 MPa\"]\nintervals = [1, 2, 4]\ns-filter = []\n\
         [surface.ground.file]\npath = \"{path}\"\npixel = \"1.66 um\"\n",
        steel!()
    );
    let outcome = results::run(&spec).unwrap();
    let page = outcome.outline().markdown();
    assert!(page.contains("Of 1 surfaces nothing is concluded, because their maps are not fit."), "{page}");
    assert!(!page.contains("As the sampling interval shrinks"));
    let fitness = outcome.records()["fitness"].as_array().unwrap().clone();
    assert!(fitness.iter().any(|check| check["passed"] == false && check["blocks"] == true));
}
