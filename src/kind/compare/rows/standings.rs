//! `statistical_models.csv`: which statistical models are within what is accepted on the surface that was compared.

use asperity::compare::ComparedQuantity;
use asperity::study::{Against, HeldOut, Standing, StatisticalModel};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;

/// How the statistical models stand in one quantity on one surface.
pub(crate) struct StandingRow<'a> {
    key: CaseKey<'a>,
    alpha: Option<f64>,
    against: Against,
    accepted: f64,
    standing: Standing<'a>,
    is_blocked: bool,
    tested_on: Option<HeldOut>,
    tested_loads: Option<[f64; 2]>,
    inapplicable: &'a [(StatisticalModel, String)],
    elastic: Option<&'a ElasticCase>,
}

impl StandingRow<'_> {
    /// What fitted models are tested on: of the reference other realisations only.
    fn tested_on(&self) -> Option<HeldOut> {
        let is_tested = |tested_on: &HeldOut| {
            self.against == Against::Sum || matches!(tested_on, HeldOut::Realisations(_))
        };
        self.tested_on.filter(is_tested)
    }

    /// The lowest or the highest load of that, Pa.
    fn tested_load(&self, end: usize) -> Option<f64> {
        self.tested_on().and(self.tested_loads).map(|loads| loads[end])
    }

    fn nearest_difference(&self) -> Option<f64> {
        self.standing.nearest().map(|(_, contrast)| self.standing.quantity.reported(contrast))
    }
}

impl Row for StandingRow<'_> {
    const FILE: &'static str = "statistical_models.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, quantity and what the statistical models are compared with, on the first realisation: which of the models of `ranking.csv` differ by no more than is accepted on this very surface, without an interval.";
    const RECORDS: Option<&'static str> = Some("statistical_models");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            nayak_alpha["1", label("Nayak's α")] = row.alpha, "Nayak's bandwidth parameter of the map; empty without a map.";
            quantity["text"] = row.standing.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            against["text"] = row.against.name(), "What the models are compared with: `deterministic` or `reference`.";
            accepted["1"] = row.accepted, "The largest difference that is accepted.";
            within["text"] = row.standing.within.iter().map(|(ranked, _)| ranked.model.name()).collect::<Vec<_>>(), "The models within what is accepted, the simplest first; fitted ones (fitted or own heights, or the radius in contact) on asperities too that they were not taken from.";
            cheapest_within["text"] = row.standing.cheapest().filter(|_| !row.is_blocked).map(|(ranked, _)| ranked.model.name()), "The one that evaluates the fewest contacts at a separation, of equal ones the simplest; empty on a blocked map.";
            within_in_sample["text", label("in sample only")] = row.standing.within_in_sample.iter().map(|ranked| ranked.model.name()).collect::<Vec<_>>(), "Fitted models that are within it on the asperities that they were taken from only, which carries no conclusion.";
            fitted_tested_on["text", label("fitted models tested on")] = row.tested_on().map_or("in sample only", HeldOut::name), "What fitted models are held out on: `halves of the surface`, `random halves`, `realisations`; `in sample only` where there is nothing.";
            tested_from_pa["Pa", prefix("M"), label("from"), input] = row.tested_load(0), "The lowest load of that, which is admissible there.";
            tested_to_pa["Pa", prefix("M"), label("to"), input] = row.tested_load(1), "The highest load of that.";
            nearest["text"] = row.standing.nearest().map(|(ranked, _)| ranked.model.name()), "The model with the smallest largest difference, among those that are compared.";
            nearest_difference["1", signed, scale(1.0)] = row.nearest_difference(), "Its largest difference: of the separation in sigma, else relative.";
            elastic_reference["text", label("elastic reference")] = row.elastic.map(|elastic| elastic.reason.name()), "Against the reference: why it stays elastic although the law yields, as in `nearer_to_reference.csv`; empty otherwise.";
            inapplicable["text"] = row.inapplicable.iter().map(|(model, reason)| format!("{} ({reason})", model.name())).collect::<Vec<_>>(), "The models that do not apply to the surface, and why.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = StandingRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let alpha = case.surface.surface.map.as_ref().and_then(|map| map.roughness.alpha());
        let accepted = &case.verdicts().accepted;
        let elastic = results.elastic_reference(case);
        case.case.ranking.iter().flat_map(move |ranking| {
            let is_blocked = case.verdicts().is_blocked;
            let each = ranking
                .against()
                .iter()
                .flat_map(|&against| ComparedQuantity::ALL.map(|quantity| (against, quantity)))
                .filter(move |(_, quantity)| case.compares(*quantity));
            each.map(move |(against, quantity)| StandingRow {
                key: case.key(),
                alpha,
                against,
                accepted: accepted.limit(quantity),
                standing: ranking.standing(against, quantity, accepted),
                is_blocked,
                tested_on: ranking.tested_on,
                tested_loads: ranking.tested_loads,
                inapplicable: &ranking.inapplicable,
                elastic: elastic.filter(|_| against == Against::Reference),
            })
        })
    })
}
