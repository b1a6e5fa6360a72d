//! Both models on a surface with groups of its asperities left out, from which sampling errors follow.

use asperity::compare::{CaseSampling, Division, Kind, LeftOut, Pair, Pairing, pairs_at};
use asperity_framework::contact::LawPlan;
use asperity_framework::digest::stream_seed;

use super::answers::CaseResults;
use super::models::SurfaceModels;
use super::plan::ComparePlan;
use crate::surface::{Independence, Surface};

/// Loads (Pa) of the pairs at equal load of each case.
type Loads = Vec<Vec<f64>>;

/// The sampling uncertainty of each case on a surface that has been compared; nothing where only one model was run.
pub(super) fn sampling(
    plan: &ComparePlan,
    surface: &Surface,
    cases: &[CaseResults],
    seed: u64,
) -> Vec<CaseSampling> {
    if ![Kind::Statistical, Kind::Deterministic].iter().all(|kind| plan.models.contains(kind)) {
        return Vec::new();
    }
    let at_load = |pair: &&Pair| pair.pairing == Pairing::Load;
    let loads_of =
        |case: &CaseResults| case.comparison.pairs.iter().filter(at_load).map(|pair| pair.target).collect();
    let loads: Loads = cases.iter().map(loads_of).collect();
    let seed = stream_seed(seed, &format!("groups of {}", surface.name));
    let draws = Division::independent(surface.set.count(), seed);
    let mut independent = draws.map(|draws| left_out(plan, surface, &draws, &loads)).unwrap_or_default();
    let (mut groups, area_needed) = match &surface.independence {
        Independence::Asperities => (independent.clone(), None),
        Independence::Blocks(blocks) => (left_out(plan, surface, &blocks.division, &loads), None),
        Independence::TooSmall(error) => (Vec::new(), Some(error.area_needed)),
        Independence::Realisations => (Vec::new(), None),
    };
    // From the last case on.
    let of_case = |_| CaseSampling {
        groups: groups.pop(),
        independent: independent.pop(),
        area: surface.set.nominal_area(),
        area_needed,
    };
    let mut sampling: Vec<CaseSampling> = cases.iter().map(of_case).collect();
    sampling.reverse();
    sampling
}

/// Each case at its loads with each group of `division` left out.
fn left_out(plan: &ComparePlan, surface: &Surface, division: &Division, loads: &Loads) -> Vec<LeftOut> {
    let without = |group: usize| -> Vec<Vec<Option<Pair>>> {
        let Some(rest) = surface.without(division, group) else {
            return loads.iter().map(|loads| vec![None; loads.len()]).collect();
        };
        let population = rest.population(plan.heights.as_ref(), plan.mean_radius);
        let models = SurfaceModels::new(&rest, population, &plan.law_specs, true);
        let case = |(law, loads): (&LawPlan, &Vec<f64>)| {
            let statistical = models.statistical(&*law.contact, &law.spec);
            match models.deterministic(&*law.contact, &law.spec) {
                Some(deterministic) => pairs_at(&statistical, &deterministic, loads),
                None => vec![None; loads.len()],
            }
        };
        plan.laws.iter().zip(loads).map(case).collect()
    };
    let mut cases = vec![LeftOut { pairs: Vec::new(), shares: division.shares().to_vec() }; loads.len()];
    for pairs in division.for_each_group(without) {
        cases.iter_mut().zip(pairs).for_each(|(case, pairs)| case.pairs.push(pairs));
    }
    cases
}
