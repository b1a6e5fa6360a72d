//! What only a run can find, at its place in the spec.

use asperity::compare::{Control, NotReached};
use asperity::distribution::HeightsError;
use asperity::study::LawContact;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;

use super::{StudyPlan, implausible};
use crate::layer::thickness_words;

/// Points at the statistical model that does not apply to a surface.
pub fn inapplicable(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    error: &HeightsError,
) -> InputError {
    let message = format!("the statistical model does not apply to surface {surface}: {error}");
    match &plan.statistical_key {
        Some(span) => context.source.error_at(span.clone(), message),
        None => InputError::file(&context.source.path, message),
    }
}

/// Points at the sweep with a load out of reach.
pub fn unreachable_load(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    law: &LawContact,
    error: &NotReached,
) -> InputError {
    let layer =
        law.thickness.map_or_else(String::new, |t| format!(", layer of thickness {}", thickness_words(t)));
    let message = format!("surface {surface}, law {}{layer}: {error}", law.label);
    if let Some(error) = implausible::error(context, plan, surface, &message) {
        return error;
    }
    let span = match error.control {
        Control::Pressure => plan.load_keys[0].clone(),
        Control::Force => plan.load_keys[1].clone(),
        Control::Separation => None,
    };
    match span {
        Some(span) => context.source.error_at(span, message),
        None => InputError::file(&context.source.path, message),
    }
}
