//! Running `[coverage]`: both models on all windows of each process.

use std::time::Instant;

use super::plan::{CasePlan, CoveragePlan, SpikesPlan};
use super::results::{CaseResults, CoverageResults, LoadCoverage, SpikedResults, SpikesResults};
use super::spec::Intervals;
use crate::coverage::{
    CheckCount, Controls, Coverage, CoveredQuantity, ExaminedWindow, Maps, PlantedSpikes, QuantityEstimate,
    StudiedWindow, StudyTask, VerdictCount, WindowTask, WindowVerdict, checked_windows, spiked_windows,
    windows_of,
};
use asperity::compare::{ByQuantity, ComparedQuantity, Verdict};
use asperity::numeric::median;
use asperity::study::Choice;
use asperity::topography::fitness::{Check, Finding};
use asperity::{Heights, literature};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::{contact_metadata, papers_of};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;

pub(super) fn run(context: &RunContext, plan: &CoveragePlan) -> Result<CoverageResults, InputError> {
    let start = Instant::now();
    let steps: usize = plan.cases.iter().map(|case| case.maps.max(case.checked_maps)).sum();
    context.progress.stage("maps", steps as f64);
    let cases = plan.cases.iter().map(|case| run_case(context, plan, case));
    let cases: Vec<(CaseResults, Controls)> = cases.collect::<Result<_, _>>()?;
    let spikes = plan.spikes.as_ref().map(|spikes| run_spikes(context, plan, spikes, &cases)).transpose()?;
    let cases: Vec<CaseResults> = cases.into_iter().map(|(case, _)| case).collect();
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
        intervals: plan.intervals,
        cases,
        spikes,
    })
}

fn refuse(context: &RunContext, case: &CasePlan, error: impl std::fmt::Display) -> InputError {
    InputError::file(&context.source.path, format!("case {}: {error}", case.name))
}

fn run_case(
    context: &RunContext,
    plan: &CoveragePlan,
    case: &CasePlan,
) -> Result<(CaseResults, Controls), InputError> {
    let refuse = |error| refuse(context, case, error);
    let contact = &*plan.law.contact;
    let controls = case.process.controls(contact, &case.contacts).map_err(refuse)?;
    let study = StudyTask { law: &plan.law, loads: &controls.loads, seed: plan.seed };
    let small = (plan.intervals == Intervals::ModelBased).then_some(study);
    let task = WindowTask { contact: &*plan.conducting, controls: controls.clone(), small };
    // Pairs have no other treatments.
    let studied = if case.second.is_some() { 0 } else { plan.windows.studied_maps };
    let maps = Maps { count: case.maps, studied, checked: case.checked_maps };
    let done = || context.progress.advance(1.0);
    let windows = windows_of(&case.process, (&task, &study), maps, done).map_err(refuse)?;
    let mut findings: Vec<Vec<Finding>> = windows.iter().map(|window| window.findings.clone()).collect();
    findings.extend(checked_windows(&case.process, case.maps..case.checked_maps, done).map_err(refuse)?);
    let coverage = |load: usize, (k, quantity): (usize, CoveredQuantity)| {
        let estimates = windows.iter().filter_map(|window| window.results.estimates[load][k]);
        Some((quantity, Coverage::new(&estimates.collect::<Vec<QuantityEstimate>>())?))
    };
    let at_loads = controls.loads.iter().zip(&controls.separations).enumerate();
    let loads: Vec<LoadCoverage> = at_loads
        .map(|(index, (&load, &separation))| {
            let quantities = CoveredQuantity::ALL.into_iter().enumerate();
            LoadCoverage {
                load,
                separation,
                coverages: quantities.filter_map(|quantity| coverage(index, quantity)).collect(),
            }
        })
        .collect();
    Ok((case_results(plan, case, (&windows, &findings), loads), controls))
}

fn case_results(
    plan: &CoveragePlan,
    case: &CasePlan,
    (windows, findings): (&[ExaminedWindow], &[Vec<Finding>]),
    loads: Vec<LoadCoverage>,
) -> CaseResults {
    let mut correlations: Vec<f64> = windows.iter().map(|window| window.results.correlation).collect();
    let truths = truths(&loads);
    let all: Vec<Vec<WindowVerdict>> = windows.iter().map(|window| window.results.verdicts()).collect();
    let is_blocked = |window: &&ExaminedWindow| window.findings.iter().any(Finding::is_blocking);
    let studied: Vec<&ExaminedWindow> = windows.iter().filter(|window| window.studied.is_some()).collect();
    let of_studied = || studied.iter().filter_map(|window| window.studied.as_deref());
    let patchy = windows.iter().filter(|window| window.results.is_patchy).count();
    let on_halves = |verdict: &WindowVerdict| verdict.is_on_halves;
    CaseResults {
        name: case.name.clone(),
        intervals: plan.intervals,
        likely: count(all.iter().map(Vec::as_slice), &truths, |one| {
            is_likely(one.verdict) && !on_halves(one)
        }),
        far_beyond: count(all.iter().map(Vec::as_slice), &truths, on_halves),
        roll_off: case.roll_off,
        roughness: case.roughness(),
        heights: case.heights.clone(),
        windows: windows.len(),
        patchy: patchy as f64 / windows.len() as f64,
        correlation: median(&mut correlations).unwrap_or(f64::INFINITY) * plan.windows.side(),
        verdicts: count(all.iter().map(Vec::as_slice), &truths, |one| !is_likely(one.verdict)),
        studied: count(of_studied(), &truths, |_| true),
        robust: count(of_studied(), &truths, |verdict| verdict.depends_on.is_empty()),
        blocked: studied.iter().copied().filter(is_blocked).count(),
        checks: CheckCount::all(findings),
        loads,
    }
}

/// Whether a verdict is one of those that are very likely.
fn is_likely(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::VeryLikelyWithin | Verdict::VeryLikelyBeyond)
}

/// The mean differences of a process at each load.
fn truths(loads: &[LoadCoverage]) -> Vec<ByQuantity<Option<f64>>> {
    let truth = |load: &LoadCoverage, quantity: ComparedQuantity| {
        let of = CoveredQuantity::Difference(quantity);
        load.coverages.iter().find(|(covered, _)| *covered == of).map(|(_, coverage)| coverage.truth)
    };
    loads.iter().map(|load| ComparedQuantity::ALL.map(|quantity| truth(load, quantity))).collect()
}

fn count<'a>(
    windows: impl Iterator<Item = &'a [WindowVerdict]>,
    truths: &[ByQuantity<Option<f64>>],
    counted: impl Fn(&WindowVerdict) -> bool,
) -> VerdictCount {
    let mut count = VerdictCount::default();
    windows.for_each(|verdicts| count.add(verdicts, truths, &counted));
    count
}

fn run_spikes(
    context: &RunContext,
    plan: &CoveragePlan,
    spikes: &SpikesPlan,
    cases: &[(CaseResults, Controls)],
) -> Result<SpikesResults, InputError> {
    let case = &plan.cases[spikes.case];
    let (results, controls) = &cases[spikes.case];
    context.progress.stage("spikes", spikes.maps as f64);
    let study = StudyTask { law: &plan.law, loads: &controls.loads, seed: plan.seed };
    let done = || context.progress.advance(1.0);
    let windows = spiked_windows(&case.process, &study, spikes.maps, &spikes.planted, done)
        .map_err(|error| refuse(context, case, error))?;
    let truths = truths(&results.loads);
    let planted = std::iter::once(None).chain(spikes.planted.iter().copied().map(Some));
    let each = planted.enumerate().map(|(place, planted)| spiked(&windows, place, planted, &truths));
    Ok(SpikesResults { case: case.name.clone(), each: each.collect() })
}

/// The study at `place` of each window.
fn spiked(
    windows: &[Vec<StudiedWindow>],
    place: usize,
    planted: Option<PlantedSpikes>,
    truths: &[ByQuantity<Option<f64>>],
) -> SpikedResults {
    let is_found = |finding: &Finding| finding.check == Check::Spikes && !finding.has_passed();
    let of = || windows.iter().map(|window| &window[place]);
    let verdicts = || of().map(|window| window.verdicts.as_slice());
    SpikedResults {
        planted,
        found: of().filter(|window| window.findings.iter().any(is_found)).count(),
        verdicts: count(verdicts(), truths, |_| true),
        without_suspects: count(verdicts(), truths, |one| !one.depends_on.contains(&Choice::Spikes)),
        robust: count(verdicts(), truths, |one| one.depends_on.is_empty()),
    }
}
