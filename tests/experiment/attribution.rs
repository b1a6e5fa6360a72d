//! Why the models differ: for each kind of statement a case in which it holds and one in which it does not.

use std::fmt::Write;
use std::path::Path;

use asperity_contact_framework::Outcome;

use crate::Report;
use crate::results::{self, ON_STEEL, figure, number, population, table};

/// A list of asperities with Gaussian heights. A sharper radius belongs to a higher one where they are `correlated`.
fn list(folder: &Path, name: &str, count: usize, correlated: bool) {
    let mut text = "height,radius\n".to_owned();
    for k in 0..count {
        // A Weyl sequence in two dimensions, Box and Muller's pairs.
        let [u, v] =
            [0.754_877_666_246_692_7, 0.569_840_290_998_053_3].map(|step| ((k as f64 + 0.5) * step).fract());
        let (length, angle) = ((-2.0 * u.ln()).sqrt(), std::f64::consts::TAU * v);
        let [height, other] = [length * angle.cos(), length * angle.sin()];
        let normal = if correlated { -0.8 * height + 0.6 * other } else { other };
        writeln!(text, "{:e},{:e}", 48e-9 * height, 2e-5 * (0.4 * normal).exp()).unwrap();
    }
    std::fs::write(folder.join(name), text).unwrap();
}

const COMPARE: &str = "pressure = { from = \"1 MPa\", to = \"60 MPa\", points = 7 }\n";

fn run(folder: &Path, compare: &str, surfaces: &str) -> Box<dyn Outcome> {
    results::run_in(folder, &format!("{ON_STEEL}{compare}\n{surfaces}")).unwrap()
}

fn surface(name: &str, file: &str, count: usize) -> String {
    format!(
        "[surface.{name}.asperities]\nfile = \"{file}\"\nnominal-area = {:e}\nindependent = true\n",
        count as f64 / 6e10
    )
}

#[test]
fn the_columns_add_up_to_the_difference() {
    let folder = tempfile::tempdir().unwrap();
    list(folder.path(), "list.csv", 20_000, true);
    let outcome = run(folder.path(), COMPARE, &surface("list", "list.csv", 20_000));
    let pairs = table(&*outcome, "comparison.csv").unwrap();
    assert_eq!(pairs.len(), 7);
    let rows = table(&*outcome, "attribution.csv").unwrap();
    for pair in &pairs {
        let sum = |of: &str| {
            ["heights", "radii", "correlation"]
                .map(|cause| number(pair, &format!("{of}_{cause}")))
                .iter()
                .sum::<f64>()
        };
        assert!((sum("separation_from") - number(pair, "difference_separation_over_sigma")).abs() < 1e-10);
        let ratio = number(pair, "statistical_area_ratio") / number(pair, "deterministic_area_ratio");
        assert!((sum("log_area_from") - ratio.ln()).abs() < 1e-10);
        let of_load =
            rows.iter().filter(|row| row["pressure_pa"] == pair["target"] && row["quantity"] == "separation");
        for row in of_load.clone().filter(|row| row["cause"] != "radii-and-correlation") {
            let cause = format!("separation_from_{}", row["cause"]);
            assert_eq!(row["contribution"], pair[&cause]);
            let orders =
                ["heights_radii_correlation", "radii_heights_correlation", "radii_correlation_heights"];
            let mean = orders.map(|order| number(row, order)).iter().sum::<f64>() / 3.0;
            assert!((mean - number(row, "contribution")).abs() < 1e-12);
            assert!(
                number(row, "low") < number(row, "contribution")
                    && number(row, "contribution") < number(row, "high")
            );
        }
        assert_eq!(of_load.count(), 4);
    }
}

/// The leading causes of the largest differences in separation, of verdicts that are not within what is accepted.
fn leads(outcome: &dyn Outcome) -> Vec<String> {
    let rows = table(outcome, "verdicts.csv").unwrap();
    let open = rows.iter().filter(|row| row["quantity"] == "separation" && row["verdict"] != "within");
    open.map(|row| row["cause"].clone()).collect()
}

#[test]
fn the_cause_that_leads_is_named() {
    let folder = tempfile::tempdir().unwrap();
    list(folder.path(), "correlated.csv", 20_000, true);
    list(folder.path(), "independent.csv", 20_000, false);
    let correlated = run(folder.path(), COMPARE, &surface("list", "correlated.csv", 20_000));
    assert!(leads(&*correlated).iter().any(|cause| cause == "correlation"), "{:?}", leads(&*correlated));
    assert!(correlated.outline().markdown().contains("list-causes.svg"));
    let independent = run(folder.path(), COMPARE, &surface("list", "independent.csv", 20_000));
    assert!(!leads(&*independent).iter().any(|cause| cause == "correlation"), "{:?}", leads(&*independent));
    // The heights of a population are its own; of equal radii there is no spread.
    let population = population("p", 100_000, "heights.johnson = { skewness = -1, kurtosis = 4.5 }");
    let text = format!("statistical = {{ heights = \"gaussian\" }}\n{COMPARE}");
    let skewed = run(folder.path(), &text, &population);
    assert!(leads(&*skewed).iter().any(|cause| cause == "heights"), "{:?}", leads(&*skewed));
    let rows = table(&*skewed, "attribution.csv").unwrap();
    let spread = rows.iter().filter(|row| row["cause"] == "radii");
    assert!(spread.map(|row| number(row, "contribution").abs()).fold(0.0, f64::max) < 1e-9);
}

/// The row of a case without admissible loads is blank in the verdict map.
#[test]
fn a_case_without_admissible_loads_is_blank_in_the_verdict_map() {
    let folder = tempfile::tempdir().unwrap();
    list(folder.path(), "correlated.csv", 20_000, true);
    list(folder.path(), "few.csv", 100, true);
    let surfaces = [
        surface("a", "correlated.csv", 20_000),
        surface("b", "correlated.csv", 20_000),
        surface("few", "few.csv", 100),
    ];
    let outcome = run(folder.path(), COMPARE, &surfaces.concat());
    let map = figure(&*outcome, "verdicts.svg").unwrap();
    assert!(["a", "b", "few"].iter().all(|name| map.contains(&format!("\n{name}\n"))), "{map}");
    let pair = [surface("few", "few.csv", 100), surface("less", "few.csv", 100)];
    assert!(figure(&*run(folder.path(), COMPARE, &pair.concat()), "verdicts.svg").is_none());
}

#[test]
fn few_contacts_and_a_single_model_have_no_parts() {
    let folder = tempfile::tempdir().unwrap();
    list(folder.path(), "few.csv", 100, true);
    let outcome = run(folder.path(), COMPARE, &surface("few", "few.csv", 100));
    assert!(table(&*outcome, "attribution.csv").is_none());
    assert!(
        table(&*outcome, "comparison.csv").unwrap().iter().all(|row| row["separation_from_radii"].is_empty())
    );
    for off in ["attribution = false", "models = [\"deterministic\"]"] {
        let outcome = run(folder.path(), &format!("{off}\n{COMPARE}"), &surface("few", "few.csv", 100));
        assert!(table(&*outcome, "attribution.csv").is_none(), "{off}");
        assert!(!outcome.outline().markdown().contains("why do the models differ?"), "{off}");
    }
}

/// The largest difference in separation of the first surface, in sigma.
fn largest_gap(outcome: &dyn Outcome) -> f64 {
    let rows = table(outcome, "comparison.csv").unwrap();
    rows.iter().map(|row| number(row, "difference_separation_over_sigma").abs()).fold(0.0, f64::max)
}

/// Each statistical model removes the cause that it models, and leaves the others.
#[test]
fn other_statistical_models() {
    let folder = tempfile::tempdir().unwrap();
    list(folder.path(), "list.csv", 20_000, true);
    let correlated = |statistical: &str| {
        run(folder.path(), &format!("{statistical}\n{COMPARE}"), &surface("list", "list.csv", 20_000))
    };
    let (usual, own) = (correlated(""), correlated("statistical = { heights = \"own\" }"));
    let touching = correlated("statistical = { mean-radius = \"in-contact\" }");
    assert!(largest_gap(&*usual) > 0.15 && largest_gap(&*own) > 0.15, "{}", largest_gap(&*own));
    assert!(largest_gap(&*touching) < 0.1, "{}", largest_gap(&*touching));
    let page = touching.outline().markdown();
    assert!(page.contains("takes the mean radius of the asperities in contact"), "{page}");
    assert!(table(&*touching, "attribution.csv").is_none());

    let population = population("p", 100_000, "heights.johnson = { skewness = 1, kurtosis = 4.5 }");
    let skewed = |heights: &str| {
        let text = format!("statistical = {{ heights = \"{heights}\" }}\n{COMPARE}");
        largest_gap(&*run(folder.path(), &text, &population))
    };
    assert!(skewed("gaussian") > 0.4, "{}", skewed("gaussian"));
    // A Weibull distribution of this skewness has another kurtosis.
    for (heights, most) in [("own", 0.1), ("fitted-johnson", 0.1), ("fitted-weibull", 0.25)] {
        assert!(skewed(heights) < most, "{heights}: {}", skewed(heights));
    }
}
