//! Robustness: both models on a measured map under other treatments of it.

use asperity::study::{CaseResults, CaseStudy, Dependence, Treated, TreatedCases, under_treatments};
use asperity::surface::Surface;
use asperity::work::Counter;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::progress::Progress;

use super::plan::ComparePlan;
use crate::surface::SurfaceFactory;

/// The differences between the models under other treatments of a map.
pub struct Treatments {
    /// Nesting index of the map's own S filter, m.
    own_cut_off: Option<f64>,
    treated: Vec<TreatedCases>,
}

/// Compares the models on a surface, which gave `cases`, under other treatments; `None` unless it is a measured map and both models
/// were run and compared at an admissible load.
pub fn treatments(
    context: &RunContext,
    plan: &ComparePlan,
    factory: &SurfaceFactory,
    surface: &Surface,
    cases: &[CaseResults],
    counter: &Counter,
) -> Option<Treatments> {
    let own = factory.preparation().filter(|_| plan.is_robustness_examined)?;
    let correlation = surface.map.as_ref()?.correlation;
    let prepare = |preparation, progress: &dyn Progress| factory.prepared(preparation, correlation, progress);
    let treated = under_treatments(plan.setup(context), surface, &own, cases, prepare, counter)?;
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
