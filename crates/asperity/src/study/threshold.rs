//! Up to which thickness the layer of a comparison does not matter.

use rayon::prelude::*;

use super::layer::Threshold;
use super::models::SurfaceModels;
use super::results::RealisationResults;
use super::setup::Setup;
use crate::compare::{ModelKind, of_each_decade, threshold};
use crate::layer::Coating;
use crate::surface::Surface;
use crate::work::{CountedContact, Counter};
use crate::{ContactLaw, Exceeded, Material, Model, Response, reached_at};

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
