//! Running `[indentation]`: one sphere on layered flats, and the accuracy of the effective-modulus model of each layer.

use std::time::Instant;

use indexmap::IndexMap;
use rayon::prelude::*;

use super::plan::IndentationPlan;
use super::spec::Show;
use crate::layer::{LayerPlan, rule_warning, thickness_words};
use asperity::compare::{ModulusCheck, ModulusError, ModulusFindings, apart};
use asperity::layer::exact_sphere::{ElasticContact, LayeredSphere};
use asperity::sphere::{Curve, LARGEST_SLOPE};
use asperity::work::{CountedContact, Counter, Item};
use asperity::{
    ContactError, ContactLaw, Flat, Material, MicroContact, ModulusModel, Paper, Shape, literature,
    reduced_modulus,
};
use asperity_framework::RunContext;
use asperity_framework::input::InputError;
use asperity_framework::metadata::{Metadata, Timing};

/// One sphere on layered flats.
#[derive(Debug)]
pub struct IndentationResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies of the spec.
    pub materials: IndexMap<String, Material>,
    /// The ball's material.
    pub ball: String,
    /// Of the ball, m.
    pub radius: f64,
    /// The substrate's material.
    pub flat: String,
    /// E* of the pair without a layer, Pa.
    pub reduced_modulus: f64,
    /// m, ascending.
    pub indentations: Vec<f64>,
    /// Axes of the load figure.
    pub show: Show,
    /// Layer by layer, thickness by thickness.
    pub layers: Vec<LayerResults>,
    /// Measured points, m and N, and their file as named in the spec.
    pub overlay: Option<(String, Vec<(f64, f64)>)>,
}

/// A layer of one thickness.
#[derive(Debug)]
pub struct LayerResults {
    /// Its material.
    pub name: String,
    /// m.
    pub thickness: f64,
    /// Effective-modulus model.
    pub rule: ModulusModel,
    /// Law by law.
    pub laws: Vec<LawCurves>,
    /// The exact elastic contact at each indentation; `None` where it is too large to be solved.
    pub exact: Vec<Option<ElasticContact>>,
    /// Both rules over the contacts of the sweep that are solved exactly.
    pub check: ModulusFindings,
    /// The errors of both at the specified indentations at which the exact contact is solved.
    pub errors: [Vec<ModulusError>; 2],
}

/// One layer under one law.
#[derive(Debug)]
pub struct LawCurves {
    /// The law, as tables name it.
    pub law: String,
    /// With the layer.
    pub coated: Curve,
    /// Without it.
    pub uncoated: Curve,
    /// The flat all of the layer's material.
    pub all_layer: Curve,
    /// Coated loads at the indentations of the measured points, N.
    pub at_overlay: Vec<f64>,
    /// How well they fit the measured loads; `None` where none were measured.
    pub fit: Option<OverlayFit>,
}

/// Measured loads over coated ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlayFit {
    /// Geometric mean.
    pub mean_ratio: f64,
    /// The factor, at least 1, by which the worst of them is off.
    pub largest_factor: f64,
}

impl OverlayFit {
    /// Of pairs of a measured and a coated load; `None` of none.
    fn of(pairs: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let logs: Vec<f64> = pairs.map(|(measured, coated)| (measured / coated).ln()).collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let largest = logs.iter().fold(0.0, |largest: f64, log| largest.max(log.abs()));
        (!logs.is_empty()).then(|| Self { mean_ratio: mean.exp(), largest_factor: largest.exp() })
    }
}

impl IndentationResults {
    /// Warnings about the results, one per line.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for found in &self.layers {
            let layer = format!("{} of {}", found.name, thickness_words(found.thickness));
            warnings.extend(rule_warning(&found.check, &layer, found.rule));
            let slope = found.largest_slope(self.radius);
            if slope > LARGEST_SLOPE {
                warnings.push(format!(
                    "layer {layer}: the contact radius reaches {slope:.2} of the ball's; beyond {LARGEST_SLOPE} the ball is no \
                     paraboloid and strains are not small"
                ));
            }
        }
        warnings
    }

    /// a/R at the last indentation: the largest of all layers.
    pub fn largest_slope(&self) -> f64 {
        self.layers.iter().map(|found| found.largest_slope(self.radius)).fold(0.0, f64::max)
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

    /// Indentations at which the exact contact is too large to be solved.
    pub fn unsolved(&self) -> usize {
        self.exact.iter().filter(|exact| exact.is_none()).count()
    }
}

pub(super) fn run(
    context: &RunContext,
    indentation: &IndentationPlan,
) -> Result<IndentationResults, InputError> {
    let start = Instant::now();
    context.progress.stage("layers", indentation.cases() as f64);
    let counter = Counter::default();
    let mut papers = vec![literature::PASARIBU_SCHIPPER_2005];
    let mut layers = Vec::new();
    let refuse = |error: ContactError| InputError::file(&context.source.path, error);
    let uncoated = curves(indentation, &Flat::Bare(indentation.flat.1), &counter).map_err(refuse)?;
    for layer in &indentation.layers {
        let alone = Alone::of(indentation, layer, uncoated.clone(), &counter).map_err(refuse)?;
        papers.extend(alone.check.papers());
        for &thickness in &layer.thicknesses {
            let found =
                on_layer(indentation, layer, thickness, &alone, &mut papers, &counter).map_err(refuse)?;
            layers.push(found);
            context.progress.advance(1.0);
        }
    }
    let overlay = &indentation.overlay;
    counter.add(Item::Files, overlay.iter().len());
    Ok(IndentationResults {
        metadata: context.metadata(
            papers,
            Timing { total: start.elapsed(), ..Timing::default() },
            Some(counter.work()),
        ),
        materials: context.materials.clone(),
        ball: indentation.ball.0.clone(),
        radius: indentation.radius,
        flat: indentation.flat.0.clone(),
        reduced_modulus: reduced_modulus(&indentation.ball.1, &indentation.flat.1),
        indentations: indentation.indentations.clone(),
        show: indentation.show,
        layers,
        overlay: overlay.as_ref().map(|overlay| (overlay.name.clone(), overlay.points.clone())),
    })
}

/// What does not depend on the thickness of a layer.
struct Alone {
    /// Without it, law by law.
    uncoated: Vec<Curve>,
    /// The flat all of it, law by law.
    all_layer: Vec<Curve>,
    check: ModulusCheck,
}

impl Alone {
    fn of(
        plan: &IndentationPlan,
        layer: &LayerPlan,
        uncoated: Vec<Curve>,
        counter: &Counter,
    ) -> Result<Self, ContactError> {
        let (ball, substrate) = (&plan.ball.1, &plan.flat.1);
        let all_layer = Flat::AllLayer { substrate: *substrate, layer: layer.coating.material };
        Ok(Self {
            uncoated,
            all_layer: curves(plan, &all_layer, counter)?,
            check: ModulusCheck::new(ball, &layer.coating.material, substrate)?,
        })
    }
}

/// The ball on a flat, law by law.
fn curves(plan: &IndentationPlan, flat: &Flat, counter: &Counter) -> Result<Vec<Curve>, ContactError> {
    let curve = |law: &ContactLaw| {
        let contact = law.interface(&plan.ball.1, flat)?;
        Ok(Curve::of(
            &CountedContact::new(&*contact, counter),
            Shape::sphere(plan.radius),
            &plan.indentations,
        ))
    };
    plan.laws.iter().map(curve).collect()
}

fn on_layer(
    plan: &IndentationPlan,
    layer: &LayerPlan,
    thickness: f64,
    alone: &Alone,
    papers: &mut Vec<Paper>,
    counter: &Counter,
) -> Result<LayerResults, ContactError> {
    let (ball, substrate) = (&plan.ball.1, &plan.flat.1);
    let coated = layer.coating.flat(thickness)?;
    let measured: Vec<(f64, f64)> = plan.overlay.iter().flat_map(|overlay| overlay.points.clone()).collect();
    let shape = Shape::sphere(plan.radius);
    let mut laws = Vec::new();
    for (k, law) in plan.laws.iter().enumerate() {
        let contact = law.interface(ball, &coated)?;
        papers.extend(contact.papers());
        let contact = CountedContact::new(&*contact, counter);
        let at_overlay: Vec<f64> = measured.iter().map(|&(w, _)| contact.contact(w, shape).load).collect();
        let loads = measured.iter().map(|&(_, load)| load).zip(at_overlay.iter().copied());
        laws.push(LawCurves {
            law: law.label(),
            coated: Curve::of(&contact, shape, &plan.indentations),
            uncoated: alone.uncoated[k].clone(),
            all_layer: alone.all_layer[k].clone(),
            fit: OverlayFit::of(loads),
            at_overlay,
        });
    }
    let sphere = LayeredSphere::new(Some(ball), plan.radius, &layer.coating.material, substrate, thickness);
    let exact = |&w: &f64| {
        let found = sphere.at_indentation(w)?;
        Some(ElasticContact { indentation: w, ..found })
    };
    let exact: Vec<Option<ElasticContact>> = plan.indentations.par_iter().map(exact).collect();
    let beside = |contact| alone.check.beside(contact, plan.radius, thickness);
    let errors = apart(exact.iter().flatten().map(beside));
    let [from, to] = match &errors[0][..] {
        [first, .., last] => [first.contact_ratio, last.contact_ratio],
        [only] => [only.contact_ratio; 2],
        [] => [f64::NAN; 2],
    };
    Ok(LayerResults {
        name: layer.name.clone(),
        thickness,
        rule: layer.rule,
        laws,
        exact,
        check: alone.check.findings(from, to),
        errors,
    })
}
