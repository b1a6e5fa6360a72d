//! A map of causes: for each kind of statement a case in which it holds and one in which it does not.

use crate::Report;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

use crate::results::{number, table};

const CAUSES: &str = "skewness = [-1, 0]\nwavelengths = [2, 4]\nloads = [0.005]\nrealisations = 3\npoints = 512\n\
                      cut-off-pixels = 8\nhurst = 0.8\nsigma = \"100 nm\"\ngradient = 0.03\n";

fn run(causes: &str) -> Result<Box<dyn Outcome>, String> {
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[causes]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n{causes}",
        steel!(),
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("causes.toml");
    std::fs::write(&path, spec).unwrap();
    let experiment = Experiment::read(&path).map_err(|error| error.to_string())?;
    experiment.run(&Silent).map_err(|error| error.to_string())
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
    assert_eq!(heights["skewness_at_every_bandwidth"], "-1");
    assert!(leads.iter().all(|row| row["cause"] != "radii"), "{leads:?}");
    let page = outcome.outline().markdown();
    assert!(page.contains("in separation of 4 cases: height distribution 2,"), "{page}");
}

/// Where some surface is beyond the valid range, the point has no contributions, and the page says why.
#[test]
fn points_beyond_the_valid_range_are_not_divided() {
    let outcome = run(&CAUSES.replace("loads = [0.005]", "loads = [1e-6]")).unwrap();
    for row in table(&*outcome, "causes.csv").unwrap() {
        assert!(row["leading_cause"].is_empty() && row["difference"].is_empty(), "{row:?}");
        assert!(row["limits"].contains("few-contacts"), "{row:?}");
    }
    assert_eq!(table(&*outcome, "leads.csv").unwrap().len(), 0);
    assert!(outcome.outline().markdown().contains("in separation of 0 cases"));
}

#[test]
fn a_grid_that_cannot_be_made_is_refused() {
    for (key, found, message) in [
        ("skewness = [-1, 0]", "skewness = [0]", "found [0.0]; allowed: 2 to 32 ascending values"),
        ("skewness = [-1, 0]", "skewness = [0, -1]", "allowed: 2 to 32 ascending values"),
        (
            "wavelengths = [2, 4]",
            "wavelengths = [2, 100]",
            "allowed: at most the side of a surface, 512 pixels",
        ),
        (
            "wavelengths = [2, 4]",
            "wavelengths = [0.5, 4]",
            "a roll-off wavelength that is at least the cut-off's",
        ),
        ("realisations = 3", "realisations = 1", "found 1; allowed: 2 to 1000 realisations"),
        ("cut-off-pixels = 8", "cut-off-pixels = 1", "pixel"),
        ("hurst = 0.8", "hurst = 1.5", "found a Hurst exponent of 1.5; allowed: 0 to 1"),
        ("hurst = 0.8", "hurst = 0.8\nlaw2 = 1", "law2"),
    ] {
        let error = run(&CAUSES.replace(key, found)).map(|_| ()).unwrap_err();
        assert!(error.contains(message) && error.contains("line "), "{found}: {error}");
    }
}
