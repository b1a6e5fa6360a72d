//! Robustness: both models on a measured map under other treatments of it.

use asperity::compare::{Controls, Difference};
use asperity::study::{
    CaseResults, CaseStudy, Dependence, Setup, StatisticalModel, Treated, Treatment, study,
};
use asperity::surface::Surface;
use asperity::work::Counter;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::progress::Silent;

use super::plan::ComparePlan;
use crate::surface::SurfaceFactory;

/// The differences between the models under other treatments of a map.
pub struct Treatments {
    /// Nesting index of the map's own S filter, m.
    own_cut_off: Option<f64>,
    /// Treatment by treatment, case by case.
    treated: Vec<(Treatment, Vec<Vec<Difference>>)>,
}

/// The most loads of a case at which verdicts are computed again.
const MOST_LOADS: usize = 9;

/// Compares the models on a surface, which gave `cases`, under other treatments; `None` unless it is a measured map and both models
/// were run and compared at a valid load.
pub fn treatments(
    context: &RunContext,
    plan: &ComparePlan,
    factory: &SurfaceFactory,
    surface: &Surface,
    cases: &[CaseResults],
    counter: &Counter,
) -> Option<Treatments> {
    let own = factory.preparation().filter(|_| plan.is_robustness_examined)?;
    let mut loads: Vec<f64> = cases.iter().flat_map(|case| some_loads(&case.differences)).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    if loads.is_empty() || !plan.setup(context).has_both_models() {
        return None;
    }
    let map = surface.map.as_ref()?;
    let controls = Controls::at_pressures(loads);
    let treatments = Treatment::all(&own, &plan.study.statistical, map);
    context.progress.stage("robustness", treatments.len() as f64);
    let treated = treatments.into_iter().map(|treatment| {
        let statistical = match treatment {
            Treatment::MeanRadius(mean_radius) => {
                &StatisticalModel { mean_radius, ..plan.study.statistical.clone() }
            }
            _ => &plan.study.statistical,
        };
        let setup = Setup {
            controls: &controls,
            statistical,
            is_attributed: false,
            progress: &Silent,
            ..plan.setup(context)
        };
        let treat = || {
            // The mean radius changes nothing on the surface.
            let prepared = match treatment {
                Treatment::MeanRadius(_) => None,
                _ => Some(factory.prepared(treatment.preparation(own), map.correlation)?),
            };
            let (realisation, _) = study(setup, prepared.as_ref().unwrap_or(surface), counter).ok()?;
            Some(realisation.cases.into_iter().map(|case| case.differences).collect())
        };
        let differences = treat().unwrap_or_default();
        context.progress.advance(1.0);
        (treatment, differences)
    });
    let treated = treated.collect();
    Some(Treatments { own_cut_off: own.filter.and_then(|filter| filter.s()), treated })
}

impl Treatments {
    /// Adds the differences to the cases, with the choices that a verdict depends on; gives the nesting index of the map's own S
    /// filter.
    pub fn judge(self, cases: &mut [CaseStudy], surface: &Surface, accept: AcceptSpec) -> Option<f64> {
        let accepted = accept.on(surface.plane.sigma);
        for (treatment, differences) in self.treated {
            let mut differences = differences.into_iter();
            for case in cases.iter_mut() {
                let differences = differences.next().unwrap_or_default();
                case.treated.push(Treated { treatment, differences });
            }
        }
        for case in cases {
            case.dependences = Dependence::all(&case.first().differences, &case.treated, &accepted);
        }
        self.own_cut_off
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
