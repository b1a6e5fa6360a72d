//! Running `[precision]`: run time against error.

use std::time::Instant;

use super::findings::CaseFindings;
use super::plan::PrecisionPlan;
use crate::precision::attribution::{AttributionFindings, attributions_on};
use crate::precision::curve::{CurveFindings, curves_of};
use crate::precision::grid::{GridFindings, maps_of};
use crate::precision::integral::{IntegralFindings, rules_on};
use crate::precision::list::{ListPoint, lists_of};
use crate::precision::sampling::{SamplingFindings, sets_of};
use crate::precision::sum::{SumPoint, ways_on};
use crate::stability::exact::Exact;
use asperity::{Population, literature, plasticity_index};
use asperity_framework::RunContext;
use asperity_framework::contact::{contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::{
    contact::ContactMetadata,
    metadata::{Metadata, Timing},
};

/// What integrals, sums and surfaces cost, and how exact they are.
#[derive(Debug)]
pub struct PrecisionResults {
    /// What every experiment has.
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The law, as tables name it.
    pub law: String,
    /// d/sigma of the integrals.
    pub separations: Vec<f64>,
    /// Random sets of each size.
    pub draws: usize,
    /// Population by population.
    pub cases: Vec<CasePrecision>,
    /// Random maps, if the spec requests them.
    pub grid: Option<GridFindings>,
    /// Whether the largest sizes were run.
    pub full: bool,
    /// Threads that the program uses by default.
    pub threads: usize,
}

#[derive(Debug)]
pub struct CasePrecision {
    /// Its name in the spec.
    pub name: String,
    /// Its numbers.
    pub population: Population,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Rules of quadrature, if the spec requests them.
    pub integral: Option<IntegralFindings>,
    /// Summation methods; empty unless the spec requests them.
    pub sums: Vec<SumPoint>,
    /// Curves within a tolerance, if the spec requests them.
    pub curve: Option<CurveFindings>,
    /// Lists in files, shortest first; empty unless the spec requests them.
    pub lists: Vec<ListPoint>,
    /// The difference divided among its causes, if the spec requests it.
    pub attribution: Option<AttributionFindings>,
    /// Random sets, if the spec requests them.
    pub sampling: Option<SamplingFindings>,
    /// Findings over rules and sums.
    pub findings: CaseFindings,
}

pub(super) fn run(context: &RunContext, all: &PrecisionPlan) -> Result<PrecisionResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    context.progress.stage("errors and times", all.steps() as f64);
    let mut cases = Vec::new();
    for (name, population) in &all.cases {
        cases.push(case(context, all, name, population, &mut timing)?);
    }
    let maps = Instant::now();
    let refuse = |error: &dyn std::fmt::Display| InputError::file(&context.source.path, error);
    let seed = |i, j, k| context.stream_seed(&format!("grid {i} {j} {k}"));
    let grid = all.grid.as_ref().map(|task| maps_of(task, seed, |_| context.progress.advance(1.0)));
    let grid = grid.transpose().map_err(|error| refuse(&error))?;
    timing.generate = maps.elapsed();
    timing.total = start.elapsed();
    let laws = std::slice::from_ref(&all.law);
    let mut papers = papers_of(laws);
    if grid.is_some() {
        papers.extend([literature::GREENWOOD_1984, literature::NAYAK_1971]);
    }
    Ok(PrecisionResults {
        // What is timed is repeated until the clock is content: a count would differ from run to run.
        metadata: context.metadata(papers, timing, None),
        contact: contact_metadata(context.materials, laws, &all.bodies, None),
        law: all.law.label.clone(),
        separations: all.separations.clone(),
        draws: all.sampling.as_ref().map_or(0, |task| task.draws),
        cases,
        grid,
        full: all.full,
        threads: rayon::current_num_threads(),
    })
}

fn case(
    context: &RunContext,
    all: &PrecisionPlan,
    name: &str,
    population: &Population,
    timing: &mut Timing,
) -> Result<CasePrecision, InputError> {
    let contact = &*all.law.contact;
    let refuse = |error: &dyn std::fmt::Display| {
        InputError::file(&context.source.path, format!("case {name}: {error}"))
    };
    let start = Instant::now();
    let mut integral = None;
    if !all.separations.is_empty() {
        let exact = Exact::new(&all.exact);
        let found = rules_on(contact, &exact, population, &all.separations);
        integral = Some(found.ok_or_else(|| {
            refuse(&"the reference integral does not settle in 32 digits; allowed: numbers nearer to those of real surfaces")
        })?);
        context.progress.advance(1.0);
    }
    timing.statistical += start.elapsed();
    let start = Instant::now();
    let mut sums = Vec::new();
    if let Some(task) = &all.sum {
        let seed = |count| context.stream_seed(&format!("sum {name} {count}"));
        sums = ways_on(contact, population, task, seed, |_| context.progress.advance(1.0))
            .map_err(|error| refuse(&error))?;
    }
    let seed = context.stream_seed(&format!("curve {name}"));
    let curve = all.curve.as_ref().map(|task| curves_of(contact, population, task, seed));
    let curve = curve.transpose().map_err(|error| refuse(&error))?;
    if curve.is_some() {
        context.progress.advance(1.0);
    }
    let seed = |count| context.stream_seed(&format!("list {name} {count}"));
    let lists = all
        .list
        .as_ref()
        .map(|task| lists_of(contact, population, task, seed, |_| context.progress.advance(1.0)));
    let lists = lists.transpose().map_err(|error| refuse(&error))?.unwrap_or_default();
    let seed = |what: &str| context.stream_seed(&format!("attribution {name} {what}"));
    let bodies = (&all.exact.rough, &all.exact.flat);
    let done = || context.progress.advance(1.0);
    let attribution =
        all.attribution.as_ref().map(|task| attributions_on(contact, bodies, population, task, seed, done));
    let attribution = attribution.transpose().map_err(|error| refuse(&error))?;
    let seed = |count, draw| context.stream_seed(&format!("sampling {name} {count} {draw}"));
    let sets = all
        .sampling
        .as_ref()
        .map(|task| sets_of(contact, population, task, seed, |_| context.progress.advance(1.0)));
    let sampling = sets.transpose().map_err(|error| refuse(&error))?;
    timing.deterministic += start.elapsed();
    Ok(CasePrecision {
        name: name.to_owned(),
        population: population.clone(),
        plasticity_index: plasticity_index(contact, population.sigma, population.radius),
        findings: CaseFindings::of(integral.as_ref(), &sums),
        integral,
        sums,
        curve,
        lists,
        attribution,
        sampling,
    })
}
