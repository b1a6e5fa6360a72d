//! `ranking.csv` and `statistical_models.csv`: other statistical models; `robustness.csv`: other treatments of a map.

use asperity::MeanRadius;
use asperity::compare::{ComparedQuantity, Difference, Estimate, Verdict};
use asperity::study::{
    Against, HeldOut, Largest, Ranked, Standing, StatisticalModel, Treated, Treatment, Verdicts,
};
use asperity_contact_framework::report::format::quantity;
use asperity_contact_framework::rows;

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;

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

rows! { RankingRow<'_> => "ranking.csv";
    "One row for each surface, law, layer thickness, statistical model that applies and quantity, on the first realisation: the largest difference of the model from the sum, and from the reference where one was run, over the admissible loads (three per decade, and those of the reference). Models that are fitted to the asperities are ranked by the larger one of their differences in sample and held out.";
    ..case_columns(|row: &Self| row.key);
    row =>
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

rows! { StandingRow<'_> => "statistical_models.csv";
    "One row for each surface, law, layer thickness, quantity and what the statistical models are compared with, on the first realisation: which of the models of `ranking.csv` differ by no more than is accepted on this very surface, without an interval.";
    ..case_columns(|row: &Self| row.key);
    row =>
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
}

pub(super) fn standings(results: &CompareResults) -> impl Iterator<Item = StandingRow<'_>> {
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

/// One quantity at one load under one treatment.
pub(crate) struct RobustnessRow<'a> {
    key: CaseKey<'a>,
    treated: &'a Treated,
    at_load: &'a Difference,
    quantity: ComparedQuantity,
    estimate: Estimate,
    verdicts: &'a Verdicts,
}

impl RobustnessRow<'_> {
    fn end(&self, index: usize) -> Option<f64> {
        self.estimate.interval().map(|ends| self.quantity.reported(ends[index]))
    }
}

rows! { RobustnessRow<'_> => "robustness.csv", is_long true;
    "One row for each surface, law, layer thickness, other treatment of a measured map, load and quantity: the difference of the statistical from the deterministic model at equal load.";
    ..case_columns(|row: &Self| row.key);
    row =>
    choice["text"] = row.treated.treatment.choice().name(), "The choice that is made in another way: `short-wavelength-cut-off`, `summits`, `mean-radius`, `level`, `spikes` or `part`.";
    treatment["text"] = words(row.treated.treatment), "How it is made.";
    quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
    at_pa["Pa", prefix("M"), label("at")] = row.at_load.load, "Nominal pressure.";
    valid["true/false"] = row.at_load.exceeded().is_none(), "Whether the load is admissible under this treatment.";
    difference["1", signed, scale(1.0)] = row.quantity.reported(row.estimate.contrast), "The difference: of the separation in sigma, of area and stiffness relative to the deterministic model.";
    low["1", label("95 % interval from"), signed, scale(1.0)] = row.end(0), "Lower end of its 95 % interval; empty where none is claimed.";
    high["1", label("to"), signed, scale(1.0)] = row.end(1), "Upper end of the interval.";
    verdict["text", verdict] = Verdict::from_estimate(&row.estimate, row.verdicts.accepted.band(row.quantity)).name(), "The verdict by the interval: `within`, `beyond` or `cannot-tell`.";
}

/// Case by case, treatment by treatment.
pub(super) fn robustness(results: &CompareResults) -> impl Iterator<Item = RobustnessRow<'_>> {
    SurfaceCase::all(results)
        .flat_map(|case| case.case.treated.iter().flat_map(move |treated| with_treatment(case, treated)))
}

fn with_treatment<'a>(
    case: SurfaceCase<'a>,
    treated: &'a Treated,
) -> impl Iterator<Item = RobustnessRow<'a>> {
    treated.differences.iter().flat_map(move |at_load| {
        ComparedQuantity::ALL.into_iter().filter_map(move |quantity| {
            let estimate = at_load.estimates[quantity as usize]?;
            let verdicts = case.verdicts();
            Some(RobustnessRow { key: case.key(), treated, at_load, quantity, estimate, verdicts })
        })
    })
}

pub fn words(treatment: Treatment) -> String {
    match treatment {
        Treatment::ShortWaves(None) => "no S filter".to_owned(),
        Treatment::ShortWaves(Some(s)) => format!("S filter {}", quantity(s, "m")),
        Treatment::Summits(neighbours) => format!("{} summits", neighbours.name()),
        Treatment::MeanRadius(MeanRadius::InverseMeanCurvature) => "1/(mean curvature)".to_owned(),
        Treatment::MeanRadius(mean) => format!("{} mean radius", mean.name()),
        Treatment::Level(level) => format!("level {}", level.name()),
        Treatment::SpikesRemoved => "spikes removed".to_owned(),
        Treatment::SuspectsRemoved(1) => "1 narrow point removed".to_owned(),
        Treatment::SuspectsRemoved(count) => format!("{count} narrow points removed"),
        Treatment::Half(half) => format!("half {} of the map", half + 1),
    }
}
