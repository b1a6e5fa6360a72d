//! `ranking.csv`: how far each statistical model is from the sum and from the reference.

use asperity::compare::ComparedQuantity;
use asperity::study::{Against, HeldOut, Largest, Ranked};
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
    tested_on: Option<HeldOut>,
}

impl RankingRow<'_> {
    fn reported(&self, largest: Largest) -> Option<f64> {
        largest.map(|(contrast, _)| self.quantity.reported(contrast))
    }

    fn load(largest: Largest) -> Option<f64> {
        largest.map(|(_, load)| load)
    }

    fn in_sample(&self, against: Against) -> Largest {
        self.ranked.in_sample.largest(against, self.quantity)
    }

    fn held_out(&self, against: Against) -> Largest {
        self.ranked.held_out.as_ref()?.largest(against, self.quantity)
    }

    /// What the row's figures from the sum were found on.
    fn tested_on(&self) -> &'static str {
        if !self.ranked.model.is_fitted() {
            return "not fitted";
        }
        let tested_on = self.tested_on.filter(|_| self.held_out(Against::Sum).is_some());
        tested_on.map_or("in sample only", HeldOut::name)
    }
}

impl Row for RankingRow<'_> {
    const FILE: &'static str = "ranking.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, statistical model that applies and quantity, on the first realisation: the largest difference of the model from the sum, and from the reference where one was run, over the admissible loads (three per decade, and those of the reference). Models that are fitted to the asperities are ranked by the larger one of their differences in sample and held out.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            nayak_alpha["1"] = row.alpha, "Nayak's bandwidth parameter of the map; empty without a map.";
            model["text"] = row.ranked.model.name(), "The statistical model: its heights and its radius, or `nayak-greenwood` or `five-point`, joint densities of height and curvature.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            from_deterministic["1", label("from deterministic, in sample"), signed, scale(1.0)] = row.reported(row.in_sample(Against::Sum)), "In sample, on the asperities that the model was taken from: the difference from the deterministic model that is largest in magnitude, of the separation in sigma, of area and stiffness relative to it; empty where the model does not reach a load.";
            from_deterministic_at_pa["Pa"] = RankingRow::load(row.in_sample(Against::Sum)), "The nominal pressure of that difference.";
            held_out_from_deterministic["1", label("from deterministic, held out"), signed, scale(1.0)] = row.reported(row.held_out(Against::Sum)), "Of a fitted model (fitted or own heights, or the radius in contact) on asperities that it was not taken from: the larger one from each half on the other, or the largest on the other realisations; empty of other models, and where no load is admissible there.";
            held_out_from_deterministic_at_pa["Pa"] = RankingRow::load(row.held_out(Against::Sum)), "The nominal pressure of that difference.";
            tested_on["text"] = row.tested_on(), "What a fitted model is held out on: `halves of the surface`, `random halves`, `realisations`; `in sample only` where there is nothing, which carries no conclusion; `not fitted` of other models.";
            from_reference["1", label("from reference, in sample"), signed, scale(1.0)] = row.reported(row.in_sample(Against::Reference)), "In sample, from the reference; empty where none was run.";
            from_reference_at_pa["Pa"] = RankingRow::load(row.in_sample(Against::Reference)), "The nominal pressure of that difference.";
            held_out_from_reference["1", label("from reference, held out"), signed, scale(1.0)] = row.reported(row.held_out(Against::Reference)), "Of a fitted model from the references of the other realisations; empty without these: the reference of a map is none of its halves.";
            held_out_from_reference_at_pa["Pa"] = RankingRow::load(row.held_out(Against::Reference)), "The nominal pressure of that difference.";
            accepted["1"] = row.accepted, "The largest difference that is accepted.";
            contacts_per_separation["1"] = row.ranked.evaluations, "Contacts evaluated at one separation, the mean over the loads: what the model costs; 0 where it reaches none of them.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = RankingRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let alpha = case.surface.surface.map.as_ref().and_then(|map| map.roughness.alpha());
        let accepted = case.verdicts().accepted;
        let models =
            case.case.ranking.iter().flat_map(move |ranking| {
                ranking.models.iter().map(move |ranked| (ranked, ranking.tested_on))
            });
        models.flat_map(move |(ranked, tested_on)| {
            let compared = ComparedQuantity::ALL.into_iter().filter(move |quantity| case.compares(*quantity));
            compared.map(move |quantity| RankingRow {
                key: case.key(),
                alpha,
                ranked,
                quantity,
                accepted: accepted.limit(quantity),
                tested_on,
            })
        })
    })
}
