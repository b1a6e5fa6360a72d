//! How far each statistical model of a surface is from the sum and from the reference, and what it costs. Models that are fitted to the
//! asperities are tested on others.

use super::held_out::{self, Halves, HeldOut};
use super::results::{CaseResults, CaseStudy};
use super::setup::{LawContact, Setup};
use crate::compare::{
    Accepted, ByQuantity, ComparedQuantity, Pair, ReferenceCurve, ReferencePoint, Repeats, of_each_decade,
};
use crate::distribution::HeightsError;
use crate::numeric::parallel;
use crate::progress::Progress;
use crate::work::{CountedContact, Counter};
use crate::{INTERACTION, Model, Response, named_enum, reached_at};

use super::models::{StatisticalModel, SurfaceModels};
use crate::surface::Surface;

/// Loads per decade at which models are compared.
const PER_DECADE: f64 = 3.0;

named_enum! {
    /// What a model is compared with.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Against {
        /// The sum over the asperities.
        Sum = "deterministic",
        /// The boundary element reference.
        Reference = "reference",
    }
}

/// The largest contrast of a model, with its load, Pa.
pub type Largest = Option<(f64, f64)>;

/// The largest differences of a model in each of [`ComparedQuantity::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LargestErrors {
    /// From the sum.
    pub from_sum: ByQuantity<Largest>,
    /// From the reference; `None` where there is none.
    pub from_reference: ByQuantity<Largest>,
}

/// A model on one surface under one law.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The model.
    pub model: StatisticalModel,
    /// On the asperities that it was taken from.
    pub in_sample: LargestErrors,
    /// On asperities that it was not taken from: of a model that [is fitted](StatisticalModel::is_fitted), where there are such.
    pub held_out: Option<LargestErrors>,
    /// Contacts evaluated at one separation.
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
    pub sum_from_reference: ByQuantity<Largest>,
    /// The loads at which the models were compared, Pa.
    pub loads: Vec<f64>,
    /// What fitted models are tested on; `None` where there are no other asperities, or no load is admissible on them.
    pub tested_on: Option<HeldOut>,
    /// The lowest and the highest load at which they are, Pa.
    pub tested_loads: Option<[f64; 2]>,
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
    /// Fitted models that are within what is accepted on the asperities that they were taken from only.
    pub within_in_sample: Vec<&'a Ranked>,
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

impl LargestErrors {
    /// The largest difference in a quantity.
    pub fn largest(&self, against: Against, quantity: ComparedQuantity) -> Largest {
        match against {
            Against::Sum => self.from_sum[quantity as usize],
            Against::Reference => self.from_reference[quantity as usize],
        }
    }

    /// The larger ones of two; `None` where one of them is.
    pub(super) fn larger(&self, other: &Self) -> Self {
        let larger = |a: &ByQuantity<Largest>, b: &ByQuantity<Largest>| {
            ComparedQuantity::ALL
                .map(|quantity| largest(quantity, [a, b].map(|all| all[quantity as usize]).into_iter()))
        };
        Self {
            from_sum: larger(&self.from_sum, &other.from_sum),
            from_reference: larger(&self.from_reference, &other.from_reference),
        }
    }
}

impl Ranked {
    /// The difference by which the model is ranked. Of a fitted model it is the larger one of those in sample and held out, and `None`
    /// without the latter.
    pub fn ranked_by(&self, against: Against, quantity: ComparedQuantity) -> Largest {
        if !self.model.is_fitted() {
            return self.in_sample.largest(against, quantity);
        }
        self.in_sample.larger(self.held_out.as_ref()?).largest(against, quantity)
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
        let is_within = |contrast: f64| is_within(accepted, quantity, contrast);
        let compared: Vec<(&Ranked, f64)> = self
            .models
            .iter()
            .filter_map(|ranked| Some((ranked, ranked.ranked_by(against, quantity)?.0)))
            .collect();
        let within: Vec<_> = compared.iter().copied().filter(|(_, contrast)| is_within(*contrast)).collect();
        let is_carried = |ranked: &Ranked| within.iter().any(|(other, _)| other.model == ranked.model);
        let is_within_in_sample = |ranked: &&Ranked| {
            let in_sample = ranked.in_sample.largest(against, quantity);
            !is_carried(ranked) && in_sample.is_some_and(|(contrast, _)| is_within(contrast))
        };
        let within_in_sample = self.models.iter().filter(is_within_in_sample).collect();
        Standing { quantity, compared, within, within_in_sample }
    }
}

/// Whether a difference is within what is accepted.
pub fn is_within(accepted: &Accepted, quantity: ComparedQuantity, contrast: f64) -> bool {
    quantity.reported(contrast).abs() <= accepted.limit(quantity)
}

/// The ranking of each case of a surface, which is the first of its realisations; nothing where only one model was run, or no ranking is
/// asked for.
pub fn rank(setup: Setup, surface: &Surface, cases: &[CaseStudy]) -> Vec<Ranking> {
    if !(setup.has_both_models() && setup.is_ranked) {
        return Vec::new();
    }
    let mut all = StatisticalModel::all();
    let selected = setup.statistical.explicit(surface.nominal.as_ref());
    if !all.contains(&selected) {
        all.insert(0, selected);
    }
    setup.progress.stage("other statistical models", (all.len() + cases.len()) as f64);
    // Shifts of a pair are no other surfaces.
    let is_one = surface.realisations == 1 || surface.repeats == Repeats::Shifts;
    let build = |model: &StatisticalModel| {
        let built = SurfaceModels::new(surface, model, setup.law_specs, false);
        setup.progress.advance(1.0);
        (built, model.clone())
    };
    // Random halves are drawn on one thread.
    let (halves, built) = rayon::join(
        || if is_one { Halves::new(setup, surface) } else { None },
        || all.iter().map(build).collect::<Vec<_>>(),
    );
    let halves = halves.as_ref().and_then(|halves| halves.models(setup, &all));
    // On all threads: models side by side would each find them.
    surface.set.radii_above();
    let of_case = |(law, case): (&LawContact, &CaseStudy)| {
        let mut ranking = in_sample(&built, law, case.first(), setup.progress);
        if let [_, others @ ..] = &case.realisations[..]
            && !others.is_empty()
            && !is_one
        {
            held_out::on_realisations(&mut ranking, &built, law, others);
        } else if let Some(halves) = &halves {
            halves.hold_out(&mut ranking, law, case.first());
        }
        setup.progress.advance(1.0);
        ranking
    };
    setup.laws.iter().zip(cases).map(of_case).collect()
}

/// A model with what it is on a surface, where it applies.
pub(super) type BuiltModel<'a> = (Result<SurfaceModels<'a>, HeightsError>, StatisticalModel);

fn in_sample(built: &[BuiltModel], law: &LawContact, case: &CaseResults, progress: &dyn Progress) -> Ranking {
    let pairs = ranked_pairs(case);
    let loads: Vec<f64> = pairs.iter().map(|pair| pair.target).collect();
    let mut ranking = Ranking { loads: loads.clone(), ..Ranking::default() };
    if loads.is_empty() {
        return ranking;
    }
    let ranked = |(models, model): &BuiltModel| {
        progress.advance(0.0);
        let models = models.as_ref().map_err(|error| (model.clone(), error.to_string()))?;
        let counter = Counter::default();
        let contact = CountedContact::new(&*law.contact, &counter).watched_by(progress);
        let statistical = models.statistical(&contact, &law.spec);
        let responses = responses(&*statistical, &loads);
        Ok(Ranked {
            model: model.clone(),
            in_sample: errors(case, &pairs, &responses),
            held_out: None,
            evaluations: evaluations(&*statistical, &responses, &counter),
        })
    };
    for one in parallel::map(built.len(), |k| ranked(&built[k])) {
        match one {
            Ok(ranked) => ranking.models.push(ranked),
            Err(inapplicable) => ranking.inapplicable.push(inapplicable),
        }
    }
    let sums: Vec<Option<Response>> = pairs.iter().map(|pair| Some(pair.deterministic)).collect();
    ranking.sum_from_reference = ComparedQuantity::ALL
        .map(|quantity| from_reference(quantity, case.reference.as_ref(), &pairs, &sums));
    ranking
}

/// Contacts that a model whose contacts are counted evaluates at one separation, the mean over those of its responses; 0 without one. A
/// search for them ends a step sooner or later by rounding, and would make this a number of the machine.
fn evaluations(model: &dyn Model, responses: &[Option<Response>], counter: &Counter) -> f64 {
    let separations: Vec<f64> = responses.iter().flatten().map(|one| one.separation_over_sigma).collect();
    let count = || counter.work().nodes + counter.work().single_contacts;
    let before = count();
    model.respond_all(&separations);
    (count() - before) as f64 / separations.len().max(1) as f64
}

/// The pairs of a case at which models are compared: at admissible loads three per decade, and those of the reference.
pub(super) fn ranked_pairs(case: &CaseResults) -> Vec<Pair> {
    let at_load = case.comparison.pairs_at_load().filter(|pair| pair.is_admissible());
    let admissible: Vec<Pair> = at_load.copied().collect();
    let mut pairs = of_each_decade(ascending(&admissible), |pair| pair.target, PER_DECADE);
    let has_reference = |pair: &&Pair| case.reference_of(pair).is_some();
    pairs.extend(admissible.iter().filter(has_reference).copied());
    ascending(&pairs)
}

fn ascending(pairs: &[Pair]) -> Vec<Pair> {
    let mut pairs = pairs.to_vec();
    pairs.sort_by(|a, b| a.target.total_cmp(&b.target));
    pairs.dedup_by(|a, b| a.target == b.target);
    pairs
}

/// A model at loads (Pa); `None` where it does not reach one.
pub(super) fn responses(model: &dyn Model, loads: &[f64]) -> Vec<Option<Response>> {
    reached_at(model, loads).into_iter().map(|reached| reached.map(|reached| reached.response)).collect()
}

/// The largest differences of the `responses` of a model from the sum of `pairs` of a case, and from its reference.
pub(super) fn errors(case: &CaseResults, pairs: &[Pair], responses: &[Option<Response>]) -> LargestErrors {
    LargestErrors {
        from_sum: ComparedQuantity::ALL.map(|quantity| from_sum(quantity, case, pairs, responses)),
        from_reference: ComparedQuantity::ALL
            .map(|quantity| from_reference(quantity, case.reference.as_ref(), pairs, responses)),
    }
}

/// The contrast, of those with their loads, that is largest as it is reported: what is accepted is a relative difference, not a logarithm.
/// `None` where one is missing.
fn largest(quantity: ComparedQuantity, contrasts: impl Iterator<Item = Option<(f64, f64)>>) -> Largest {
    let size = |at: &(f64, f64)| quantity.reported(at.0).abs();
    let all: Option<Vec<(f64, f64)>> = contrasts.collect();
    all?.into_iter().max_by(|a, b| size(a).total_cmp(&size(b)))
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
    largest(
        quantity,
        compared.map(|(pair, response)| {
            let pair = Pair { statistical: (*response)?, ..*pair };
            Some((quantity.contrast(&pair)?, pair.target))
        }),
    )
}

fn from_reference(
    quantity: ComparedQuantity,
    reference: Option<&ReferenceCurve>,
    pairs: &[Pair],
    responses: &[Option<Response>],
) -> Largest {
    let reference = reference?;
    let admissible = |load: f64| reference.at_load(load).filter(|point| point.area_ratio <= INTERACTION);
    let compared = pairs
        .iter()
        .zip(responses)
        .filter_map(|(pair, response)| Some((pair.target, response, admissible(pair.target)?)));
    let contrast = |(load, response, point): (f64, &Option<Response>, &ReferencePoint)| {
        Some((point.contrast(quantity, response.as_ref()?)?, load))
    };
    largest(quantity, compared.map(contrast))
}
