//! The friction of a layered contact by the thickness of the layer.

use rayon::prelude::*;

use super::models::SurfaceModels;
use super::results::{CaseResults, RealisationResults};
use super::setup::Setup;
use super::threshold::{LayerQuestion, some_of};
use crate::compare::{ComparedQuantity, ModelKind};
use crate::interface::WithSpots;
use crate::spot::{Shear, ShearStrength, SpotProperties};
use crate::surface::Surface;
use crate::{ContactLaw, Model};

/// How a layer shears.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// The strength of the layer.
    pub strength: ShearStrength,
    /// That of the interface without it.
    pub interface: ShearStrength,
    /// Indentations over the thickness from which on a spot has broken through it, each on its own.
    pub breakdowns: Vec<f64>,
}

/// The coefficient of friction by thickness, of one law, model, load and breakdown.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmFriction {
    /// The law.
    pub law: String,
    /// The model.
    pub kind: ModelKind,
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Indentation over the thickness from which on a spot has broken through the layer.
    pub breakdown: f64,
    /// Thickness (m, ascending; 0 and infinity among them) and coefficient.
    pub points: Vec<(f64, f64)>,
}

impl FilmFriction {
    /// The thickness (m) and the coefficient where it is least.
    pub fn least(&self) -> Option<(f64, f64)> {
        self.points.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The coefficient at a thickness that was run.
    pub fn at(&self, thickness: f64) -> Option<f64> {
        self.points.iter().find(|(t, _)| *t == thickness).map(|(_, coefficient)| *coefficient)
    }
}

/// Law by law, load by load, breakdown by breakdown, model by model, at separations that the comparison has found.
pub fn film_friction(
    question: LayerQuestion,
    film: &Film,
    setup: Setup,
    surface: &Surface,
    models: &SurfaceModels,
    realisation: &RealisationResults,
) -> Vec<FilmFriction> {
    let area = setup.load_area(surface);
    let mut pressures: Vec<f64> = setup.controls.pressures.clone();
    pressures.extend(setup.controls.forces.iter().map(|force| force / area));
    let mut tasks = Vec::new();
    for law in setup.law_specs {
        for &pressure in &some_of(pressures.clone()) {
            for &breakdown in &film.breakdowns {
                tasks.extend(setup.models.iter().map(|&kind| (law, pressure, breakdown, kind)));
            }
        }
    }
    let of_task = |&(law, pressure, breakdown, kind): &(&ContactLaw, f64, f64, ModelKind)| {
        let label = law.label();
        let point = |case: &CaseResults| {
            let thickness = case.thickness?;
            let at = case.comparison.at_load(kind, pressure)?.response.separation_over_sigma;
            let flat = question.coating.flat(thickness).ok()?;
            let contact = law.interface(question.bare, &flat).ok()?;
            let shear = Shear::under_film(film.interface, film.strength, thickness, breakdown);
            let properties = SpotProperties { shear: Some(shear), ..SpotProperties::default() };
            let contact = WithSpots::new(contact, properties);
            let response = match kind {
                ModelKind::Statistical => models.statistical(&contact, law).respond(at),
                ModelKind::Deterministic => models.deterministic(&contact, law)?.respond(at),
            };
            Some((thickness, ComparedQuantity::Friction.value(&response)?))
        };
        let cases = realisation.cases.iter().filter(|case| case.law == label);
        let points = cases.filter_map(point).collect();
        FilmFriction { law: label.clone(), kind, pressure, breakdown, points }
    };
    let all: Vec<FilmFriction> = tasks.par_iter().map(of_task).collect();
    all.into_iter().filter(|found| found.points.len() > 1).collect()
}
