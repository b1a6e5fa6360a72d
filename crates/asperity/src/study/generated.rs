//! Both models on surfaces of a process that was fitted to a small map: what the scatter of other samples would be.

use rayon::prelude::*;

use crate::compare::{Generated, NotModelled, Scatter, State, pairs_at};
use crate::numeric::stream_seed;
use crate::surface::{AnalysisDepth, Preparation, SummitSearch, Surface};
use crate::topography::generate::{FittedProcess, roughness_scatter};
use crate::{HeightMap, Statistics};

use super::law::LawContact;
use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::Setup;

/// Surfaces that are generated for a small map: Student's quantile is then 2.04 for 1.96.
pub const GENERATED_SURFACES: usize = 32;

/// Points of a map above which surfaces are generated one after the other, so that memory holds one for all threads.
const LARGE: usize = 1 << 22;

/// The largest differences between a map and the mean of generated surfaces: of ln(mean radius), and of the correlation of height and radius. They lie
/// above what stationary Gaussian and skewed processes give, and below what plateaus do (`coverage-of-small-maps`: plateaus get no interval).
const ALIKE: [f64; 2] = [0.2, 0.3];

/// Standard deviations by which the scatter of the roughness over a map may exceed that of generated surfaces.
const PATCHY: f64 = 3.0;

/// Both models of each case on generated surfaces at the loads of its pairs; `None` for a surface that is no small map.
pub fn generated(
    setup: Setup,
    surface: &Surface,
    cases: &[CaseResults],
) -> Option<Result<Vec<Generated>, NotModelled>> {
    let small = surface.small.as_ref().filter(|_| setup.generates)?;
    Some(match &small.process {
        Ok(process) => on_surfaces(setup, surface, process, cases),
        Err(reason) => Err(NotModelled::Unfitted(*reason)),
    })
}

/// The statistical and the deterministic model, case by case, load by load; `None` where one has no contact.
type CaseStates = Vec<Vec<Option<[State; 2]>>>;

/// One generated surface.
struct Sample {
    states: CaseStates,
    statistics: Statistics,
    roughness_scatter: f64,
}

fn on_surfaces(
    setup: Setup,
    surface: &Surface,
    process: &FittedProcess,
    cases: &[CaseResults],
) -> Result<Vec<Generated>, NotModelled> {
    setup.progress.stage("generated surfaces", GENERATED_SURFACES as f64);
    let sample = |number: usize| {
        let seed = stream_seed(setup.seed, &format!("generated surface {number} of {}", surface.name));
        let sample = of_map(setup, surface, &process.surface(seed), cases);
        setup.progress.advance(1.0);
        sample.ok_or(NotModelled::Failed)
    };
    let points = process.points()[0] * process.points()[1];
    let samples: Result<Vec<Sample>, NotModelled> = if points > LARGE {
        (0..GENERATED_SURFACES).map(sample).collect()
    } else {
        (0..GENERATED_SURFACES).into_par_iter().map(sample).collect()
    };
    let samples = samples?;
    check(&surface.statistics, process, &samples)?;
    let of_case = |case: usize| Generated {
        states: samples.iter().map(|sample| sample.states[case].clone()).collect(),
        widening: process.widening(),
    };
    Ok((0..cases.len()).map(of_case).collect())
}

/// Both models on a map of the process, treated as the measured one; `None` where they cannot be run on it.
fn of_map(setup: Setup, surface: &Surface, map: &HeightMap, cases: &[CaseResults]) -> Option<Sample> {
    let facts = surface.map.as_ref()?;
    let preparation = Preparation { level: facts.level, ..Preparation::none(facts.neighbours) };
    let search = SummitSearch {
        as_ellipses: surface.set.ellipses().is_some(),
        depth: AnalysisDepth::Asperities,
        divides: false,
        ..SummitSearch::new(preparation)
    };
    let found = search.surface(&surface.name, map).ok()?;
    let models = SurfaceModels::new(&found, setup.statistical, setup.law_specs, true).ok()?;
    Some(Sample {
        states: states(setup, &models, cases)?,
        roughness_scatter: roughness_scatter(map),
        statistics: found.statistics,
    })
}

/// Whether a map is one that its process could have given.
fn check(own: &Statistics, process: &FittedProcess, samples: &[Sample]) -> Result<(), NotModelled> {
    let over = |of: &dyn Fn(&Sample) -> f64| Scatter::new(&samples.iter().map(of).collect::<Vec<_>>());
    let scatter = over(&|sample| sample.roughness_scatter);
    if process.own_scatter() > scatter.mean + PATCHY * scatter.deviation {
        return Err(NotModelled::Patchy);
    }
    let log_radius = over(&|sample| sample.statistics.mean_radius.ln()).mean;
    let correlation = |statistics: &Statistics| statistics.height_radius_correlation.unwrap_or_default();
    let correlated = over(&|sample| correlation(&sample.statistics)).mean;
    let gaps = [own.mean_radius.ln() - log_radius, correlation(own) - correlated];
    let is_alike = gaps.iter().zip(ALIKE).all(|(gap, largest)| gap.abs() <= largest);
    if is_alike { Ok(()) } else { Err(NotModelled::Unlike) }
}

/// Both models at the loads of the pairs of each case; `None` where no sum is asked for.
fn states(setup: Setup, models: &SurfaceModels, cases: &[CaseResults]) -> Option<CaseStates> {
    let of_case = |(law, case): (&LawContact, &CaseResults)| {
        let loads: Vec<f64> = case.comparison.pairs_at_load().map(|pair| pair.target).collect();
        let statistical = models.statistical(&*law.contact, &law.spec);
        let deterministic = models.deterministic(&*law.contact, &law.spec)?;
        let pairs = pairs_at(&*statistical, &deterministic, &loads);
        Some(pairs.into_iter().map(|pair| pair?.states()).collect())
    };
    setup.laws.iter().zip(cases).map(of_case).collect()
}

/// For each case both models on the halves of a small map (left, right, bottom, top), load by load.
pub fn on_halves(
    setup: Setup,
    surface: &Surface,
    models: &SurfaceModels,
    cases: &[CaseResults],
) -> Vec<Vec<[Option<[State; 2]>; 4]>> {
    let Some(small) = &surface.small else { return vec![Vec::new(); cases.len()] };
    let of_half = |half: usize| {
        let part = surface.without(&small.halves[half / 2], 1 - half % 2)?;
        states(setup, &models.of_part(&part, setup.law_specs, true).ok()?, cases)
    };
    let halves = [0, 1, 2, 3].map(of_half);
    let of_case = |(case, results): (usize, &CaseResults)| {
        let loads = results.comparison.pairs_at_load().count();
        let at_load = |load: usize| halves.each_ref().map(|half| half.as_ref()?[case][load]);
        (0..loads).map(at_load).collect()
    };
    cases.iter().enumerate().map(of_case).collect()
}
