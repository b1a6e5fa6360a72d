//! Running `[coverage]`: both models on all windows of each process.

use std::time::Instant;

use super::plan::{CasePlan, CoveragePlan};
use super::results::{CaseResults, CoverageResults, LoadCoverage};
use crate::coverage::{Coverage, CoveredQuantity, QuantityEstimate, WindowTask, windows_of};
use asperity::numeric::median;
use asperity::{Heights, literature};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::{contact_metadata, papers_of};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;

pub(super) fn run(context: &RunContext, plan: &CoveragePlan) -> Result<CoverageResults, InputError> {
    let start = Instant::now();
    let steps = plan.windows.maps * plan.cases.len();
    context.progress.stage("maps", steps as f64);
    let cases = plan.cases.iter().map(|case| run_case(context, plan, case));
    let cases: Vec<CaseResults> = cases.collect::<Result<_, _>>()?;
    let laws = std::slice::from_ref(&plan.law);
    let mut papers = papers_of(laws);
    papers.push(literature::BUSING_1999);
    for case in cases.iter().filter(|case| case.heights != Heights::GAUSSIAN) {
        papers.extend(case.heights.papers());
    }
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    Ok(CoverageResults {
        metadata: context.metadata(papers, timing, None),
        contact: contact_metadata(context.materials, laws, &plan.bodies, None),
        law: plan.law.label.clone(),
        windows: plan.windows,
        cases,
    })
}

fn run_case(context: &RunContext, plan: &CoveragePlan, case: &CasePlan) -> Result<CaseResults, InputError> {
    let refuse = |error| InputError::file(&context.source.path, format!("case {}: {error}", case.name));
    let contact = &*plan.law.contact;
    let controls = case.process.controls(contact, &case.contacts).map_err(refuse)?;
    let task = WindowTask { contact, controls };
    let done = || context.progress.advance(1.0);
    let windows = windows_of(&case.process, &task, plan.windows.maps, done).map_err(refuse)?;
    let mut correlations: Vec<f64> = windows.iter().map(|window| window.correlation).collect();
    let coverage = |load: usize, (k, quantity): (usize, CoveredQuantity)| {
        let estimates = windows.iter().filter_map(|window| window.estimates[load][k]);
        Some((quantity, Coverage::new(&estimates.collect::<Vec<QuantityEstimate>>())?))
    };
    let controls = task.controls.loads.iter().zip(&task.controls.separations).enumerate();
    let loads = controls.map(|(index, (&load, &separation))| {
        let quantities = CoveredQuantity::ALL.into_iter().enumerate();
        LoadCoverage {
            load,
            separation,
            coverages: quantities.filter_map(|quantity| coverage(index, quantity)).collect(),
        }
    });
    Ok(CaseResults {
        name: case.name.clone(),
        roll_off: case.roll_off,
        heights: case.heights.clone(),
        correlation: median(&mut correlations).unwrap_or(f64::INFINITY) * plan.windows.side(),
        loads: loads.collect(),
    })
}
