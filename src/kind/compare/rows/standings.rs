//! `statistical_models.csv`: which statistical model is enough.

use asperity::compare::ComparedQuantity;
use asperity::study::{Against, Standing, StatisticalModel};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

/// How the statistical models stand in one quantity on one surface.
pub(crate) struct StandingRow<'a> {
    key: CaseKey<'a>,
    alpha: Option<f64>,
    against: Against,
    accepted: f64,
    standing: Standing<'a>,
    inapplicable: &'a [(StatisticalModel, String)],
}

impl StandingRow<'_> {
    fn nearest_difference(&self) -> Option<f64> {
        self.standing.nearest().map(|(_, contrast)| self.standing.quantity.reported(contrast))
    }
}

impl Row for StandingRow<'_> {
    const FILE: &'static str = "statistical_models.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, quantity and what the statistical models are compared with, on the first realisation: which of the models of `ranking.csv` are enough.";
    const RECORDS: Option<&'static str> = Some("statistical_models");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            nayak_alpha["1", label("Nayak's α")] = row.alpha, "Nayak's bandwidth parameter of the map; empty without a map.";
            quantity["text"] = row.standing.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            against["text"] = row.against.name(), "What the models are compared with: `deterministic` or `reference`.";
            accepted["1"] = row.accepted, "The largest difference that is accepted.";
            within["text"] = row.standing.within.iter().map(|(ranked, _)| ranked.model.name()).collect::<Vec<_>>(), "The models within what is accepted, the simplest first.";
            cheapest_within["text"] = row.standing.cheapest().map(|(ranked, _)| ranked.model.name()), "The one that evaluates the fewest contacts.";
            nearest["text"] = row.standing.nearest().map(|(ranked, _)| ranked.model.name()), "The model with the smallest largest difference.";
            nearest_difference["1", signed, scale(1.0)] = row.nearest_difference(), "Its largest difference: of the separation in sigma, else relative.";
            inapplicable["text"] = row.inapplicable.iter().map(|(model, reason)| format!("{} ({reason})", model.name())).collect::<Vec<_>>(), "The models that do not apply to the surface, and why.";
        });
        columns
    }
}

/// The rows.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = StandingRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let alpha = case.surface.surface.map.as_ref().and_then(|map| map.roughness.alpha());
        let accepted = &case.verdicts().accepted;
        case.case.ranking.iter().flat_map(move |ranking| {
            let each = ranking
                .against()
                .iter()
                .flat_map(|&against| ComparedQuantity::ALL.map(|quantity| (against, quantity)));
            each.map(move |(against, quantity)| StandingRow {
                key: case.key(),
                alpha,
                against,
                accepted: accepted.limit(quantity),
                standing: ranking.standing(against, quantity, accepted),
                inapplicable: &ranking.inapplicable,
            })
        })
    })
}
