//! Both models on a surface with groups of its asperities left out, from which sampling errors follow.

use super::generated::{generated, on_halves};
use super::law::LawContact;
use crate::Total;
use crate::compare::{CaseSampling, Division, LeftOut, OneStep, Pair, State};
use crate::numeric::stream_seed;
use crate::work::{CountedContact, Counter};

use super::models::SurfaceModels;
use super::results::CaseResults;
use super::setup::Setup;
use super::statistical::StatisticalModel;
use crate::surface::{Independence, Surface};

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
