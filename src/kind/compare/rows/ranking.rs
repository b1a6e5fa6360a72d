//! `ranking.csv`: how far each statistical model is from the sum and from the reference.

use asperity::compare::ComparedQuantity;
use asperity::study::{Against, Largest, Ranked};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

/// One model and one quantity.
pub(crate) struct RankingRow<'a> {
    key: CaseKey<'a>,
    alpha: Option<f64>,
    ranked: &'a Ranked,
    quantity: ComparedQuantity,
    accepted: f64,
}

impl RankingRow<'_> {
    fn reported(&self, largest: Largest) -> Option<f64> {
        largest.map(|(contrast, _)| self.quantity.reported(contrast))
    }

    fn load(largest: Largest) -> Option<f64> {
        largest.map(|(_, load)| load)
    }

    fn largest(&self, against: Against) -> Largest {
        self.ranked.largest(against, self.quantity)
    }
}

impl Row for RankingRow<'_> {
    const FILE: &'static str = "ranking.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, statistical model that applies and quantity, on the first realisation: the largest difference of the model from the sum, and from the reference where one was run, over the valid loads (three per decade, and those of the reference).";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            nayak_alpha["1"] = row.alpha, "Nayak's bandwidth parameter of the map; empty without a map.";
            model["text"] = row.ranked.model.name(), "The statistical model: its heights and its radius, or `nayak-greenwood` or `five-point`, joint densities of height and curvature.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            from_deterministic["1", signed, scale(1.0)] = row.reported(row.largest(Against::Sum)), "The difference from the deterministic model that is largest in magnitude: of the separation in sigma, of area and stiffness relative to it; empty where the model does not reach a load.";
            from_deterministic_at_pa["Pa"] = RankingRow::load(row.largest(Against::Sum)), "The nominal pressure of that difference.";
            from_reference["1", signed, scale(1.0)] = row.reported(row.largest(Against::Reference)), "The same from the reference; empty where none was run.";
            from_reference_at_pa["Pa"] = RankingRow::load(row.largest(Against::Reference)), "The nominal pressure of that difference.";
            accepted["1"] = row.accepted, "The largest difference that is accepted.";
            contacts_per_load["1"] = row.ranked.evaluations, "Contacts evaluated per load, the search for the separation included: what the model costs.";
        });
        columns
    }
}

/// The rows.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = RankingRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let alpha = case.surface.surface.map.as_ref().and_then(|map| map.roughness.alpha());
        let accepted = case.verdicts().accepted;
        let models = case.case.ranking.iter().flat_map(|ranking| &ranking.models);
        models.flat_map(move |ranked| {
            ComparedQuantity::ALL.map(|quantity| RankingRow {
                key: case.key(),
                alpha,
                ranked,
                quantity,
                accepted: accepted.limit(quantity),
            })
        })
    })
}
