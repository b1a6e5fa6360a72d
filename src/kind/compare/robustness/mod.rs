//! Robustness: whether the verdicts on a measured map survive other treatments of it.

mod dependence;
mod treatment;

pub use dependence::Dependence;
pub use treatment::{Choice, Treatment};

use asperity::compare::{Controls, Difference, Kind, Tolerances};
use asperity::work::Counter;
use asperity_framework::RunContext;
use asperity_framework::metadata::Timing;
use asperity_framework::progress::Silent;

use super::answers::CaseResults;
use super::plan::{ComparePlan, Setup};
use super::run::{differ, models_of, run_surface};
use super::sampling::sampling;
use super::statistical::StatisticalModel;
use crate::surface::{Surface, SurfaceFactory};

/// The verdicts under other treatments of a map.
#[derive(Debug)]
pub struct Robustness {
    /// Nesting index of the map's own S filter, m.
    pub own_cut_off: Option<f64>,
    /// The other treatments.
    pub treated: Vec<Treated>,
    /// The verdicts that depend on a choice, case by case.
    pub dependences: Vec<Vec<Dependence>>,
}

/// What one treatment gives.
#[derive(Debug)]
pub struct Treated {
    /// The treatment.
    pub treatment: Treatment,
    /// The differences between the models in each case, at loads of the map's own verdicts; empty where the treated map has no
    /// asperities or a model does not reach a load.
    pub cases: Vec<Vec<Difference>>,
}

impl Treated {
    /// The differences in case `index`.
    pub fn differences(&self, index: usize) -> &[Difference] {
        self.cases.get(index).map_or(&[], Vec::as_slice)
    }
}

/// The most loads of a case at which verdicts are computed again.
const MOST_LOADS: usize = 9;

/// Computes the verdicts on a surface, which gave `cases`, again; `None` unless it is a measured map and both models were run
/// and compared at a valid load.
pub(super) fn robustness(
    context: &RunContext,
    plan: &ComparePlan,
    factory: &SurfaceFactory,
    surface: &Surface,
    cases: &[CaseResults],
    counter: &Counter,
) -> Option<Robustness> {
    let own = factory.preparation().filter(|_| plan.is_robustness_examined)?;
    let both = [Kind::Statistical, Kind::Deterministic].iter().all(|kind| plan.models.contains(kind));
    let mut loads: Vec<f64> = cases.iter().flat_map(|case| some_loads(&case.differences)).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    if loads.is_empty() || !both {
        return None;
    }
    let map = surface.map.as_ref()?;
    let controls = Controls {
        separations: Vec::new(),
        pressures: loads,
        forces: Vec::new(),
        tolerances: Tolerances::default(),
    };
    let treatments = Treatment::all(&own, &plan.statistical, map);
    context.progress.stage("robustness", treatments.len() as f64);
    let treated = treatments.into_iter().map(|treatment| {
        let statistical = match treatment {
            Treatment::MeanRadius(mean_radius) => {
                &StatisticalModel { mean_radius, ..plan.statistical.clone() }
            }
            _ => &plan.statistical,
        };
        let setup = Setup { controls: &controls, statistical, progress: &Silent, ..plan.setup(context) };
        let treat = || {
            // The mean radius changes nothing on the surface.
            let prepared = match treatment {
                Treatment::MeanRadius(_) => None,
                _ => Some(factory.prepared(treatment.preparation(own), map.correlation)?),
            };
            let surface = prepared.as_ref().unwrap_or(surface);
            let models = models_of(setup, surface, &mut Timing::default()).ok()?;
            let answered = run_surface(setup, surface, &models, counter, &mut Timing::default());
            let mut cases = answered.ok()?.cases;
            let samplings = sampling(setup, surface, &models, &cases);
            differ(&mut cases, &samplings, setup.laws, &models);
            Some(cases.into_iter().map(|case| case.differences).collect())
        };
        let cases = treat().unwrap_or_default();
        context.progress.advance(1.0);
        Treated { treatment, cases }
    });
    let treated: Vec<Treated> = treated.collect();
    let accepted = plan.accept.on(surface.plane.sigma);
    let of_case =
        |(index, case): (usize, &CaseResults)| Dependence::all(&case.differences, &treated, index, &accepted);
    let dependences = cases.iter().enumerate().map(of_case).collect();
    Some(Robustness { own_cut_off: own.filter.and_then(|filter| filter.s()), treated, dependences })
}

impl Robustness {
    /// The loads (Pa) of case `index` at which verdicts were computed again, ascending.
    pub fn loads(&self, index: usize) -> Vec<f64> {
        let longest = self.treated.iter().map(|one| one.differences(index)).max_by_key(|all| all.len());
        longest.unwrap_or_default().iter().map(|at| at.load).collect()
    }
}

/// At most [`MOST_LOADS`] of the valid loads, evenly spread over their ranks.
fn some_loads(differences: &[Difference]) -> Vec<f64> {
    let mut loads: Vec<f64> =
        differences.iter().filter(|at| at.exceeded().is_none()).map(|at| at.load).collect();
    loads.sort_by(f64::total_cmp);
    let count = loads.len();
    if count <= MOST_LOADS {
        return loads;
    }
    (0..MOST_LOADS).map(|k| loads[(k * (count - 1) + (MOST_LOADS - 1) / 2) / (MOST_LOADS - 1)]).collect()
}
