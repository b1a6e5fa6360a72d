//! Running `[laws]`: several laws on one asperity, and on surfaces under both models.

use super::plan::{Critical, LawsPlan};
use crate::kind::compare::results::{CompareResults, RealisationResults};
use crate::kind::compare::run_compare;
use asperity::compare::{Influence, UnderLaw};
use asperity::interface::Counted;
use asperity::literature::Paper;
use asperity::sphere::{Boundary, Curve, boundaries};
use asperity::work::Counter;
use asperity_framework::RunContext;
use asperity_framework::contact::LawPlan;
use asperity_framework::input::InputError;

/// Several laws on one asperity and on surfaces.
#[derive(Debug)]
pub struct LawsResults {
    /// Both models on the surfaces under every law.
    pub compare: CompareResults,
    /// 1/(mean curvature) of the one asperity, m.
    pub radius: f64,
    /// Its larger principal curvature over the smaller one.
    pub curvature_ratio: f64,
    /// The unit of indentation, load and area.
    pub critical: Critical,
    /// Law by law; the others are compared with the first.
    pub laws: Vec<LawOnOne>,
    /// Surface by surface, realisation by realisation.
    pub influences: Vec<SurfaceInfluence>,
}

/// The one asperity under one law.
#[derive(Debug)]
pub struct LawOnOne {
    /// The law, as tables name it.
    pub law: String,
    /// What it is and where it holds, in a line.
    pub about: &'static str,
    /// Its papers.
    pub papers: Vec<Paper>,
    /// Whether contacts under it pass from elastic to something else.
    pub passes_regimes: bool,
    /// Load, area and regime against indentation.
    pub curve: Curve,
    /// Where one formula gives way to another.
    pub boundaries: Vec<Boundary>,
}

/// How much law and adding-up matter on one realisation of a surface.
#[derive(Debug)]
pub struct SurfaceInfluence {
    /// The surface.
    pub surface: String,
    /// From 1.
    pub realisation: usize,
    /// The numbers.
    pub influence: Influence,
}

pub(super) fn run(context: &RunContext, laws_plan: &LawsPlan) -> Result<LawsResults, InputError> {
    let counter = Counter::default();
    let mut compare = run_compare(context, &laws_plan.compare, &counter)?;
    let mut influences = Vec::new();
    for found in &compare.surfaces {
        influences.extend(found.realisations().map(|(realisation, answered)| SurfaceInfluence {
            surface: found.surface.name.clone(),
            realisation,
            influence: influence(&laws_plan.compare.laws, answered),
        }));
    }
    let laws = laws_plan.compare.laws.iter().map(|law| on_one(laws_plan, law, &counter)).collect();
    compare.metadata.work = Some(counter.work());
    Ok(LawsResults {
        compare,
        radius: laws_plan.radius,
        curvature_ratio: laws_plan.curvature_ratio,
        critical: laws_plan.critical,
        laws,
        influences,
    })
}

fn on_one(plan: &LawsPlan, law: &LawPlan, counter: &Counter) -> LawOnOne {
    let contact = Counted::new(&*law.contact, counter);
    let shape = plan.shape(&law.spec);
    let indentations: Vec<f64> = plan.ratios.iter().map(|ratio| ratio * plan.critical.indentation).collect();
    LawOnOne {
        law: law.label.clone(),
        about: law.spec.about(),
        papers: law.spec.papers(),
        passes_regimes: law.spec.has_ranges(),
        curve: Curve::of(&contact, shape, &indentations),
        boundaries: boundaries(&contact, shape),
    }
}

fn influence(laws: &[LawPlan], answered: &RealisationResults) -> Influence {
    let under = laws.iter().zip(&answered.cases).map(|(law, case)| UnderLaw {
        law: &case.law,
        passes_regimes: law.spec.has_ranges(),
        pairs: &case.comparison.pairs,
    });
    Influence::of(&under.collect::<Vec<_>>(), answered.nominal_area, answered.sigma)
}
