//! Verdicts against the reference, and the bound of its grid.

use asperity_contact_framework::Outcome;

use super::{THREE, run};
use crate::Report;
use crate::results::{self, Row, figure, number, table, typed};

/// Rough, with a short correlation length: it holds blocks.
const BLOCKS: &str = generated!("a", 384, "0.5 um", "50 nm", "8 um" to "4 um");

#[test]
fn verdicts_against_the_reference_are_those_of_the_tables() {
    let loads = "pressure = { from = \"10 MPa\", to = \"200 MPa\", points = 9 }\n";
    let outcome = run(&format!("law = \"hertz\"\n{THREE}{loads}"), BLOCKS);
    let pairs = table(&*outcome, "comparison.csv").unwrap();
    let differences = table(&*outcome, "differences.csv").unwrap();
    let mut compared = 0;
    for row in differences.iter().filter(|row| row["against"] == "reference" && row["quantity"] == "area") {
        let pair = pairs.iter().find(|pair| pair["target"] == row["pressure_pa"]).unwrap();
        let reference = number(pair, "reference_area_ratio");
        let relative = number(pair, &format!("{}_area_ratio", row["model"])) / reference - 1.0;
        assert!((number(row, "difference") - relative).abs() < 1e-12, "{row:?}");
        if row["model"] == "deterministic" {
            assert!((number(pair, "log_area_from_interaction") - relative.ln_1p()).abs() < 1e-12);
        }
        // The error of the grid is in the interval.
        assert!(number(row, "bound") > 0.01);
        if let Ok(high) = row["high"].parse::<f64>() {
            let half = number(row, "bound") + 1.0 * number(row, "standard_error");
            assert!(high.ln_1p() >= relative.ln_1p() + half);
        }
        compared += 1;
    }
    assert_eq!(compared, 2 * 9);
    let summary = outcome.records();
    let verdicts = summary["verdicts"].as_array().unwrap();
    for model in ["statistical", "deterministic"] {
        let of: Vec<_> =
            verdicts.iter().filter(|one| one["against"] == "reference" && one["model"] == model).collect();
        assert!(of.iter().any(|one| one["quantity"] == "area"), "{model}");
        assert!(of.iter().any(|one| one["verdict"] != "cannot-tell"), "{model}: {of:?}");
        // The difference of the sum is all of one part, which is no cause.
        let has_cause = of.iter().any(|one| !one["cause"].is_null() || !one["largest_on_map"].is_null());
        assert_eq!(has_cause, model == "statistical", "{of:?}");
    }
    let nearer = typed(table(&*outcome, "nearer_to_reference.csv").unwrap());
    let of_area: Vec<_> = nearer.iter().filter(|one| one["quantity"] == "area").collect();
    assert!(of_area.iter().any(|one| one["nearer_on_this_map"] == "deterministic"), "{nearer:?}");
    // The card names the models that the table has at admissible loads, and the differences at its own.
    let line = |outcome: &dyn Outcome, key: &str| {
        let lines = outcome.outline().answer().lines;
        lines.into_iter().find(|line| line.key == key).map(|line| line.text()).unwrap_or_default()
    };
    let said = line(&*outcome, "nearer");
    for (model, name) in [("deterministic", "the sum "), ("statistical", "the integral ")] {
        let is_it = |one: &&&serde_json::Value| one["nearer_on_this_map"] == model && one["limits"].is_null();
        assert_eq!(said.contains(name), of_area.iter().any(|one| is_it(&one)), "{said}: {of_area:?}");
    }
    assert!(said.contains("against them") && !line(&*outcome, "instead").is_empty(), "{said}");
    let without =
        run(&format!("law = \"hertz\"\nmodels = [\"statistical\", \"deterministic\"]\n{loads}"), BLOCKS);
    assert!(line(&*without, "nearer").starts_with("Not computed: "));
    assert!(outcome.outline().markdown().contains("Which model is nearer to the reference?"));
    assert!(figure(&*outcome, "a-against-reference.svg").unwrap().contains("deterministic − reference"));
    let layers = "layer = { material = \"lead\", thickness = [0, \"200 nm\"] }\n";
    let layered = run(&format!("law = \"hertz\"\n{THREE}{layers}{loads}"), BLOCKS);
    assert!(figure(&*layered, "a-against-reference.svg").unwrap().contains("200 nm"));
    // Of several cases the nearer model is in the row of each, and counted.
    let nearer = typed(table(&*layered, "nearer_to_reference.csv").unwrap());
    let answers = table(&*layered, "answers.csv").unwrap();
    assert_eq!(answers.len(), 2);
    for answer in &answers {
        let of_case = nearer.iter().filter(|one| {
            one["layer_thickness_m"].as_f64() == answer["layer_thickness_m"].parse().ok()
                && one["quantity"] == "area"
                && one["limits"].is_null()
        });
        let found: Vec<_> = of_case.filter_map(|one| one["nearer_on_this_map"].as_str()).collect();
        let expected = match ["deterministic", "statistical"].map(|model| found.contains(&model)) {
            [true, true] => "depends on load",
            [true, false] => "the sum",
            [false, true] => "the integral",
            [false, false] => "?",
        };
        assert_eq!(answer["nearer"], expected, "{found:?}");
    }
    let said = layered.outline().answer().sentence;
    assert!(said.contains("Nearer to boundary elements in contact area, where decided: "), "{said}");
    assert_eq!(table(&*without, "answers.csv").unwrap()[0]["nearer"], "");
}

/// On a broad spectrum the reference has half as much area again as the models: at 60 MPa more than 5 %.
#[test]
fn models_are_ranked_where_the_area_of_the_reference_is_admissible_too() {
    let loads = "pressure = { values = [\"42 MPa\", \"60 MPa\"] }\n";
    let broad = BLOCKS.replace("384", "512").replace("50 nm", "100 nm").replace("8 um", "96 um");
    let outcome = run(&format!("law = \"hertz\"\n{THREE}{loads}"), &broad);
    let pairs = table(&*outcome, "comparison.csv").unwrap();
    let heaviest =
        pairs.iter().find(|pair| pair["target"] == "60000000.0" && pair["pairing"] == "load").unwrap();
    assert!(heaviest["limits"].is_empty() && number(heaviest, "reference_area_ratio") > 0.05, "{heaviest:?}");
    let ranking = table(&*outcome, "ranking.csv").unwrap();
    let at = |column: &str| ranking.iter().filter(|row| row[column] == "60000000.0").count();
    assert_eq!(at("from_reference_at_pa"), 0);
    assert!(ranking.iter().any(|row| !row["from_reference"].is_empty()));
}

#[test]
fn separations_have_a_bound_and_a_second_resolution_narrows_it() {
    let loads = "pressure = { values = [\"20 MPa\", \"40 MPa\", \"80 MPa\"] }\n";
    let bounds = |refine: &str| -> Vec<f64> {
        let outcome = run(&format!("law = \"hertz\"\n{THREE}{refine}{loads}"), BLOCKS);
        let rows = table(&*outcome, "differences.csv").unwrap();
        let of = |row: &&Row| {
            row["against"] == "reference" && row["quantity"] == "separation" && row["model"] == "statistical"
        };
        rows.iter().filter(of).map(|row| number(row, "bound")).collect()
    };
    let [one, two] = ["", "reference = { refine = 2 }\n"].map(bounds);
    assert!(one.len() == 3 && one.iter().all(|bound| (1e-3..0.01).contains(bound)), "{one:?}");
    assert!(two.iter().zip(&one).all(|(two, one)| (1e-5..*one).contains(two)), "{two:?} of {one:?}");
}

/// Elastic boundary elements are advised beside elastic contacts of a law that may yield, and not beside contacts that do.
#[test]
fn elastic_boundary_elements_are_no_advice_where_contacts_yield() {
    let advice = |hardness: &str, pressure: &str| {
        let spec = format!(
            r#"title = "t"
seed = 3
[material.body]
young = "210 GPa"
poisson = 0.3
hardness = "{hardness}"
[compare]
rough = "body"
flat = "body"
law = "zmc"
models = ["statistical", "deterministic", "reference"]
reference = {{ cap = "none" }}
accept = {{ area = 0.001 }}
robustness = false
pressure = "{pressure}"
{}"#,
            generated!("map", 512, "1 um", "100 nm", "40 um" to "16 um")
        );
        let page = results::run(&spec).unwrap().outline().markdown();
        let line = page.lines().find(|line| line.starts_with("| **Use instead**"));
        line.unwrap_or_else(|| panic!("{page}")).to_owned()
    };
    assert!(advice("90 GPa", "20 MPa").contains("Boundary elements: the sum differs"));
    let yielding = advice("1 GPa", "20 MPa");
    assert!(!yielding.contains("oundary elements"), "{yielding}");
    let interacting = advice("1 GPa", "200 MPa");
    assert!(interacting.contains("boundary elements stay elastic while contacts yield"), "{interacting}");
}
