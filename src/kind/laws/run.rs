//! Running `[laws]`: several laws on one asperity, and on surfaces under both models.

use std::f64::consts::PI;

use asperity::compare::{Difference, Dominance, Influence, Measure, UnderLaw};
use asperity::sphere::{Boundary, Curve, LARGEST_SLOPE, boundaries};
use asperity::study::{CaseStudy, LawContact};
use asperity::work::{CountedContact, Counter};
use asperity::{Contact, Paper};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;

use super::plan::{Critical, LawsPlan};
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::kind::compare::run_compare;

pub fn run(context: &RunContext, laws_plan: &LawsPlan) -> Result<LawsResults, InputError> {
    let counter = Counter::default();
    let mut compare = run_compare(context, &laws_plan.compare, &counter)?;
    let mut influences = Vec::new();
    for surface in &compare.surfaces {
        influences.extend((0..surface.realisations.len()).map(|index| {
            let realisation = index + 1;
            let influence = influence(&laws_plan.compare.study.laws, surface, index);
            let by = |measure| Dominance::new(&influence, measure);
            let dominances = Measure::ALL.into_iter().filter_map(by).collect();
            SurfaceInfluence { surface: surface.surface.name.clone(), realisation, influence, dominances }
        }));
    }
    let laws: Vec<LawOnAsperity> =
        laws_plan.compare.study.laws.iter().map(|law| on_asperity(laws_plan, law, &counter)).collect();
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

fn on_asperity(plan: &LawsPlan, law: &LawContact, counter: &Counter) -> LawOnAsperity {
    let contact = CountedContact::new(&*law.contact, counter);
    let shape = plan.shape(&law.spec);
    let indentations: Vec<f64> = plan.ratios.iter().map(|ratio| ratio * plan.critical.indentation).collect();
    LawOnAsperity {
        law: law.label.clone(),
        about: law.spec.about(),
        papers: law.spec.papers(),
        is_elastic_plastic: law.spec.has_ranges(),
        curve: Curve::new(&contact, shape, &indentations),
        boundaries: boundaries(&contact, shape),
    }
}

/// Of one realisation of a surface. Its sampling errors are those of the verdicts, which are of the mean over all
/// realisations.
fn influence(laws: &[LawContact], surface: &SurfaceResults, realisation: usize) -> Influence {
    let of_single = (surface.realisations.len() as f64).sqrt();
    let of_case = |case: &CaseStudy| {
        let mut differences = case.verdicts.differences.clone();
        for estimate in differences.iter_mut().flat_map(|at| &mut at.estimates).flatten() {
            estimate.error = estimate.error.map(|error| of_single * error);
        }
        differences
    };
    let differences: Vec<Vec<Difference>> = surface.cases.iter().map(of_case).collect();
    let cases = surface.cases.iter().map(|case| &case.realisations[realisation]).zip(&differences);
    let under = laws.iter().zip(cases).map(|(law, (case, differences))| UnderLaw {
        law: &case.law,
        is_elastic_plastic: law.spec.has_ranges(),
        pairs: &case.comparison.pairs,
        differences,
    });
    Influence::new(&under.collect::<Vec<_>>())
}

/// Several laws on one asperity and on surfaces.
#[derive(Debug)]
pub struct LawsResults {
    /// Both models on the surfaces under every law.
    pub compare: CompareResults,
    /// 1/(mean curvature) of the single asperity, m.
    pub radius: f64,
    /// Its larger principal curvature over the smaller one.
    pub curvature_ratio: f64,
    /// The unit of indentation, load and area.
    pub critical: Critical,
    /// Law by law; the others are compared with the first.
    pub laws: Vec<LawOnAsperity>,
    /// Surface by surface, realisation by realisation.
    pub influences: Vec<SurfaceInfluence>,
}

impl LawsResults {
    /// The effects on the first realisation of a surface.
    pub fn first_influence(&self, surface: &str) -> Option<&SurfaceInfluence> {
        self.influences.iter().find(|influence| influence.surface == surface)
    }

    /// Whether strains are not small in a contact on the single asperity: a/R is larger than [`LARGEST_SLOPE`].
    pub fn is_beyond_small_strains(&self, contact: &Contact) -> bool {
        (contact.area / PI).sqrt() / self.radius > LARGEST_SLOPE
    }

    /// The smallest indentation (m) of the single asperity at which strains are not small under one of the laws.
    pub fn end_of_small_strains(&self) -> Option<f64> {
        let end = |law: &LawOnAsperity| {
            let mut trace = law.curve.trace.iter();
            Some(trace.find(|point| self.is_beyond_small_strains(&point.contact))?.indentation)
        };
        self.laws.iter().filter_map(end).reduce(f64::min)
    }
}

/// The single asperity under one law.
#[derive(Debug)]
pub struct LawOnAsperity {
    /// The law, as tables name it.
    pub law: String,
    /// Description and range of validity, in one line.
    pub about: &'static str,
    pub papers: Vec<Paper>,
    /// Whether contacts under it pass from elastic to something else.
    pub is_elastic_plastic: bool,
    /// Load, area and regime against indentation.
    pub curve: Curve,
    pub boundaries: Vec<Boundary>,
}

/// Effect of contact law and summation method on one realisation of a surface.
#[derive(Debug)]
pub struct SurfaceInfluence {
    pub surface: String,
    /// From 1.
    pub realisation: usize,
    pub influence: Influence,
    /// Which of the two matters more: one per measure that allows a conclusion.
    pub dominances: Vec<Dominance>,
}
