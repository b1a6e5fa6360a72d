//! Running `[indentation]`: one sphere on layered flats, and the accuracy of the effective-modulus model of each layer.

use std::collections::HashSet;
use std::time::Instant;

use asperity::compare::{ModulusCheck, ModulusError, ModulusFindings, apart};
use asperity::layer::exact_sphere::{ElasticContact, LayeredSphere};
use asperity::sphere::Curve;
use asperity::work::{CountedContact, Counter, Item};
use asperity::{
    ContactError, Flat, Material, MicroContact, ModulusModel, Shape, literature, reduced_modulus,
};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Metadata, Timing};
use asperity_contact_framework::report::format::input_quantity;
use indexmap::IndexMap;
use rayon::prelude::*;

use super::{IndentationPlan, Show};
use crate::layer::LayerPlan;
use crate::paper::SphereFigure;

#[derive(Debug)]
pub struct IndentationResults {
    pub metadata: Metadata,
    pub materials: IndexMap<String, Material>,
    pub ball: String,
    /// Of the ball, m.
    pub radius: f64,
    pub flat: String,
    /// E* of the pair without a layer, Pa.
    pub reduced_modulus: f64,
    /// m, ascending.
    pub indentations: Vec<f64>,
    /// Axes of the load figure.
    pub show: Show,
    pub figure_of_paper: Option<SphereFigure>,
    /// Layer by layer, thickness by thickness.
    pub layers: Vec<LayerResults>,
    /// Measured indentations (m) and loads (N).
    pub overlay: Vec<(f64, f64)>,
}

#[derive(Debug)]
pub struct LayerResults {
    pub name: String,
    /// m.
    pub thickness: f64,
    pub rule: ModulusModel,
    pub laws: Vec<LawCurves>,
    /// The exact elastic contact at each indentation; `None` where it is too large to be solved.
    pub exact: Vec<Option<ElasticContact>>,
    /// Both effective-modulus models over the contacts of the sweep that are solved exactly.
    pub check: ModulusFindings,
    /// The errors of both at the specified indentations at which the exact contact is solved.
    pub errors: [Vec<ModulusError>; 2],
}

#[derive(Debug)]
pub struct LawCurves {
    /// The law, as tables name it.
    pub law: String,
    pub coated: Curve,
    pub uncoated: Curve,
    /// The flat all of the layer's material.
    pub all_layer: Curve,
    /// Coated loads at the indentations of the measured points, N.
    pub at_overlay: Vec<f64>,
}

impl LawCurves {
    /// The curves and their names in tables.
    pub fn curves(&self) -> [(&'static str, &Curve); 3] {
        [("coated", &self.coated), ("uncoated", &self.uncoated), ("all-layer", &self.all_layer)]
    }
}

impl IndentationResults {
    /// Layers of different material or thickness: the errors of both models are the same whichever of them the spec chose.
    pub fn distinct_layers(&self) -> Vec<&LayerResults> {
        let mut seen = HashSet::new();
        let is_new = |layer: &&LayerResults| seen.insert((layer.name.clone(), layer.thickness.to_bits()));
        self.layers.iter().filter(is_new).collect()
    }
}

impl LayerResults {
    /// a/R at the last indentation: the largest of all curves.
    pub fn largest_slope(&self, radius: f64) -> f64 {
        let last = |law: &LawCurves| law.coated.points.last().map(|point| point.contact.area);
        let areas = self.laws.iter().filter_map(last).map(|area| (area / std::f64::consts::PI).sqrt());
        let exact = self.exact.last().copied().flatten().map(|contact| contact.contact_radius);
        areas.chain(exact).fold(0.0, f64::max) / radius
    }

    pub fn label(&self) -> String {
        format!("{} {}", self.name, input_quantity(self.thickness, "m"))
    }
}

pub(super) fn run(context: &RunContext, plan: &IndentationPlan) -> Result<IndentationResults, InputError> {
    let start = Instant::now();
    context.progress.stage("layers", plan.cases() as f64);
    let counter = Counter::default();
    counter.add(Item::Files, plan.overlay.iter().len());
    let mut papers = vec![literature::PASARIBU_SCHIPPER_2005];
    let mut layers = || {
        let uncoated = curves(plan, &contacts(plan, &Flat::Bare(plan.flat.1))?, &counter);
        let mut layers = Vec::new();
        for layer in &plan.layers {
            let all_layer = Flat::AllLayer { substrate: plan.flat.1, layer: layer.coating.material };
            let all_layer = curves(plan, &contacts(plan, &all_layer)?, &counter);
            let check = ModulusCheck::new(&plan.ball.1, &layer.coating.material, &plan.flat.1)?;
            papers.extend(check.papers());
            for &thickness in &layer.thicknesses {
                let coated = contacts(plan, &layer.coating.flat(thickness)?)?;
                papers.extend(coated.iter().flat_map(|contact| contact.papers()));
                let laws = laws(plan, &coated, [&uncoated, &all_layer], &counter);
                layers.push(layer_results(plan, layer, thickness, laws, &check));
                context.progress.advance(1.0);
            }
        }
        Ok(layers)
    };
    let layers = layers().map_err(|error: ContactError| InputError::file(&context.source.path, error))?;
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    Ok(IndentationResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        materials: context.materials.clone(),
        ball: plan.ball.0.clone(),
        radius: plan.radius,
        flat: plan.flat.0.clone(),
        reduced_modulus: reduced_modulus(&plan.ball.1, &plan.flat.1),
        indentations: plan.indentations.clone(),
        show: plan.show,
        figure_of_paper: plan.figure_of_paper,
        layers,
        overlay: plan.overlay.iter().flat_map(|overlay| overlay.points.clone()).collect(),
    })
}

/// The ball on a flat, law by law.
fn contacts(plan: &IndentationPlan, flat: &Flat) -> Result<Vec<Box<dyn MicroContact>>, ContactError> {
    plan.laws.iter().map(|law| Ok(law.interface(&plan.ball.1, flat)?)).collect()
}

fn curves(plan: &IndentationPlan, contacts: &[Box<dyn MicroContact>], counter: &Counter) -> Vec<Curve> {
    let counted = contacts.iter().map(|contact| CountedContact::new(&**contact, counter));
    counted.map(|contact| Curve::new(&contact, Shape::sphere(plan.radius), &plan.indentations)).collect()
}

fn laws(
    plan: &IndentationPlan,
    coated: &[Box<dyn MicroContact>],
    [uncoated, all_layer]: [&[Curve]; 2],
    counter: &Counter,
) -> Vec<LawCurves> {
    let curves = curves(plan, coated, counter);
    let law = |(k, curve): (usize, Curve)| {
        let contact = CountedContact::new(&*coated[k], counter);
        let measured = plan.overlay.iter().flat_map(|overlay| &overlay.points);
        LawCurves {
            law: plan.laws[k].label(),
            coated: curve,
            uncoated: uncoated[k].clone(),
            all_layer: all_layer[k].clone(),
            at_overlay: measured.map(|&(w, _)| contact.contact(w, Shape::sphere(plan.radius)).load).collect(),
        }
    };
    curves.into_iter().enumerate().map(law).collect()
}

fn layer_results(
    plan: &IndentationPlan,
    layer: &LayerPlan,
    thickness: f64,
    laws: Vec<LawCurves>,
    check: &ModulusCheck,
) -> LayerResults {
    let LayerPlan { name, rule, coating, .. } = layer;
    let sphere =
        LayeredSphere::new(Some(&plan.ball.1), plan.radius, &coating.material, &plan.flat.1, thickness);
    let exact = |&w: &f64| Some(ElasticContact { indentation: w, ..sphere.at_indentation(w)? });
    let exact: Vec<Option<ElasticContact>> = plan.indentations.par_iter().map(exact).collect();
    let errors = exact.iter().flatten().map(|contact| check.beside(contact, plan.radius, thickness));
    let errors = apart(errors);
    let [from, to] = match &errors[0][..] {
        [first, .., last] => [first.contact_ratio, last.contact_ratio],
        [only] => [only.contact_ratio; 2],
        [] => [f64::NAN; 2],
    };
    let check = check.findings(from, to);
    LayerResults { name: name.clone(), thickness, rule: *rule, laws, exact, check, errors }
}
