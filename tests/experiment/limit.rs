//! `[limit]` from the spec to the slopes of the report.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::format::number;

use crate::Report;
use crate::results::{self, table};

fn run(separation: f64, largest: f64) -> Box<dyn Outcome> {
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[limit]\nrough = \"steel\"\nflat = \"steel\"\nlaw = [\"hertz\", \"zmc\"]\n{}\
         separation = {{ values = [{separation}] }}\ncount = {{ from = 1e2, to = {largest:e}, points = 7 }}\ndraws = 8\n",
        steel!(),
        case_1!(),
    );
    results::run(&spec).unwrap()
}

#[test]
fn slopes_at_the_quantiles_are_those_of_the_leading_error() {
    let outcome = run(0.0, 1e5);
    let slopes = table(&*outcome, "slopes.csv").unwrap();
    let largest = |heights: &str| {
        let of_heights = slopes.iter().filter(|slope| slope["heights"] == heights);
        number(of_heights.map(|slope| results::number(slope, "deviation").abs()).fold(0.0, f64::max))
    };
    let lead = format!(
        "to the power −½ within {}. With heights at the quantiles the power is the expected one within {}.",
        largest("random"),
        largest("quantiles")
    );
    let page = outcome.outline().markdown();
    assert!(page.contains(&lead), "{lead}\n{page}");
    assert_eq!(slopes.len(), 8, "two laws, two quantities, random and at the quantiles");
    for slope in slopes {
        let number = |key: &str| results::number(&slope, key);
        let (found, expected) = (number("slope"), number("expected_slope"));
        if slope["heights"] == "random" {
            assert_eq!(expected, -0.5);
        } else {
            assert!((found - expected).abs() < 2e-3, "{slope:?}");
            // The logarithm is seen: -1 is ten times as far off.
            assert!((found + 1.0).abs() > 0.02, "{slope:?}");
        }
    }
}

#[test]
fn too_few_contacts_have_no_slope() {
    let outcome = run(3.0, 1e3);
    assert!(table(&*outcome, "slopes.csv").is_none());
    assert!(outcome.outline().markdown().contains("Too few contacts are expected for a fit to the error."));
}
