//! `friction_by_thickness.csv`: where boundary friction is least.

use asperity::study::FilmFriction;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use crate::kind::compare::results::CompareResults;

/// One law, model, load and breakdown.
pub(crate) struct FrictionRow<'a> {
    surface: &'a str,
    found: &'a FilmFriction,
}

impl Row for FrictionRow<'_> {
    const FILE: &'static str = "friction_by_thickness.csv";
    const ROWS: &'static str = "One row for each surface, law, load, breakdown of the layer and model, on the first realisation: the layer thickness of the smallest coefficient of friction, of those that were run.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.surface, "Name of the surface.";
            law["text"] = row.found.law.as_str(), "Contact law of an asperity.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.found.pressure, "Nominal pressure.";
            breakdown["1", label("breakdown w/t")] = row.found.breakdown, "Indentation over the thickness from which on a spot has broken through the layer and shears as the interface without it.";
            model["text"] = row.found.kind.name(), "Model: `statistical` or `deterministic`.";
            least_at_m["m", label("least at"), thickness] = row.found.least().map(|(thickness, _)| thickness), "Thickness of the smallest coefficient.";
            least["1", label("least coefficient")] = row.found.least().map(|(_, coefficient)| coefficient), "The coefficient there.";
            uncoated["1"] = row.found.at(0.0), "Coefficient without the layer; empty where that was not run.";
            bulk["1"] = row.found.at(f64::INFINITY), "Coefficient on the bulk of the layer's material; empty where that was not run.";
        }
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = FrictionRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        let name = &surface.surface.name;
        surface.friction.iter().map(move |found| FrictionRow { surface: name, found })
    })
}
