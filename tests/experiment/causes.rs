//! A map of causes: for each kind of statement a case in which it holds and one in which it does not.

use asperity_contact_framework::Outcome;

use crate::Report;
use crate::common::assert_message;
use crate::results::{self, number, table};

const CAUSES: &str = "skewness = [-1, 0]\nwavelengths = [2, 4]\nloads = [0.005]\nrealisations = 3\npoints = 512\n\
                      cut-off-pixels = 8\nhurst = 0.8\nsigma = \"100 nm\"\ngradient = 0.03\n";

fn run(causes: &str) -> Result<Box<dyn Outcome>, String> {
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[causes]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n{causes}",
        steel!(),
    );
    results::run(&spec)
}

/// With heights of the density of the statistical model the height distribution does not lead, with skewed ones it does.
#[test]
fn the_height_distribution_leads_on_skewed_surfaces_only() {
    let outcome = run(CAUSES).unwrap();
    let rows = table(&*outcome, "causes.csv").unwrap();
    assert_eq!(rows.len(), 2 * 2 * 2);
    for row in &rows {
        let parts = ["heights", "radii", "correlation"].map(|cause| number(row, &format!("from_{cause}")));
        assert!((parts.iter().sum::<f64>() - number(row, "difference")).abs() < 1e-9, "{row:?}");
        assert!((number(row, "gradient") / 0.03 - 1.0).abs() < 0.1, "{row:?}");
        assert!((number(row, "surface_skewness") - number(row, "skewness")).abs() < 0.2, "{row:?}");
        if row["quantity"] == "separation" {
            assert_eq!(row["leading_cause"] == "heights", number(row, "skewness") == -1.0, "{row:?}");
        }
        let widest = if number(row, "wavelengths") == 2.0 { 3.0 } else { 5.0 };
        assert!((widest - 1.5..widest).contains(&number(row, "nayak_alpha")), "{row:?}");
    }
    let leads = table(&*outcome, "leads.csv").unwrap();
    let heights =
        leads.iter().find(|row| row["quantity"] == "separation" && row["cause"] == "heights").unwrap();
    assert_eq!((&*heights["points"], &*heights["points_divided"]), ("2", "4"));
    assert_eq!(heights["skewness_in_every_row"], "-1");
    assert!(leads.iter().all(|row| row["cause"] != "radii"), "{leads:?}");
    let page = outcome.outline().markdown();
    assert!(
        page.contains(
            "Heights explain the difference in separation better than radii in 2 of 4 cases, radii in 1."
        ),
        "{page}"
    );
}

/// Spread and correlation of the radii add up to what the radii contribute, whose interval holds the orders of replacement; only the
/// spread depends on which mean radius the statistical model takes.
#[test]
fn radii_contribute_by_spread_and_correlation() {
    let outcome = run(CAUSES).unwrap();
    for row in table(&*outcome, "causes.csv").unwrap() {
        let radii = number(&row, "from_radii_and_correlation");
        let [spread, correlation] = ["from_radii", "from_correlation"].map(|name| number(&row, name));
        assert!((radii - spread - correlation).abs() < 1e-9, "{row:?}");
        for part in ["from_heights", "from_radii_and_correlation"] {
            let [low, high] = ["low", "high"].map(|end| number(&row, &format!("{part}_{end}")));
            assert!(low <= number(&row, part) && number(&row, part) <= high, "{row:?}");
        }
        if row["quantity"] == "area" {
            let shift = number(&row, "from_radii_with_other_mean_radius") - spread;
            assert!(shift < -0.02, "{row:?}");
        }
    }
    let leads = table(&*outcome, "leads.csv").unwrap();
    let counts = |quantity: &str, column: &str| {
        let row = leads.iter().find(|row| row["quantity"] == quantity).unwrap();
        row[column].parse::<usize>().unwrap()
    };
    assert_eq!(counts("separation", "heights_exceed_points"), 2);
    assert!(counts("area", "radii_larger_points") >= counts("area", "radii_exceed_points"));
}

/// Beside the reference each point has the distances of both models and the nearer one; without it none.
#[test]
fn a_reference_says_which_model_is_nearer() {
    let small =
        CAUSES.replace("points = 512", "points = 256").replace("realisations = 3", "realisations = 2");
    let with = format!("models = [\"statistical\", \"deterministic\", \"reference\"]\n{small}");
    let outcome = run(&with.replace("gradient = 0.03", "gradient = 0.01")).unwrap();
    let rows = table(&*outcome, "causes.csv").unwrap();
    let compared: Vec<_> = rows.iter().filter(|row| !row["farther"].is_empty()).collect();
    assert!(!compared.is_empty());
    for row in &compared {
        let [s, d] =
            ["statistical", "deterministic"].map(|model| number(row, &format!("{model}_from_reference")));
        assert!((s - d - number(row, "difference")).abs() < 1e-9, "{row:?}");
        assert!((number(row, "farther_low")..=number(row, "farther_high")).contains(&number(row, "farther")));
        let nearer = match &*row["nearer"] {
            "statistical" => number(row, "farther_high") < 0.0,
            "deterministic" => number(row, "farther_low") > 0.0,
            other => other.is_empty(),
        };
        assert!(nearer, "{row:?}");
    }
    assert!(outcome.outline().markdown().contains("nearer to boundary elements"));
    let without = table(&*run(CAUSES).unwrap(), "causes.csv").unwrap();
    assert!(without.iter().all(|row| row["farther"].is_empty() && row["nearer"].is_empty()));
}

/// Points that no surface has are empty with the reason, others have surfaces with the summits asked for.
#[test]
fn a_grid_of_moments_is_empty_where_no_surface_has_the_summits() {
    let outcome = run(
        "skewness = [-1, 0]\nkurtosis = [1.5, 4.5]\npressure = [\"2 MPa\"]\nrealisations = 2\npoints = 512\ncut-off-pixels = 8\n\
         hurst = 0.8\nsummits = { radius = \"1.6 um\", sigma = \"260 nm\", density = \"9e10 /m^2\" }\n",
    )
    .unwrap();
    let rows = table(&*outcome, "causes.csv").unwrap();
    let at = |skewness: f64, kurtosis: f64| {
        let is_at = |row: &&std::collections::BTreeMap<String, String>| {
            number(row, "skewness") == skewness && number(row, "kurtosis") == kurtosis
        };
        rows.iter().find(is_at).unwrap()
    };
    assert!(at(-1.0, 1.5)["without_surface"].contains("no heights have them"));
    assert!(at(0.0, 4.5)["without_surface"].contains("density * radius * sigma"));
    let made = at(-1.0, 4.5);
    assert!(made["without_surface"].is_empty() && number(made, "asperities") > 100.0, "{made:?}");
    assert!(outcome.outline().markdown().contains("Of 4 grid points, "));
}

/// A difference that is accepted is divided, but counts for no cause.
#[test]
fn differences_within_what_is_accepted_need_no_cause() {
    let outcome = run(&format!("{CAUSES}accept = {{ separation = 9, area = \"99 %\" }}\n")).unwrap();
    for row in table(&*outcome, "causes.csv").unwrap() {
        assert!(row["verdict"] == "within" && row["leading_cause"].is_empty(), "{row:?}");
        assert!(!row["from_heights"].is_empty(), "{row:?}");
    }
    assert_eq!(table(&*outcome, "leads.csv").unwrap().len(), 0);
    let page = outcome.outline().markdown();
    assert!(page.contains("No difference in separation needs a cause."), "{page}");
}

/// Where a load is not admissible on some surface, the point has no contributions, and the page says why.
#[test]
fn points_beyond_the_limits_are_not_divided() {
    let outcome = run(&CAUSES.replace("loads = [0.005]", "loads = [1e-6]")).unwrap();
    for row in table(&*outcome, "causes.csv").unwrap() {
        assert!(row["leading_cause"].is_empty() && row["verdict"].is_empty(), "{row:?}");
        assert!(row["limits"].contains("few-contacts"), "{row:?}");
    }
    assert_eq!(table(&*outcome, "leads.csv").unwrap().len(), 0);
    assert!(outcome.outline().markdown().contains("No difference in separation needs a cause."));
}

#[test]
fn a_grid_that_cannot_be_made_is_refused() {
    for (key, found) in [
        ("skewness = [-1, 0]", "skewness = [0]"),
        ("skewness = [-1, 0]", "skewness = [0, -1]"),
        ("wavelengths = [2, 4]", "wavelengths = [2, 100]"),
        ("wavelengths = [2, 4]", "wavelengths = [0.5, 4]"),
        ("wavelengths = [2, 4]", "kurtosis = [3, 4]"),
        ("loads = [0.005]", "pressure = \"1 MPa\""),
        ("realisations = 3", "realisations = 1"),
        ("cut-off-pixels = 8", "cut-off-pixels = 1"),
        ("hurst = 0.8", "hurst = 1.5"),
        ("hurst = 0.8", "hurst = 0.8\nlaw2 = 1"),
    ] {
        assert_message(module_path!(), found, &run(&CAUSES.replace(key, found)).err().unwrap());
    }
}
