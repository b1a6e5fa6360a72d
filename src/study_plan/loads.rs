//! The loads of a study, and why one is not reached.

use std::fmt;

use asperity::compare::{Control, Controls, NotReached};
use asperity::distribution::HeightsError;
use asperity::study::LawContact;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::report::format::{input_quantity, quantity};

use super::StudyPlan;
use crate::layer::thickness_words;
use crate::surface::SurfacePlan;

/// A line for each load that is asked for, on each area that it acts on: the nominal area of the spec, or that of each surface.
pub fn describe(plan: &StudyPlan, f: &mut fmt::Formatter) -> fmt::Result {
    let Controls { pressures, forces, .. } = &plan.controls;
    for (area, owner) in areas(plan) {
        for (values, is_force) in [(pressures, false), (forces, true)] {
            if values.is_empty() {
                continue;
            }
            let count = if values.len() > 1 { format!(", {} loads", values.len()) } else { String::new() };
            let unit = |is_force| if is_force { "N" } else { "Pa" };
            let asked_for = range(values, unit(is_force), input_quantity);
            match area {
                Some(area) => {
                    let factor = if is_force { area.recip() } else { area };
                    let other: Vec<f64> = values.iter().map(|value| value * factor).collect();
                    let other = range(&other, unit(!is_force), quantity);
                    let [force, pressure] = if is_force { [asked_for, other] } else { [other, asked_for] };
                    writeln!(f, "  load: {force} on {} ({owner}): {pressure}{count}", quantity(area, "m²"))?;
                }
                None => {
                    writeln!(f, "  load: {asked_for} on the area of {owner}, known once it is made{count}")?
                }
            }
        }
    }
    Ok(())
}

/// The caveat of a force that acts on a measured map's own area, which is seldom the area of the contact.
pub fn own_area(plan: &StudyPlan) -> Vec<String> {
    if plan.nominal_area.is_some() || plan.controls.forces.is_empty() {
        return Vec::new();
    }
    let measured = plan.surfaces.iter().filter(|surface| surface.is_measured());
    let caveat = |surface: &SurfacePlan| {
        let area = surface.nominal_area()?;
        let forces = &plan.controls.forces;
        let pressures: Vec<f64> = forces.iter().map(|force| force / area).collect();
        Some(format!(
            "surface {}: {} on the map's own {}: {}; if the force acts on another area, write it, as in `nominal-area = \"4 mm2\"`",
            surface.name,
            range(forces, "N", input_quantity),
            quantity(area, "m²"),
            range(&pressures, "Pa", quantity),
        ))
    };
    measured.filter_map(caveat).collect()
}

/// The areas that loads act on (m²; `None` where it is not known yet), and whose they are: each once.
fn areas(plan: &StudyPlan) -> Vec<(Option<f64>, String)> {
    /// More surfaces are counted.
    const NAMED: usize = 3;
    if plan.nominal_area.is_some() {
        return vec![(plan.nominal_area, "nominal-area".to_owned())];
    }
    let mut areas: Vec<(Option<f64>, Vec<&str>)> = Vec::new();
    for surface in &plan.surfaces {
        let area = surface.nominal_area();
        match areas.iter_mut().find(|(other, _)| *other == area) {
            Some((_, names)) => names.push(&surface.name),
            None => areas.push((area, vec![&surface.name])),
        }
    }
    let owner = |names: Vec<&str>| match &names[..] {
        [one] => format!("surface {one}"),
        few if few.len() <= NAMED => format!("each of the surfaces {}", few.join(", ")),
        many => format!("each of {} surfaces", many.len()),
    };
    areas.into_iter().map(|(area, names)| (area, owner(names))).collect()
}

/// "5 N", or "1 N to 5 N".
fn range(values: &[f64], unit: &str, written: fn(f64, &str) -> String) -> String {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least == most {
        written(least, unit)
    } else {
        format!("{} to {}", written(least, unit), written(most, unit))
    }
}

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
    if let Some(error) = implausible_error(context, plan, surface, &message) {
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

/// Young's moduli below that of any solid body that is modelled as rough, Pa.
const SOFTEST: f64 = 1e6;

/// Hardnesses below that of any solid, Pa.
const LEAST_HARDNESS: f64 = 1e3;

/// The error at the property or the length that explains why a load is not reached on a surface, `message`; `None` if the
/// properties are those of solids and the surface is one that can be.
pub fn implausible_error(
    context: &RunContext,
    plan: &StudyPlan,
    surface: &str,
    message: &str,
) -> Option<InputError> {
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
