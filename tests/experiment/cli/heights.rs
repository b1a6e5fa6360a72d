//! Height distributions, from the input file to the summary.

use crate::Report;
use crate::results::{ON_STEEL, number, population, run, table};

/// The last pressures of both models, Pa, and the distribution in the summary.
fn outcome(compare: &str, heights: &str) -> (f64, f64, String) {
    let population = population("a", 40_000, &format!("draw = \"quantiles\"\nheights = {heights}"));
    let outcome =
        run(&format!("{ON_STEEL}separation = {{ values = [2, 0] }}\n{compare}\n{population}")).unwrap();
    let rows = table(&*outcome, "curves.csv").unwrap();
    let last = |model| number(rows.iter().rfind(|row| row["model"] == model).unwrap(), "pressure_pa");
    let heights = outcome.records()["surfaces"]["a"]["model_heights"].as_str().unwrap().to_owned();
    (last("statistical"), last("deterministic"), heights)
}

#[test]
fn a_population_of_any_distribution_is_that_of_both_models() {
    for heights in [
        "\"exponential\"",
        "{ weibull = { shape = 2 } }",
        "{ weibull = { shape = 0.7 } }",
        "{ johnson = { skewness = -1, kurtosis = 4.5 } }",
    ] {
        let (statistical, deterministic, summary) = outcome("", heights);
        assert!((statistical / deterministic - 1.0).abs() < 1e-3, "{heights}: {statistical} {deterministic}");
        assert_eq!(summary, heights.replace('"', ""));
    }
}

#[test]
fn the_statistical_model_takes_the_heights_that_the_comparison_names() {
    let named = "statistical = { heights = { weibull = { shape = 2 } } }";
    let (statistical, deterministic, summary) = outcome(named, "\"gaussian\"");
    assert_eq!(summary, "{ weibull = { shape = 2 } }");
    let weibull = outcome("", "{ weibull = { shape = 2 } }");
    let gaussian = outcome("", "\"gaussian\"");
    assert_eq!((statistical, deterministic), (weibull.0, gaussian.1));
}
