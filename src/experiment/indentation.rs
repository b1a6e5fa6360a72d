//! Running `[indentation]`: one sphere on layered flats, and how good the rule of each layer is.

use std::time::Instant;

use indexmap::IndexMap;
use rayon::prelude::*;

use super::Refusal;
use super::plan::{IndentationPlan, LayerPlan, Plan};
use super::progress::Progress;
use super::results::{Head, Timing};
use super::run::head;
use super::spec::Show;
use crate::coating::{CoatingError, Rule};
use crate::compare::{GOOD_RATIO, RuleCheck, RuleError};
use crate::interface::Flat;
use crate::layered::{ElasticContact, LayeredSphere};
use crate::literature::{self, Paper};
use crate::material::{Material, reduced_modulus};
use crate::sphere::Curve;

/// a/R beyond which the sphere is no paraboloid and strains are not small.
pub const LARGEST_SLOPE: f64 = 0.3;

/// Where the errors of the rules are told, a/t.
const TOLD: [f64; 12] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0];

/// One sphere on layered flats.
#[derive(Debug)]
pub struct IndentationResults {
    /// What every experiment has.
    pub head: Head,
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
    /// Which way round the curves are drawn.
    pub show: Show,
    /// Layer by layer, thickness by thickness.
    pub layers: Vec<LayerResults>,
    /// Measured points, m and N, and their file in the words of the spec.
    pub overlay: Option<(String, Vec<(f64, f64)>)>,
}

/// One layer in one thickness.
#[derive(Debug)]
pub struct LayerResults {
    /// Its material.
    pub name: String,
    /// m.
    pub thickness: f64,
    /// How its modulus and that of the substrate are put together.
    pub rule: Rule,
    /// Law by law.
    pub laws: Vec<LawCurves>,
    /// The exact elastic contact at each indentation; `None` where it is too large to be solved.
    pub exact: Vec<Option<ElasticContact>>,
    /// Each rule against the exact contact.
    pub check: RuleFindings,
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
}

/// How wrong each of [`Rule::ALL`] is for a layer.
#[derive(Debug)]
pub struct RuleFindings {
    /// E_l/E_s.
    pub modulus_ratio: f64,
    /// Whether that lies where the paper's rule is good.
    pub is_good: bool,
    /// At the indentations that were asked for, as far as the exact contact is solved.
    pub errors: [Vec<RuleError>; 2],
    /// At round a/t within them.
    pub told: [Vec<RuleError>; 2],
    /// The largest within them.
    pub worst: [Option<RuleError>; 2],
}

impl IndentationResults {
    /// What makes the answers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for found in &self.layers {
            let layer = format!("layer {} of {} µm", found.name, short(1e6 * found.thickness));
            if !found.check.is_good {
                let [from, to] = GOOD_RATIO;
                let size = found.worst().map_or_else(String::new, |worst| {
                    let (ratio, at) = (short(worst.ratio), short(worst.contact_ratio));
                    let bound = if worst.ratio < 1.0 { "as little as" } else { "up to" };
                    format!(
                        "; without yielding its load is {bound} {ratio} times the exact one, at a/t = {at}"
                    )
                });
                warnings.push(format!(
                    "{layer}: E_l/E_s = {} lies outside {from} to {to}, where the paper's rule is good (here: {}){size}",
                    short(found.check.modulus_ratio),
                    found.rule.name()
                ));
            }
            let slope = found.largest_slope(self.radius);
            if slope > LARGEST_SLOPE {
                warnings.push(format!(
                    "{layer}: the contact radius reaches {slope:.2} of the ball's; beyond {LARGEST_SLOPE} the ball is no \
                     paraboloid and strains are not small"
                ));
            }
        }
        warnings
    }
}

/// To three digits.
fn short(value: f64) -> String {
    format!("{value:.2e}").parse::<f64>().unwrap_or(value).to_string()
}

impl LayerResults {
    /// The largest error of its own rule.
    pub fn worst(&self) -> Option<&RuleError> {
        let own = Rule::ALL.iter().position(|rule| *rule == self.rule)?;
        self.check.worst[own].as_ref()
    }

    /// a/R at the last indentation: the largest of all curves.
    pub fn largest_slope(&self, radius: f64) -> f64 {
        let last = |law: &LawCurves| law.coated.points.last().map(|point| point.contact.area);
        let areas = self.laws.iter().filter_map(last).map(|area| (area / std::f64::consts::PI).sqrt());
        let exact = self.exact.last().copied().flatten().map(|contact| contact.contact_radius);
        areas.chain(exact).fold(0.0, f64::max) / radius
    }
}

/// Runs the plan.
pub(super) fn run(
    plan: &Plan,
    indentation: &IndentationPlan,
    progress: &dyn Progress,
) -> Result<IndentationResults, Refusal> {
    let start = Instant::now();
    progress.stage(&plan.title, indentation.cases() as u64);
    let mut papers = vec![literature::PASARIBU_SCHIPPER_2005];
    let mut layers = Vec::new();
    for layer in &indentation.layers {
        for &thickness in &layer.thicknesses {
            let found = on_layer(indentation, layer, thickness, &mut papers)
                .map_err(|error| Refusal::file(&plan.source.path, error))?;
            layers.push(found);
            progress.advance(1);
        }
    }
    let overlay = &indentation.overlay;
    Ok(IndentationResults {
        head: head(plan, papers, Timing { total: start.elapsed(), ..Timing::default() }),
        materials: plan.materials.clone(),
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

fn on_layer(
    plan: &IndentationPlan,
    layer: &LayerPlan,
    thickness: f64,
    papers: &mut Vec<Paper>,
) -> Result<LayerResults, CoatingError> {
    let (ball, substrate) = (&plan.ball.1, &plan.flat.1);
    let coated = layer.on(substrate, thickness)?;
    let all_layer = Flat::AllLayer { substrate: *substrate, layer: layer.material };
    let measured = plan.overlay.iter().flat_map(|overlay| &overlay.points);
    let mut laws = Vec::new();
    for law in &plan.laws {
        let curve = |flat: &Flat| Curve::of(&*law.interface(ball, flat), plan.radius, &plan.indentations);
        let contact = law.interface(ball, &coated);
        papers.extend(contact.papers());
        laws.push(LawCurves {
            law: law.label(),
            coated: curve(&coated),
            uncoated: curve(&Flat::Bare(*substrate)),
            all_layer: curve(&all_layer),
            at_overlay: measured.clone().map(|(w, _)| contact.contact(*w, plan.radius).load).collect(),
        });
    }
    let sphere = LayeredSphere::new(Some(ball), plan.radius, &layer.material, substrate, thickness);
    let check = RuleCheck::new(ball, &layer.material, substrate)?;
    papers.extend(check.papers());
    let exact = |&w: &f64| {
        let found = sphere.at_indentation(w)?;
        Some(ElasticContact { indentation: w, ..found })
    };
    Ok(LayerResults {
        name: layer.name.clone(),
        thickness,
        rule: layer.rule,
        laws,
        exact: plan.indentations.par_iter().map(exact).collect(),
        check: findings(&check, plan, thickness),
    })
}

fn findings(check: &RuleCheck, plan: &IndentationPlan, thickness: f64) -> RuleFindings {
    let ratio = |w: f64| w / thickness * (plan.radius / thickness);
    let errors = Rule::ALL.map(|rule| {
        let at = |&w: &f64| check.at_indentation(rule, ratio(w));
        plan.indentations.par_iter().filter_map(at).collect::<Vec<RuleError>>()
    });
    let [from, to] = match &errors[0][..] {
        [first, .., last] => [first.contact_ratio, last.contact_ratio],
        [only] => [only.contact_ratio; 2],
        [] => [f64::NAN; 2],
    };
    let told = TOLD.into_iter().filter(|told| (from..=to).contains(told));
    RuleFindings {
        modulus_ratio: check.modulus_ratio(),
        is_good: check.is_good(),
        told: Rule::ALL.map(|rule| told.clone().filter_map(|told| check.at(rule, told)).collect()),
        worst: Rule::ALL.map(|rule| check.worst(rule, from, to)),
        errors,
    }
}
