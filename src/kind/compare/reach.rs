//! Whether the loads of a comparison are reached, as far as the asperities are known without a map.

use asperity::compare::{Controls, ModelKind, Models, compare};
use asperity::study::models_of;
use asperity::surface::AnalysisDepth;
use asperity::work::Counter;
use asperity::{LOWEST_SEPARATION, Model};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;

use super::plan::ComparePlan;
use crate::study_plan::{inapplicable, unreachable_load};
use crate::surface::{SurfaceFactory, files_of};

/// Refuses a load that a population or a list does not reach, as a run would; of several realisations the first is tried.
///
/// # Errors
/// A list that cannot be used; a load that a model does not reach.
pub(super) fn check(context: &RunContext, plan: &ComparePlan) -> Result<(), InputError> {
    if plan.study.controls.pressures.is_empty() && plan.study.controls.forces.is_empty() {
        return Ok(());
    }
    let (counter, mut timing) = (Counter::default(), Timing::default());
    let mut files = files_of(&plan.study.surfaces, &counter);
    for surface in plan.study.surfaces.iter().filter(|surface| surface.has_given_asperities()) {
        let mut factory = SurfaceFactory::new(surface, context, &counter);
        let surface = factory.make(1, AnalysisDepth::Asperities, &mut files, &mut timing)?;
        let models = models_of(plan.setup(context), &surface, &mut timing)
            .map_err(|error| inapplicable(context, &plan.study, &surface.name, &error))?;
        let area = plan.setup(context).load_area(&surface);
        for law in &plan.study.laws {
            let statistical = plan
                .models
                .contains(&ModelKind::Statistical)
                .then(|| models.statistical(&*law.contact, &law.spec));
            let deterministic = models.deterministic(&*law.contact, &law.spec);
            let statistical = statistical.as_deref();
            let deterministic = deterministic.as_ref().map(|model| model as &dyn Model);
            for (model, alone) in [
                (statistical, Models { statistical, deterministic: None }),
                (deterministic, Models { statistical: None, deterministic }),
            ] {
                let Some(model) = model else { continue };
                compare(alone, &doubtful(&plan.study.controls, model, area), area)
                    .map_err(|error| unreachable_load(context, &plan.study, &surface.name, law, &error))?;
            }
        }
    }
    Ok(())
}

/// The loads above that at the lowest separation, which `model` reaches only if its load decreases on approach.
fn doubtful(controls: &Controls, model: &dyn Model, area: f64) -> Controls {
    let reached = model.respond(LOWEST_SEPARATION).pressure.total();
    let above = |loads: &[f64], per_area: f64| {
        loads.iter().copied().filter(|load| load * per_area > reached).collect()
    };
    Controls {
        separations: Vec::new(),
        pressures: above(&controls.pressures, 1.0),
        forces: above(&controls.forces, area.recip()),
    }
}
