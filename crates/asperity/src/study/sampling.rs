//! Both models on a surface with groups of its asperities left out, or on surfaces of a process that was fitted to a small map and on its
//! halves, from which sampling errors follow.

use rayon::prelude::*;

use super::models::{StatisticalModel, SurfaceModels};
use super::results::CaseResults;
use super::setup::{LawContact, Setup};
use crate::compare::{
    CaseSampling, Division, Generated, LeftOut, NotModelled, OneStep, Pair, Scatter, State, pairs_at,
};
use crate::numeric::stream_seed;
use crate::progress::{Progress, Share};
use crate::surface::{AnalysisDepth, Independence, Preparation, SummitSearch, Surface};
use crate::topography::generate::{FittedProcess, roughness_scatter};
use crate::work::{CountedContact, Counter};
use crate::{HeightMap, Total};

/// The sampling uncertainty of each case on a surface that has been compared; nothing where only one model was run.
pub fn sampling(
    setup: Setup,
    surface: &Surface,
    models: &SurfaceModels,
    cases: &[CaseResults],
) -> Vec<CaseSampling> {
    if !setup.has_both_models() {
        return Vec::new();
    }
    // Its counts are of no use; it shows that the sums go on.
    let counter = Counter::default();
    let step = |(law, case): (&LawContact, &CaseResults)| {
        let contact = &CountedContact::new(&*law.contact, &counter).watched_by(setup.progress);
        let pairs: Vec<Pair> = case.comparison.pairs_at_load().copied().collect();
        let statistical = models.statistical(contact, &law.spec);
        let deterministic = models.deterministic(contact, &law.spec)?;
        Some(OneStep::new(pairs, &*statistical, &deterministic, surface.set.nominal_area()))
    };
    let seed = stream_seed(setup.seed, &format!("groups of {}", surface.name));
    // Random numbers are drawn one after the other, on one thread.
    let (draws, steps) = rayon::join(
        || Division::independent(surface.set.count(), seed, setup.progress),
        || setup.laws.iter().zip(cases).filter_map(step).collect::<Vec<_>>(),
    );
    let left_out = |division: &Division| left_out(setup, (surface, models), division, &steps);
    let independent = draws.as_ref().map(left_out);
    let (groups, area_needed) = match &surface.independence {
        Independence::Asperities => (independent.clone(), None),
        Independence::Blocks(blocks) => (Some(left_out(&blocks.division)), None),
        Independence::TooSmall(error) => (None, Some(error.area_needed)),
        Independence::Unstated | Independence::Realisations => (None, None),
    };
    let generated = generated(setup, surface, cases);
    // Where there is an interval, nothing rests on the halves.
    let halves = match &generated {
        Some(Err(_)) => on_halves(setup, surface, models, cases),
        _ => vec![Vec::new(); cases.len()],
    };
    let of = |left_out: &Option<Vec<LeftOut>>, case: usize| left_out.as_ref().map(|all| all[case].clone());
    let of_case = |case| CaseSampling {
        groups: of(&groups, case),
        independent: of(&independent, case),
        area: surface.set.nominal_area(),
        area_needed,
        generated: generated
            .as_ref()
            .map(|all| all.as_ref().map(|all| all[case].clone()).map_err(|reason| *reason)),
        halves: halves[case].clone(),
    };
    (0..steps.len()).map(of_case).collect()
}

/// Each case with each group of `division` left out.
fn left_out(
    setup: Setup,
    (surface, models): (&Surface, &SurfaceModels),
    division: &Division,
    steps: &[OneStep],
) -> Vec<LeftOut> {
    let shares = division.shares();
    setup.progress.stage("sampling errors", shares.len() as f64);
    let without = |group: usize| {
        let goes_on = || setup.progress.advance(0.0);
        goes_on();
        let [rest, part] = surface.divided(division, group);
        goes_on();
        let of_rest =
            rest.as_ref().and_then(|rest| Some((rest, models.of_part(rest, setup.law_specs, false).ok()?)));
        let Some((rest, of_rest)) = of_rest else {
            let none = |step: &OneStep| vec![None; step.deterministic_separations().len()];
            return (None, steps.iter().map(none).collect());
        };
        goes_on();
        // The sum over a group needs no statistical model.
        let of_part = part.as_ref().and_then(|part| {
            SurfaceModels::new(part, &StatisticalModel::default(), setup.law_specs, true).ok()
        });
        goes_on();
        let case = |(law, step): (&LawContact, &OneStep)| {
            let counter = Counter::default();
            let contact = &CountedContact::new(&*law.contact, &counter).watched_by(setup.progress);
            let statistical = of_rest.statistical(contact, &law.spec);
            let responses = statistical.respond_all(&step.statistical_separations());
            let separations = step.deterministic_separations();
            let sum = of_part.as_ref().and_then(|models| models.deterministic(contact, &law.spec));
            // A block without asperities adds nothing.
            let totals =
                sum.map_or_else(|| vec![Total::default(); separations.len()], |sum| sum.totals(separations));
            step.without(&responses, &totals, shares[group], rest.plane)
        };
        let all: Vec<Vec<Option<[State; 2]>>> = setup.laws.iter().zip(steps).map(case).collect();
        setup.progress.advance(1.0);
        (Some(rest.plane), all)
    };
    let mut cases = vec![LeftOut { shares: shares.to_vec(), ..LeftOut::default() }; steps.len()];
    for (plane, states) in division.for_each_group(without) {
        for (case, states) in cases.iter_mut().zip(states) {
            case.states.push(states);
            case.planes.push(plane);
        }
    }
    cases
}

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
        let sample =
            of_map(Setup { progress: within, ..setup }, surface, &process.surface(seed, within), cases);
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
