//! Running `[precision]`: run time against error.

use std::fmt::Display;
use std::time::Instant;

use rayon::ThreadPoolBuilder;

use super::plan::PrecisionPlan;
use crate::precision::Case;
use crate::precision::integral::{IntegralPoint, integrals};
use crate::precision::reference::{ReferencePoint, contacts};
use crate::precision::sum::{SumPoint, sums};
use crate::precision::surface::{SurfacePoint, maps};
use crate::stability::exact::Exact;
use asperity::literature;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::{ContactMetadata, contact_metadata, papers_of};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Metadata, Timing};

/// What integrals, sums, surfaces and boundary elements cost, and how exact they are; empty where the spec does not request them.
#[derive(Debug)]
pub struct PrecisionResults {
    /// What every experiment has.
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The law, as tables name it.
    pub law: String,
    pub cases: Vec<Case>,
    /// d/sigma of the integrals.
    pub separations: Vec<f64>,
    /// Case by case, rule by rule.
    pub integrals: Vec<IntegralPoint>,
    /// Case by case, size by size, method by method.
    pub sums: Vec<SumPoint>,
    /// Grid by grid, size by size.
    pub maps: Vec<SurfacePoint>,
    /// Grid by grid.
    pub contacts: Vec<ReferencePoint>,
    /// Threads that maps and boundary elements use.
    pub threads: usize,
}

pub(super) fn run(context: &RunContext, plan: &PrecisionPlan) -> Result<PrecisionResults, InputError> {
    let refuse = |error: &dyn Display| InputError::file(&context.source.path, error);
    let start = Instant::now();
    let mut timing = Timing::default();
    context.progress.stage("errors and times", plan.steps() as f64);
    let step = || context.progress.advance(1.0);
    let contact = &*plan.law.contact;
    let (mut integrals_of_all, mut sums_of_all) = (Vec::new(), Vec::new());
    let single = ThreadPoolBuilder::new().num_threads(1).build();
    let single = single.map_err(|error| refuse(&format!("the system gives no thread: {error}")))?;
    for case in &plan.cases {
        let refuse = |error: &dyn Display| refuse(&format!("case {}: {error}", case.name));
        let of_case = Instant::now();
        if !plan.separations.is_empty() {
            let points = integrals(contact, &Exact::new(&plan.exact), case, &plan.separations);
            integrals_of_all.extend(points.ok_or_else(|| {
                refuse(&"the reference integral does not settle in 32 digits; allowed: numbers nearer to those of real surfaces")
            })?);
            step();
        }
        timing.statistical += of_case.elapsed();
        let of_case = Instant::now();
        for &count in &plan.counts {
            let seed = context.stream_seed(&format!("sum {} {count}", case.name));
            let points = single.install(|| sums(contact, case, count, seed));
            sums_of_all.extend(points.map_err(|error| refuse(&error))?);
            step();
        }
        timing.deterministic += of_case.elapsed();
    }
    let of_maps = Instant::now();
    let seed = |[i, j]: [usize; 2], k| context.stream_seed(&format!("grid {i} {j} {k}"));
    let maps = plan.surface.as_ref().map(|task| maps(task, seed, step)).transpose();
    let maps = maps.map_err(|error| refuse(&error))?.unwrap_or_default();
    timing.generate = of_maps.elapsed();
    let contacts = contacts(&plan.pixels).map_err(|error| refuse(&error))?;
    timing.total = start.elapsed();
    let laws = std::slice::from_ref(&plan.law);
    let mut papers = papers_of(laws);
    if !maps.is_empty() {
        papers.extend([literature::GREENWOOD_1984, literature::NAYAK_1971]);
    }
    Ok(PrecisionResults {
        // What is timed is repeated until the clock is content: a count would differ from run to run.
        metadata: context.metadata(papers, timing, None),
        contact: contact_metadata(context.materials, laws, &plan.bodies, None),
        law: plan.law.label.clone(),
        cases: plan.cases.clone(),
        separations: plan.separations.clone(),
        integrals: integrals_of_all,
        sums: sums_of_all,
        maps,
        contacts,
        threads: rayon::current_num_threads(),
    })
}
