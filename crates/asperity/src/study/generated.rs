//! Both models on surfaces of a process that was fitted to a small map: what the scatter of other samples would be.

use rayon::prelude::*;

use crate::HeightMap;
use crate::compare::{Generated, NotModelled, Scatter, State, pairs_at};
use crate::numeric::stream_seed;
use crate::progress::{Progress, Share};
use crate::surface::{AnalysisDepth, Preparation, SummitSearch, Surface};
use crate::topography::generate::{FittedProcess, roughness_scatter};

use super::law::LawContact;
use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::Setup;

/// Surfaces that are generated for a small map: Student's quantile is then 2.04 for 1.96.
pub const GENERATED_SURFACES: usize = 32;

/// Points of a map above which surfaces are generated one after the other, so that memory holds one for all threads.
const LARGE: usize = 1 << 22;

/// How many times the scatter of the roughness over a map may exceed that of generated surfaces. From the first on, which a tenth at most of
/// stationary surfaces reach, intervals are widened by it, and cover the truth where the amplitude scatters by up to 30 %
/// (`coverage-of-small-maps`). Beyond the second none is claimed.
const PATCHY: [f64; 2] = [2.0, 4.0];

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
    roughness_scatter: f64,
}

fn on_surfaces(
    setup: Setup,
    surface: &Surface,
    process: &FittedProcess,
    cases: &[CaseResults],
) -> Result<Vec<Generated>, NotModelled> {
    setup.progress.stage("generated surfaces", GENERATED_SURFACES as f64);
    let within = &Share { progress: setup.progress, units: 0.0 };
    let sample = |number: usize| {
        within.advance(0.0);
        let seed = stream_seed(setup.seed, &format!("generated surface {number} of {}", surface.name));
        let sample = of_map(
            Setup { progress: within, ..setup },
            surface,
            &process.watched_surface(seed, within),
            cases,
        );
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
    let scatters: Vec<f64> = samples.iter().map(|sample| sample.roughness_scatter).collect();
    let widening = process.widening() * patchiness(process.own_scatter(), &scatters)?;
    let of_case = |case: usize| Generated {
        states: samples.iter().map(|sample| sample.states[case].clone()).collect(),
        widening,
    };
    Ok((0..cases.len()).map(of_case).collect())
}

/// Both models on a map of the process, treated as the measured one; `None` where they cannot be run on it.
fn of_map(setup: Setup, surface: &Surface, map: &HeightMap, cases: &[CaseResults]) -> Option<Sample> {
    let facts = surface.map.as_ref()?;
    let map = facts.level.apply(map).ok()?;
    let search = SummitSearch {
        as_ellipses: surface.set.ellipses().is_some(),
        depth: AnalysisDepth::Asperities,
        divides: false,
        progress: setup.progress,
        ..SummitSearch::new(Preparation::none(facts.neighbours))
    };
    let found = search.surface(&surface.name, &map).ok()?;
    let models = SurfaceModels::new(&found, setup.statistical, setup.law_specs, true).ok()?;
    setup.progress.advance(0.0);
    Some(Sample { states: states(setup, &models, cases)?, roughness_scatter: roughness_scatter(&map) })
}

/// By how much the intervals are widened because the roughness of a map varies from place to place, from its scatter and those of generated
/// surfaces.
fn patchiness(own: f64, generated: &[f64]) -> Result<f64, NotModelled> {
    let ratio = own / Scatter::new(generated).mean;
    if ratio <= PATCHY[1] { Ok((ratio / PATCHY[0]).max(1.0)) } else { Err(NotModelled::Patchy) }
}

/// Both models at the loads of the pairs of each case; `None` where no sum is asked for.
fn states(setup: Setup, models: &SurfaceModels, cases: &[CaseResults]) -> Option<CaseStates> {
    let of_case = |(law, case): (&LawContact, &CaseResults)| {
        let loads: Vec<f64> = case.comparison.pairs_at_load().map(|pair| pair.target).collect();
        let statistical = models.statistical(&*law.contact, &law.spec);
        let deterministic = models.deterministic(&*law.contact, &law.spec)?;
        let pairs = pairs_at(&*statistical, &deterministic, &loads);
        setup.progress.advance(0.0);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roughness_that_varies_widens_the_intervals_until_none_is_claimed() {
        let of = |own: f64| patchiness(own, &[0.1, 0.12, 0.08]);
        assert_eq!(of(0.15), Ok(1.0));
        assert!((of(0.3).unwrap() - 1.5).abs() < 1e-12);
        assert_eq!(of(0.41), Err(NotModelled::Patchy));
        assert_eq!(of(f64::NAN), Err(NotModelled::Patchy));
    }
}
