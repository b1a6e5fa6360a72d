//! What a layer changes on one surface: the thickness from which it has an effect, and the friction of a film by its thickness.

use rayon::prelude::*;

use super::models::SurfaceModels;
use super::results::{CaseResults, CaseStudy, RealisationResults};
use super::setup::Setup;
use crate::compare::{ComparedQuantity, ModelKind, of_each_decade, threshold};
use crate::interface::WithSpots;
use crate::layer::Coating;
use crate::sphere::Decrease;
use crate::spot::{Shear, ShearStrength, SpotProperties};
use crate::surface::Surface;
use crate::work::{CountedContact, Counter};
use crate::{ContactLaw, Exceeded, Material, Model, Response, reached_at};

/// What the thickness changes.
#[derive(Debug)]
pub struct LayerFindings {
    /// The models that were run, the statistical one first.
    pub models: Vec<ModelKind>,
    /// Loads at which thicknesses are compared, Pa, ascending.
    pub loads: Vec<f64>,
}

/// A range of indentations in which area or load of an asperity decreases.
#[derive(Debug, Clone)]
pub struct DecreaseResults {
    /// The law.
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// Of the asperity, m.
    pub radius: f64,
    /// The range.
    pub decrease: Decrease,
}

/// Largest thickness at which the real area is within 5 % of the uncoated one.
#[derive(Debug, Clone)]
pub struct Threshold {
    /// The law.
    pub law: String,
    /// The model.
    pub kind: ModelKind,
    /// The nominal pressure, Pa.
    pub pressure: f64,
    /// The limits that one of the models exceeds at that pressure without the layer: the load is then not admissible, and has no threshold.
    pub exceeded: Exceeded,
    /// The thickness, m: infinite where no layer has an effect, `None` where the thinnest one tested has, and where the load is not
    /// admissible.
    pub thickness: Option<f64>,
}

impl LayerFindings {
    /// Of the `cases` and `thresholds` of one law; `None` without a layer in the spec.
    pub fn new(cases: &[&CaseStudy], thresholds: &[&Threshold]) -> Option<Self> {
        if cases.iter().any(|case| case.first().thickness.is_none()) {
            return None;
        }
        let mut loads: Vec<f64> = thresholds.iter().map(|threshold| threshold.pressure).collect();
        loads.sort_unstable_by(f64::total_cmp);
        loads.dedup();
        let is_used = |kind: &ModelKind| {
            cases.iter().any(|case| case.first().comparison.curves.iter().any(|point| point.kind == *kind))
        };
        let models = [ModelKind::Statistical, ModelKind::Deterministic].into_iter().filter(is_used).collect();
        Some(Self { models, loads })
    }

    /// The model shown where only one is: the sum, or the integral if it is the only one.
    pub fn main_model(&self) -> ModelKind {
        if self.models.contains(&ModelKind::Deterministic) {
            ModelKind::Deterministic
        } else {
            ModelKind::Statistical
        }
    }
}

/// One law, all thicknesses together, on the first realisation.
#[derive(Debug)]
pub struct LawFindings {
    /// The law, as tables name it.
    pub law: String,
    /// Effect of the layer thickness; `None` without a layer in the spec.
    pub layer: Option<LayerFindings>,
}

impl LawFindings {
    /// Of every law, in file order.
    pub fn all(cases: &[CaseStudy], thresholds: &[Threshold]) -> Vec<Self> {
        let mut laws: Vec<&str> = cases.iter().map(|case| case.first().law.as_str()).collect();
        laws.dedup();
        let findings = |law: &str| {
            let cases: Vec<&CaseStudy> = cases.iter().filter(|case| case.first().law == law).collect();
            let thresholds: Vec<&Threshold> =
                thresholds.iter().filter(|threshold| threshold.law == law).collect();
            Self { law: law.to_owned(), layer: LayerFindings::new(&cases, &thresholds) }
        };
        laws.into_iter().map(findings).collect()
    }
}

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

/// A layer matters where it changes the real area by more than this part.
const PART: f64 = 0.05;

/// A layer on one of the bodies, against the other.
#[derive(Clone, Copy)]
pub struct LayerQuestion<'a> {
    /// The layer.
    pub coating: &'a Coating,
    /// The thicknesses that were run, m, ascending.
    pub thicknesses: &'a [f64],
    /// The body without the layer.
    pub bare: &'a Material,
}

/// Law by law, load by load, model by model.
pub fn thresholds(
    question: LayerQuestion,
    setup: Setup,
    surface: &Surface,
    models: &SurfaceModels,
    realisation: &RealisationResults,
    counter: &Counter,
) -> Vec<Threshold> {
    let LayerQuestion { coating, thicknesses, bare } = question;
    let area = setup.load_area(surface);
    let mut pressures: Vec<f64> = setup.controls.pressures.clone();
    pressures.extend(setup.controls.forces.iter().map(|force| force / area));
    let pressures = some_of(pressures);
    if thicknesses == [0.0] {
        return Vec::new();
    }
    let mut loads = Vec::new();
    // Only laws under a layer of finite thickness have a threshold.
    let stands =
        |law: &&ContactLaw| coating.flat(1.0).is_ok_and(|finite| law.interface(bare, &finite).is_ok());
    for law in setup.law_specs.iter().filter(stands) {
        loads.extend(pressures.iter().map(|&pressure| (law, pressure)));
    }
    let at_load = |&(law, pressure): &(&ContactLaw, f64)| {
        let question = Question { layer: question, models, realisation, counter, law, pressure };
        question.thresholds(setup.models)
    };
    let all: Vec<Vec<Threshold>> = loads.par_iter().map(at_load).collect();
    all.into_iter().flatten().collect()
}

/// All loads (Pa) of a short list; of a long one those nearest to the powers of ten.
pub(super) fn some_of(mut loads: Vec<f64>) -> Vec<f64> {
    const SHORT: usize = 6;
    loads.sort_unstable_by(f64::total_cmp);
    loads.dedup();
    if loads.len() <= SHORT {
        return loads;
    }
    of_each_decade(loads, |&load| load, 1.0)
}

/// One law and load.
struct Question<'a> {
    layer: LayerQuestion<'a>,
    models: &'a SurfaceModels<'a>,
    realisation: &'a RealisationResults,
    counter: &'a Counter,
    law: &'a ContactLaw,
    pressure: f64,
}

impl Question<'_> {
    /// Of each of the models that reaches the load without the layer. Where that load is beyond a limit of one of them there is no
    /// threshold: below it the contact is the uncoated one to 5 % of its area.
    fn thresholds(&self, kinds: &[ModelKind]) -> Vec<Threshold> {
        let bare =
            |&kind: &ModelKind| Some((kind, self.known(kind, 0.0).or_else(|| self.response(kind, 0.0))?));
        let bare: Vec<(ModelKind, Response)> = kinds.iter().filter_map(bare).collect();
        let exceeded =
            bare.iter().fold(Exceeded::default(), |all, (_, response)| all.union(response.exceeded()));
        let threshold = |(kind, bare): &(ModelKind, Response)| Threshold {
            law: self.law.label(),
            kind: *kind,
            pressure: self.pressure,
            exceeded,
            thickness: if exceeded.is_none() { self.search(*kind, bare) } else { None },
        };
        bare.par_iter().map(threshold).collect()
    }

    fn search(&self, kind: ModelKind, bare: &Response) -> Option<f64> {
        let area = |response: Response| response.area_ratio.total();
        // A load that a flat does not carry at any separation shows no area: it matters.
        let departs = |response: Option<Response>| {
            response.is_none_or(|response| (area(response) / area(*bare) - 1.0).abs() > PART)
        };
        let listed: Vec<(f64, bool)> =
            self.layer.thicknesses.iter().map(|&t| (t, departs(self.known(kind, t)))).collect();
        threshold(&listed, |t| departs(self.response(kind, t)))
    }

    /// The response that the comparison has found for a listed thickness.
    fn known(&self, kind: ModelKind, thickness: f64) -> Option<Response> {
        let label = self.law.label();
        let case = self
            .realisation
            .cases
            .iter()
            .find(|case| case.law == label && case.thickness == Some(thickness))?;
        Some(case.comparison.at_load(kind, self.pressure)?.response)
    }

    /// The response under a layer of any thickness (m).
    fn response(&self, kind: ModelKind, thickness: f64) -> Option<Response> {
        let flat = self.layer.coating.flat(thickness).ok()?;
        let contact = self.law.interface(self.layer.bare, &flat).ok()?;
        let contact = &CountedContact::new(&*contact, self.counter);
        let press = |model: &dyn Model| reached_at(model, &[self.pressure])[0];
        let reached = match kind {
            ModelKind::Statistical => press(&*self.models.statistical(contact, self.law)),
            ModelKind::Deterministic => press(&self.models.deterministic(contact, self.law)?),
        };
        reached.map(|reached| reached.response)
    }
}
