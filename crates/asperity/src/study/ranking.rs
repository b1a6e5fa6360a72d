//! How far each statistical model of a surface is from the sum and from the reference, and what it costs.

use super::law::LawContact;
use crate::compare::{Accepted, ComparedQuantity, Pair, Pairing, ReferenceCurve, of_each_decade};
use crate::distribution::HeightsError;
use crate::work::{CountedContact, Counter};
use crate::{Response, reached_at};

use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::Setup;
use super::statistical::StatisticalModel;
use crate::surface::Surface;

/// Loads per decade at which models are compared.
const PER_DECADE: f64 = 3.0;

/// What a model is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The sum over the asperities.
    Sum,
    /// The boundary element reference.
    Reference,
}

impl Against {
    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sum => "deterministic",
            Self::Reference => "reference",
        }
    }
}

/// The largest contrast of a model, with its load, Pa.
pub type Largest = Option<(f64, f64)>;

/// A model on one surface under one law.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The model.
    pub model: StatisticalModel,
    /// The largest difference from the sum in each of [`ComparedQuantity::ALL`].
    pub from_sum: [Largest; 3],
    /// The largest difference from the reference; `None` where there is none.
    pub from_reference: [Largest; 3],
    /// Contacts evaluated per load.
    pub evaluations: f64,
}

/// The models on one surface under one law.
#[derive(Debug, Clone, Default)]
pub struct Ranking {
    /// Those that apply.
    pub models: Vec<Ranked>,
    /// Those that do not, and why.
    pub inapplicable: Vec<(StatisticalModel, String)>,
    /// The largest difference of the sum from the reference.
    pub sum_from_reference: [Largest; 3],
    /// The loads at which the models were compared, Pa.
    pub loads: Vec<f64>,
}

/// How the models stand in one quantity.
#[derive(Debug)]
pub struct Standing<'a> {
    /// The quantity.
    pub quantity: ComparedQuantity,
    /// The models that are compared, with their largest contrasts.
    pub compared: Vec<(&'a Ranked, f64)>,
    /// Those within what is accepted.
    pub within: Vec<(&'a Ranked, f64)>,
}

impl Standing<'_> {
    /// The cheapest model within what is accepted.
    pub fn cheapest(&self) -> Option<(&Ranked, f64)> {
        self.within.iter().copied().min_by(|a, b| a.0.evaluations.total_cmp(&b.0.evaluations))
    }

    /// The model with the smallest difference.
    pub fn nearest(&self) -> Option<(&Ranked, f64)> {
        let size = |contrast: f64| self.quantity.reported(contrast).abs();
        self.compared.iter().copied().min_by(|a, b| size(a.1).total_cmp(&size(b.1)))
    }
}

impl Ranked {
    /// The largest difference in a quantity.
    pub fn largest(&self, against: Against, quantity: ComparedQuantity) -> Largest {
        match against {
            Against::Sum => self.from_sum[quantity as usize],
            Against::Reference => self.from_reference[quantity as usize],
        }
    }
}

impl Ranking {
    /// What the models are compared with: the sum, and the reference where one was run.
    pub fn against(&self) -> &'static [Against] {
        if self.sum_from_reference.iter().any(Option::is_some) {
            &[Against::Sum, Against::Reference]
        } else {
            &[Against::Sum]
        }
    }

    /// How the models stand in one quantity.
    pub fn standing(
        &self,
        against: Against,
        quantity: ComparedQuantity,
        accepted: &Accepted,
    ) -> Standing<'_> {
        let compared: Vec<(&Ranked, f64)> = self
            .models
            .iter()
            .filter_map(|ranked| Some((ranked, ranked.largest(against, quantity)?.0)))
            .collect();
        let is_within = |(_, contrast): &&(&Ranked, f64)| is_within(accepted, quantity, *contrast);
        Standing { quantity, within: compared.iter().filter(is_within).copied().collect(), compared }
    }
}

/// Whether a difference is within what is accepted.
pub fn is_within(accepted: &Accepted, quantity: ComparedQuantity, contrast: f64) -> bool {
    quantity.reported(contrast).abs() <= accepted.limit(quantity)
}

/// The ranking of each case of a surface; nothing where only one model was run, or no ranking is asked for.
pub fn rank(setup: Setup, surface: &Surface, cases: &[CaseResults]) -> Vec<Ranking> {
    if !(setup.has_both_models() && setup.is_ranked) {
        return Vec::new();
    }
    setup.progress.stage("other statistical models", cases.len() as f64);
    let mut all = StatisticalModel::all();
    let selected = setup.statistical.explicit(surface.nominal.as_ref());
    if !all.contains(&selected) {
        all.insert(0, selected);
    }
    let models = |model: &StatisticalModel| SurfaceModels::new(surface, model, setup.law_specs, false);
    let built: Vec<_> = all.into_iter().map(|model| (models(&model), model)).collect();
    let of_case = |(law, case): (&LawContact, &CaseResults)| {
        let ranking = of_case(&built, law, case);
        setup.progress.advance(1.0);
        ranking
    };
    setup.laws.iter().zip(cases).map(of_case).collect()
}

fn of_case(
    built: &[(Result<SurfaceModels, HeightsError>, StatisticalModel)],
    law: &LawContact,
    case: &CaseResults,
) -> Ranking {
    let at_load =
        case.comparison.pairs.iter().filter(|pair| pair.pairing == Pairing::Load && pair.is_valid());
    let valid: Vec<Pair> = at_load.copied().collect();
    let mut pairs = of_each_decade(ascending(&valid), |pair| pair.target, PER_DECADE);
    // The loads of the reference, too.
    let has_reference = |pair: &&Pair| case.reference_of(pair).is_some();
    pairs.extend(valid.iter().filter(has_reference).copied());
    let pairs = ascending(&pairs);
    let loads: Vec<f64> = pairs.iter().map(|pair| pair.target).collect();
    let mut ranking = Ranking { loads: loads.clone(), ..Ranking::default() };
    if loads.is_empty() {
        return ranking;
    }
    for (models, model) in built {
        let models = match models {
            Ok(models) => models,
            Err(error) => {
                ranking.inapplicable.push((model.clone(), error.to_string()));
                continue;
            }
        };
        let counter = Counter::default();
        let contact = CountedContact::new(&*law.contact, &counter);
        let responses = reached_at(&*models.statistical(&contact, &law.spec), &loads);
        let work = counter.work();
        let responses: Vec<Option<Response>> =
            responses.into_iter().map(|reached| reached.map(|reached| reached.response)).collect();
        ranking.models.push(Ranked {
            model: model.clone(),
            from_sum: ComparedQuantity::ALL.map(|quantity| from_sum(quantity, case, &pairs, &responses)),
            from_reference: ComparedQuantity::ALL
                .map(|quantity| from_reference(quantity, case.reference.as_ref(), &loads, &responses)),
            evaluations: (work.nodes + work.single_contacts) as f64 / loads.len() as f64,
        });
    }
    let sums: Vec<Option<Response>> = pairs.iter().map(|pair| Some(pair.deterministic)).collect();
    ranking.sum_from_reference = ComparedQuantity::ALL
        .map(|quantity| from_reference(quantity, case.reference.as_ref(), &loads, &sums));
    ranking
}

fn ascending(pairs: &[Pair]) -> Vec<Pair> {
    let mut pairs = pairs.to_vec();
    pairs.sort_by(|a, b| a.target.total_cmp(&b.target));
    pairs.dedup_by(|a, b| a.target == b.target);
    pairs
}

/// The largest of contrasts with their loads; `None` where one is missing.
fn largest(contrasts: impl Iterator<Item = Option<(f64, f64)>>) -> Largest {
    let all: Option<Vec<(f64, f64)>> = contrasts.collect();
    all?.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
}

fn from_sum(
    quantity: ComparedQuantity,
    case: &CaseResults,
    pairs: &[Pair],
    responses: &[Option<Response>],
) -> Largest {
    let is_compared = |load: f64| {
        let at = case.differences.iter().find(|at| at.load == load);
        at.is_some_and(|at| at.estimates[quantity as usize].is_some())
    };
    let compared = pairs.iter().zip(responses).filter(|(pair, _)| is_compared(pair.target));
    largest(compared.map(|(pair, response)| {
        let pair = Pair { statistical: (*response)?, ..*pair };
        Some((quantity.contrast(&pair)?, pair.target))
    }))
}

fn from_reference(
    quantity: ComparedQuantity,
    reference: Option<&ReferenceCurve>,
    loads: &[f64],
    responses: &[Option<Response>],
) -> Largest {
    let reference = reference?;
    let compared = loads
        .iter()
        .zip(responses)
        .filter_map(|(&load, response)| Some((load, response, reference.at_load(load)?)));
    largest(
        compared.map(|(load, response, point)| Some((point.contrast(quantity, response.as_ref()?)?, load))),
    )
}
