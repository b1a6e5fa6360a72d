//! A load that is not reached because a property of a material, or a length of a surface, is in another unit than was meant.

use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;

use super::StudyPlan;

/// Young's moduli below that of any solid body that is modelled as rough, Pa.
const SOFTEST: f64 = 1e6;

/// Hardnesses below that of any solid, Pa.
const LEAST_HARDNESS: f64 = 1e3;

/// The error at the property or the length that explains why a load is not reached on a surface, `message`; `None` if the
/// properties are those of solids and the surface is one that can be.
pub fn error(context: &RunContext, plan: &StudyPlan, surface: &str, message: &str) -> Option<InputError> {
    let of_surface = || {
        let planned = plan.surfaces.iter().find(|planned| planned.name == surface)?;
        planned.implausible_unit(context.source, message)
    };
    of_bodies(context, plan, message).or_else(of_surface)
}

fn of_bodies(context: &RunContext, plan: &StudyPlan, message: &str) -> Option<InputError> {
    let layer = plan.layer.as_ref().map(|layer| layer.name.as_str());
    let names = [Some(plan.bodies.rough.as_str()), Some(plan.bodies.flat.as_str()), layer];
    let properties =
        names.into_iter().flatten().filter_map(|name| Some((name, context.materials.get(name)?)));
    let mut implausible = properties.flat_map(|(name, material)| {
        let young = Some(material.young()).filter(|&young| young < SOFTEST);
        let hardness = material.hardness().filter(|&hardness| hardness < LEAST_HARDNESS);
        let found = [("young", "Young's modulus", "GPa", young), ("hardness", "hardness", "HV", hardness)];
        found.into_iter().filter_map(move |(key, word, unit, value)| Some((name, key, word, unit, value?)))
    });
    let (name, key, word, unit, value) = implausible.next()?;
    let (span, _) = context.source.value_at(&["material", name, key])?;
    Some(context.source.error_at(
        span,
        format!("found a {word} of {value:e} Pa, lower than that of any solid, so that a load is not reached; check the unit, as in {key} = \"210 {unit}\". {message}"),
    ))
}
