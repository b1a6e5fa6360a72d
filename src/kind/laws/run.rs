//! Running `[laws]`: several laws on one asperity, and on surfaces under both models.

use super::plan::LawsPlan;
use super::results::{LawOnAsperity, LawsResults, SurfaceInfluence};
use crate::kind::compare::results::SurfaceResults;
use crate::kind::compare::run_compare;
use asperity::compare::{Difference, Dominance, Influence, Measure, UnderLaw};
use asperity::sphere::{Curve, boundaries};
use asperity::study::CaseStudy;
use asperity::study::LawContact;
use asperity::work::{CountedContact, Counter};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;

/// Runs it.
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
