//! Fitted statistical models on asperities that they were not taken from: the other half of a surface, or its other realisations.

use super::models::{StatisticalModel, SurfaceModels};
use super::ranking::{BuiltModel, LargestErrors, Ranking, errors, ranked_pairs, responses};
use super::results::CaseResults;
use super::setup::{LawContact, Setup};
use crate::Response;
use crate::compare::{ByQuantity, Division, Pair};
use crate::numeric::{parallel, stream_seed};
use crate::surface::Surface;

/// Asperities that fitted models are tested on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeldOut {
    /// The other half of a map, or of a list with places, along its longer side; both ways.
    MapHalves,
    /// The other half of independent asperities at random, both ways.
    RandomHalves,
    /// So many other realisations of the surface.
    Realisations(usize),
}

impl HeldOut {
    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::MapHalves => "halves of the surface",
            Self::RandomHalves => "random halves",
            Self::Realisations(_) => "realisations",
        }
    }
}

/// Both halves of a surface.
pub(super) struct Halves {
    tested_on: HeldOut,
    surfaces: [Surface; 2],
}

/// The models on both halves of a surface.
pub(super) struct HalfModels<'a> {
    tested_on: HeldOut,
    /// For the sums.
    sums: [SurfaceModels<'a>; 2],
    /// Fitted models that apply to both halves.
    fitted: Vec<(StatisticalModel, [SurfaceModels<'a>; 2])>,
}

impl Halves {
    /// Of a map along its longer side, of other surfaces at random; `None` where a half has no asperities.
    pub(super) fn new(setup: Setup, surface: &Surface) -> Option<Self> {
        let (division, tested_on) = match &surface.halves {
            Some(halves) => (halves.clone(), HeldOut::MapHalves),
            None => {
                let seed = stream_seed(setup.seed, &format!("halves of {}", surface.name));
                (Division::random_halves(surface.set.count(), seed, setup.progress)?, HeldOut::RandomHalves)
            }
        };
        let half = |half: usize| {
            let surface = surface.without(&division, 1 - half)?;
            // Copied and ordered here, both at once: models side by side would each find it.
            surface.set.radii_above();
            Some(surface)
        };
        let surfaces = parallel::map(2, half);
        let surfaces: Vec<Surface> = surfaces.into_iter().collect::<Option<_>>()?;
        Some(Self { tested_on, surfaces: surfaces.try_into().ok()? })
    }

    /// The sums over both halves, and the fitted ones of `models` of each.
    pub(super) fn models(&self, setup: Setup, models: &[StatisticalModel]) -> Option<HalfModels<'_>> {
        let laws = setup.law_specs;
        let on_both = |model: &StatisticalModel, is_summed: bool| {
            let [first, second] = &self.surfaces;
            let on_half = |half| {
                let models = SurfaceModels::new(half, model, laws, is_summed).ok();
                setup.progress.advance(0.0);
                models
            };
            let (first, second) = rayon::join(|| on_half(first), || on_half(second));
            Some([first?, second?])
        };
        let fitted = models.iter().filter(|model| model.is_fitted());
        Some(HalfModels {
            tested_on: self.tested_on,
            sums: on_both(&StatisticalModel::default(), true)?,
            fitted: fitted.filter_map(|model| Some((model.clone(), on_both(model, false)?))).collect(),
        })
    }
}

impl HalfModels<'_> {
    /// Adds to the ranking of a case the larger error of the fitted models of each half on the other one: at the loads of the ranking
    /// that are admissible to the sums over both halves. Nothing where no load is.
    pub(super) fn hold_out(&self, ranking: &mut Ranking, law: &LawContact, case: &CaseResults) {
        let pairs = ranked_pairs(case);
        let loads: Vec<f64> = pairs.iter().map(|pair| pair.target).collect();
        let sums = self.sums.each_ref().map(|models| {
            let sum = models.deterministic(&*law.contact, &law.spec);
            let near: Vec<f64> = pairs.iter().map(|pair| pair.deterministic.separation_over_sigma).collect();
            sum.map_or_else(|| vec![None; loads.len()], |sum| responses(&sum.searched_near(&near), &loads))
        });
        let is_admissible = |sum: &Option<Response>| sum.is_some_and(|sum| sum.exceeded().is_none());
        let admissible: Vec<usize> =
            (0..loads.len()).filter(|&k| sums.iter().all(|sums| is_admissible(&sums[k]))).collect();
        if admissible.is_empty() {
            return;
        }
        let pairs = sums.map(|sums| -> Vec<Pair> {
            let pair = |&k: &usize| Some(Pair { deterministic: sums[k]?, ..pairs[k] });
            admissible.iter().filter_map(pair).collect()
        });
        let loads: Vec<f64> = admissible.iter().map(|&k| loads[k]).collect();
        let errors = |models: &SurfaceModels, pairs: &[Pair]| {
            let responses = responses(&*models.statistical(&*law.contact, &law.spec), &loads);
            // A reference of the whole map is none of a half.
            LargestErrors { from_reference: ByQuantity::default(), ..errors(case, pairs, &responses) }
        };
        ranking.tested_on = Some(self.tested_on);
        ranking.tested_loads = loads.first().zip(loads.last()).map(|(&low, &high)| [low, high]);
        let held_out = |(_, [a, b]): &(StatisticalModel, [SurfaceModels; 2])| {
            errors(a, &pairs[1]).larger(&errors(b, &pairs[0]))
        };
        let fitted = parallel::map(self.fitted.len(), |k| held_out(&self.fitted[k]));
        for ranked in &mut ranking.models {
            let place = self.fitted.iter().position(|(model, _)| *model == ranked.model);
            ranked.held_out = place.map(|place| fitted[place]);
        }
    }
}

/// Adds to the ranking of a case the largest error of the fitted models of the first realisation on all `others`, each at its own
/// admissible loads. Nothing where one of them has none.
pub(super) fn on_realisations(
    ranking: &mut Ranking,
    built: &[BuiltModel],
    law: &LawContact,
    others: &[CaseResults],
) {
    let pairs: Vec<Vec<Pair>> = others.iter().map(ranked_pairs).collect();
    if pairs.iter().any(Vec::is_empty) {
        return;
    }
    let mut loads: Vec<f64> = pairs.iter().flatten().map(|pair| pair.target).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    let largest = |models: &SurfaceModels| {
        let all = responses(&*models.statistical(&*law.contact, &law.spec), &loads);
        let at_load = |pair: &Pair| loads.iter().position(|load| *load == pair.target).and_then(|k| all[k]);
        let each = others.iter().zip(&pairs).map(|(case, pairs)| {
            let responses: Vec<Option<Response>> = pairs.iter().map(at_load).collect();
            errors(case, pairs, &responses)
        });
        each.reduce(|a, b| a.larger(&b))
    };
    ranking.tested_on = Some(HeldOut::Realisations(others.len()));
    ranking.tested_loads = loads.first().zip(loads.last()).map(|(&low, &high)| [low, high]);
    for ranked in ranking.models.iter_mut().filter(|ranked| ranked.model.is_fitted()) {
        let models = built.iter().find(|(_, model)| *model == ranked.model);
        ranked.held_out = models.and_then(|(models, _)| largest(models.as_ref().ok()?));
    }
}
