//! Which statistical model is enough: for each kind of statement a case in which it holds and one in which it does not.

use asperity_contact_framework::Outcome;

use crate::Report;
use crate::results::{self, ON_STEEL, Row, number, population, table};

/// A finely sampled surface of these heights.
fn map(heights: &str) -> String {
    format!(
        "[surface.s.generate]\npoints = 400\npixel = \"1 um\"\nsigma = \"100 nm\"\n\
         spectrum.gaussian.correlation-length = \"8 um\"\n{heights}\n"
    )
}

fn run(compare: &str, surface: &str) -> Result<Box<dyn Outcome>, String> {
    let sweep = "pressure = { from = \"1 MPa\", to = \"60 MPa\", points = 7 }";
    let pressure = if compare.contains("pressure") { "" } else { sweep };
    results::run(&format!("{ON_STEEL}{pressure}\nrobustness = false\n{compare}\n{surface}"))
}

/// The largest difference of a model from the sum.
fn difference(rows: &[Row], model: &str, quantity: &str) -> f64 {
    let is_it = |row: &&Row| row["model"] == model && row["quantity"] == quantity;
    number(rows.iter().find(is_it).unwrap_or_else(|| panic!("{model}")), "from_deterministic")
}

#[test]
fn the_joint_density_is_enough_on_a_gaussian_surface_and_not_on_a_skewed_one() {
    let gaussian = run("", &map("")).unwrap();
    let rows = table(&*gaussian, "ranking.csv").unwrap();
    assert_eq!(rows.len(), 17 * 3);
    assert!(difference(&rows, "five-point", "area").abs() < 0.1);
    assert!(difference(&rows, "nayak-greenwood", "area").abs() < 0.1);
    assert!(difference(&rows, "gaussian, arithmetic", "area") > 0.2);
    // The same nodes at a separation, however many steps a search takes with either radius.
    let contacts = |model: &str| {
        let row = rows.iter().find(|row| row["model"] == model).unwrap_or_else(|| panic!("{model}"));
        number(row, "contacts_per_separation")
    };
    assert_eq!(contacts("gaussian, arithmetic"), contacts("gaussian, inverse-mean-curvature"));
    assert!(contacts("gaussian, arithmetic") > 20.0 && contacts("five-point") > 1e4);
    let skewed = run("", &map("heights.johnson = { skewness = -1, kurtosis = 4.5 }")).unwrap();
    let rows = table(&*skewed, "ranking.csv").unwrap();
    assert!(difference(&rows, "five-point", "separation").abs() > 0.3);
    assert!(difference(&rows, "own, in-contact", "separation").abs() < 0.1);
    let row = standing(&*gaussian, "area");
    assert!(row["within"].contains("five-point") && !row["cheapest_within"].is_empty(), "{row:?}");
    let row = standing(&*skewed, "separation");
    assert!(!row["within"].contains("nayak-greenwood") && !row["within"].contains("five-point"), "{row:?}");
    let strict = run("accept = { area = 1e-9, separation = 1e-9 }", &map("")).unwrap();
    let row = standing(&*strict, "area");
    assert!(
        row["within"].is_empty() && row["cheapest_within"].is_empty() && !row["nearest"].is_empty(),
        "{row:?}"
    );
}

/// The row of the selected model is the comparison itself, at the loads of the ranking.
#[test]
fn the_selected_model_has_the_differences_of_the_comparison() {
    for (selected, name) in [
        ("", "gaussian, arithmetic"),
        ("statistical = { heights = \"own\", mean-radius = \"in-contact\" }", "own, in-contact"),
        ("statistical = { model = \"five-point\" }", "five-point"),
        ("statistical = { heights.weibull = { shape = 3 } }", "weibull, arithmetic"),
    ] {
        let outcome = run(selected, &map("")).unwrap();
        let pairs = table(&*outcome, "comparison.csv").unwrap();
        let rows = table(&*outcome, "ranking.csv").unwrap();
        let row = rows.iter().find(|row| row["model"] == name && row["quantity"] == "separation").unwrap();
        let at = number(row, "from_deterministic_at_pa");
        let pair = pairs.iter().find(|pair| number(pair, "target") == at).unwrap();
        let expected = number(pair, "difference_separation_over_sigma");
        assert!((number(row, "from_deterministic") - expected).abs() < 1e-9, "{name}");
    }
}

#[test]
fn a_joint_density_runs_with_intervals_and_without_causes() {
    let outcome = run("statistical = { model = \"nayak-greenwood\" }", &map("")).unwrap();
    let page = outcome.outline().markdown();
    assert!(page.contains("| nayak-greenwood |"), "{page}");
    assert!(page.contains("Not divided: the statistical model has a joint density"), "{page}");
    assert!(table(&*outcome, "attribution.csv").is_none());
    let rows = table(&*outcome, "differences.csv").unwrap();
    assert!(rows.iter().any(|row| !row["low"].is_empty()), "{rows:?}");
}

#[test]
fn without_a_map_the_models_of_no_joint_density_are_compared() {
    let outcome = run("", &population("p", 20_000, "")).unwrap();
    assert_eq!(table(&*outcome, "ranking.csv").unwrap().len(), 15 * 3);
    let inapplicable = standing(&*outcome, "area")["inapplicable"].clone();
    assert!(inapplicable.contains("nayak-greenwood (the joint density follows from a map"), "{inapplicable}");
}

#[test]
fn a_ranking_is_made_where_it_is_read() {
    let layers = "layer = { material = \"lead\", thickness = [0, \"50 nm\"] }";
    for compare in ["rank-models = false", "models = [\"deterministic\"]", layers] {
        let outcome = run(compare, &(map("") + lead!())).unwrap();
        assert!(table(&*outcome, "ranking.csv").is_none(), "{compare}");
        assert!(!outcome.outline().markdown().contains("Which statistical model is enough"), "{compare}");
    }
}

/// The row of a quantity against the sum.
fn standing(outcome: &dyn Outcome, quantity: &str) -> Row {
    let rows = table(outcome, "statistical_models.csv").unwrap();
    let is_it = |row: &&Row| row["quantity"] == quantity && row["against"] == "deterministic";
    rows.iter().find(is_it).unwrap().clone()
}

/// In sample and held out.
fn differences(outcome: &dyn Outcome, model: &str, quantity: &str) -> [f64; 2] {
    let rows = table(outcome, "ranking.csv").unwrap();
    let is_it = |row: &&Row| row["model"] == model && row["quantity"] == quantity;
    let row = rows.iter().find(is_it).unwrap();
    ["from_deterministic", "held_out_from_deterministic"].map(|name| number(row, name).abs())
}

/// The same asperities tell little of other asperities where few carry the load, and enough where many do.
#[test]
fn a_fitted_model_is_tested_on_asperities_that_it_was_not_taken_from() {
    let model = "own, in-contact";
    let strict = "accept = { separation = 0.05 }";
    let few = run(strict, &map("heights.johnson = { skewness = -1, kurtosis = 4.5 }")).unwrap();
    let [in_sample, held_out] = differences(&*few, model, "separation");
    assert!(in_sample < 0.05 && held_out > 0.05, "{in_sample} {held_out}");
    let row = standing(&*few, "separation");
    assert!(row["within_in_sample"].contains(model) && !row["within"].contains(model), "{row:?}");
    assert_eq!(row["fitted_tested_on"], "halves of the surface");

    let many = run(strict, &population("p", 200_000, "")).unwrap();
    let [in_sample, held_out] = differences(&*many, model, "separation");
    assert!(in_sample < 0.05 && held_out < 0.05, "{in_sample} {held_out}");
    assert_ne!(in_sample, held_out);
    let row = standing(&*many, "separation");
    assert!(row["within"].contains(model) && !row["within_in_sample"].contains(model), "{row:?}");
    assert_eq!(row["fitted_tested_on"], "random halves");
    // What is held out is what the seed draws, and the same again.
    let again = run("", &population("p", 200_000, "")).unwrap();
    assert_eq!(differences(&*again, model, "separation"), [in_sample, held_out]);
}

/// Loads that only the whole surface holds enough contacts for leave nothing to test on.
#[test]
fn a_fitted_model_without_other_asperities_is_in_sample_only() {
    let small = |count: usize, realisations: usize| {
        let keys = format!("realisations = {realisations}");
        run("pressure = \"15 MPa\"", &population("p", count, &keys)).unwrap()
    };
    // Some 45 effective contacts, of which a half has less than 30.
    let one = small(1200, 1);
    let row = standing(&*one, "area");
    assert_eq!((&*row["fitted_tested_on"], &*row["tested_from_pa"]), ("in sample only", ""), "{row:?}");
    assert!(!row["within"].contains("own") && !row["nearest"].contains("own"), "{row:?}");
    let several = small(1200, 3);
    let row = standing(&*several, "area");
    assert_eq!(row["fitted_tested_on"], "realisations");
    assert_eq!(number(&row, "tested_from_pa"), 15e6);
    let [in_sample, held_out] = differences(&*several, "own, arithmetic", "area");
    assert!(held_out > in_sample, "{in_sample} {held_out}");
}
