//! Running `[coverage]`: both models on all windows of each process.

use std::time::Instant;

use super::findings::{CoverageFindings, LoadCoverage};
use super::plan::{CasePlan, CoveragePlan, WindowPlan};
use crate::coverage::{Coverage, Found, Quantity, WindowFindings, WindowTask, windows_of};
use asperity::{Heights, literature};
use asperity_framework::RunContext;
use asperity_framework::contact::{ContactMetadata, contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::metadata::{Metadata, Timing};

/// Coverage of intervals in every case.
#[derive(Debug)]
pub struct CoverageResults {
    /// What every experiment has.
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The law, as tables name it.
    pub law: String,
    /// What all cases share.
    pub windows: WindowPlan,
    pub cases: Vec<CaseCoverage>,
    pub findings: CoverageFindings,
}

/// One process.
#[derive(Debug, Clone)]
pub struct CaseCoverage {
    /// Its name in the spec.
    pub name: String,
    /// Longest wavelength of the power law, m.
    pub roll_off: f64,
    pub heights: Heights,
    /// Median over the windows of the larger correlation length of x and y, m; infinite where that of most does not decay.
    pub correlation: f64,
    pub loads: Vec<LoadCoverage>,
}

impl CoverageResults {
    /// Warnings, a line each.
    pub fn warnings(&self) -> Vec<String> {
        self.findings.warnings(&self.cases)
    }
}

pub(super) fn run(context: &RunContext, plan: &CoveragePlan) -> Result<CoverageResults, InputError> {
    let start = Instant::now();
    let steps = plan.windows.maps * plan.cases.len();
    context.progress.stage("maps", steps as f64);
    let cases = plan.cases.iter().map(|case| of_case(context, plan, case));
    let cases: Vec<CaseCoverage> = cases.collect::<Result<_, _>>()?;
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
        findings: CoverageFindings::of(&cases),
        cases,
    })
}

fn of_case(context: &RunContext, plan: &CoveragePlan, case: &CasePlan) -> Result<CaseCoverage, InputError> {
    let refuse = |error| InputError::file(&context.source.path, format!("case {}: {error}", case.name));
    let contact = &*plan.law.contact;
    let controls = case.process.controls(contact, &case.contacts).map_err(refuse)?;
    let task = WindowTask { contact, controls };
    let done = || context.progress.advance(1.0);
    let windows = windows_of(&case.process, &task, plan.windows.maps, done).map_err(refuse)?;
    let mut correlations: Vec<f64> = windows.iter().map(|window| window.correlation).collect();
    correlations.sort_by(f64::total_cmp);
    let controls = task.controls.loads.iter().zip(&task.controls.separations).enumerate();
    let loads = controls.map(|(index, (&load, &separation))| LoadCoverage {
        load,
        separation,
        coverages: Quantity::ALL.map(|quantity| coverage(&windows, index, quantity)),
    });
    Ok(CaseCoverage {
        name: case.name.clone(),
        roll_off: case.roll_off,
        heights: case.heights.clone(),
        correlation: correlations[correlations.len() / 2] * plan.windows.side(),
        loads: loads.collect(),
    })
}

fn coverage(windows: &[WindowFindings], load: usize, quantity: Quantity) -> Option<Coverage> {
    let place = Quantity::ALL.iter().position(|one| *one == quantity)?;
    let found: Vec<Found> = windows.iter().filter_map(|window| window.found[load][place]).collect();
    Coverage::of(&found)
}
