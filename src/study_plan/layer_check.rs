//! How good the effective-modulus models of a layer are between the materials of a study.

use asperity::compare::{ModulusCheck, ModulusFindings};
use asperity::{ContactError, Paper};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::LayerMetadata;
use asperity_contact_framework::input::InputError;

use super::StudyPlan;
use crate::layer::LayerPlan;

/// The layer, and the check of its rule where some contact is under it, whose sources are added to `papers`.
///
/// # Errors
/// A layer that the exact solution does not apply to.
pub fn layer_metadata(
    context: &RunContext,
    plan: &StudyPlan,
    papers: &mut Vec<Paper>,
) -> Result<Option<LayerMetadata>, InputError> {
    let Some(layer) = &plan.layer else { return Ok(None) };
    let mut check = None;
    if plan.uses_rule(layer) {
        let (findings, rules) =
            rule_check(plan, layer).map_err(|error| InputError::file(&context.source.path, error))?;
        papers.extend(rules);
        check = Some(findings);
    }
    let thicknesses = layer.thicknesses.clone();
    Ok(Some(LayerMetadata { name: layer.name.clone(), rule: layer.rule, on: layer.on, thicknesses, check }))
}

/// How good both rules are between the materials of a study.
fn rule_check(plan: &StudyPlan, layer: &LayerPlan) -> Result<(ModulusFindings, Vec<Paper>), ContactError> {
    /// a/t, from and to.
    const RANGE: [f64; 2] = [0.1, 10.0];
    let [bare, substrate] = plan.bare_and_coated();
    let check = ModulusCheck::new(bare, &layer.coating.material, substrate)?;
    Ok((check.findings(RANGE[0], RANGE[1]), check.papers()))
}
