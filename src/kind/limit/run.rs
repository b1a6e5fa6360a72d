//! Running `[limit]`: sets of growing size against the statistical integral.

use std::time::Instant;

use asperity::compare::{ErrorSlope, Exact, LimitCase, LimitPoint, convergence};
use asperity::work::{CountedContact, Counter, Item};
use asperity::{MicroContact, Model, Statistical, plasticity_index};
use asperity_framework::RunContext;
use asperity_framework::contact::{ContactMetadata, contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::metadata::{Metadata, Timing};

use super::plan::{LimitPlan, SetsPlan};

/// Sets of growing size against their limit.
#[derive(Debug)]
pub struct LimitResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The laws, as tables name them.
    pub laws: Vec<String>,
    pub sets: SetsPlan,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
    pub slopes: Vec<ErrorSlope>,
}

/// Draws the sets and compares them with their limit.
pub(super) fn run(context: &RunContext, plan: &LimitPlan) -> Result<LimitResults, InputError> {
    let start = Instant::now();
    let SetsPlan { population, separations, counts, draws } = &plan.sets;
    let counter = Counter::default();
    let counted = |law| CountedContact::new(law, &counter);
    let contacts: Vec<_> = plan.laws.iter().map(|law| counted(&*law.contact)).collect();
    context.progress.stage("integrals", contacts.len() as f64);
    let mut cases = Vec::new();
    for (law, contact) in plan.laws.iter().zip(&contacts) {
        let limit = |integral| match law.spec.is_greenwood_williamson() {
            true => Exact::greenwood_williamson(integral, population, contact.reference_modulus()),
            false => Exact::of_integral(integral, population.density),
        };
        let integrals = Statistical::new(contact, population.clone()).respond_all(separations);
        let exact = integrals.into_iter().map(limit).collect();
        cases.push(LimitCase { law: law.label.clone(), contact, exact });
        context.progress.advance(1.0);
    }
    let statistical = start.elapsed();
    let asperities = counts.iter().sum::<usize>() * (draws + 1);
    context.progress.stage("random sets", asperities as f64);
    let seed = |count, draw| context.stream_seed(&format!("limit {count} {draw}"));
    let points = convergence(&cases, population, counts, *draws, seed, |count| {
        counter.add(Item::Surfaces, 1);
        context.progress.advance(count as f64);
    })
    .map_err(|error| InputError::file(&context.source.path, error))?;
    let total = start.elapsed();
    let timing = Timing { statistical, deterministic: total - statistical, total, ..Timing::default() };
    Ok(LimitResults {
        metadata: context.metadata(papers_of(&plan.laws), timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &plan.laws, &plan.bodies, None),
        laws: plan.laws.iter().map(|law| law.label.clone()).collect(),
        plasticity_index: plasticity_index(&contacts[0], population.sigma, population.radius),
        sets: plan.sets.clone(),
        slopes: ErrorSlope::all(&points),
        points,
    })
}
