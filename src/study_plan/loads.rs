//! The loads of a study, for a person: each as a force, the area that it acts on, and the pressure.

use std::fmt;

use asperity::compare::Controls;
use asperity_contact_framework::report::format::{input_quantity, quantity};

use super::StudyPlan;
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
