//! Running `[solver-validation]`.

use std::time::Instant;

use super::plan::{SinusoidTask, SolverPlan};
use super::results::SolverResults;
use crate::solver::ensemble::ensemble;
use crate::solver::grid::{GridCase, grid_errors};
use crate::solver::work::work;
use crate::solver::{
    Benchmark, LAYERED_CASES, Profile, Unsolved, full_contact, hertz, hertz_profile, layered,
    partial_contact, wave_profile,
};
use asperity::literature;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;

/// Points per wavelength of the pressures in a figure, if the spec has no fewer.
const PROFILE_POINTS: usize = 64;

pub(super) fn run(context: &RunContext, plan: &SolverPlan) -> Result<SolverResults, InputError> {
    let start = Instant::now();
    let refuse = |error: Unsolved| InputError::file(&context.source.path, error);
    let (benchmarks, hertz_profile, wave_profiles) = known(context, plan).map_err(refuse)?;
    let ensemble = plan.ensemble.as_ref().map(|task| {
        let contacts = task.points.len() * task.realisations * task.pressures.len();
        context.progress.stage("ensemble", contacts as f64);
        let seed = |realisation: usize| context.stream_seed(&format!("solver ensemble {realisation}"));
        ensemble(task, seed, context.progress)
    });
    let ensemble = ensemble.transpose().map_err(refuse)?;
    let grid = plan.grid.as_ref().map(|task| {
        context.progress.stage("grids", (GridCase::ALL.len() * task.realisations) as f64);
        let seed = |realisation: usize| context.stream_seed(&format!("solver grid {realisation}"));
        grid_errors(task, seed, context.progress)
    });
    let grid = grid.transpose().map_err(refuse)?.unwrap_or_default();
    let contacts = plan.work.as_ref().map(|task| {
        context.progress.stage("work", (task.points.len() * task.pressures.len()) as f64);
        work(task, context.stream_seed("solver work"), context.progress)
    });
    let work = contacts.transpose().map_err(refuse)?.unwrap_or_default();
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    let mut papers = vec![literature::POLONSKY_KEER_1999, literature::YASTREBOV_2017];
    papers.extend((!plan.hertz.is_empty()).then_some(literature::JOHNSON_1985));
    papers.extend(plan.sinusoid.as_ref().map(|_| literature::JOHNSON_GREENWOOD_HIGGINSON_1985));
    papers.extend(plan.layered.map(|_| literature::PERRIOT_BARTHEL_2004));
    if ensemble.is_some() {
        papers.extend([literature::XU_2024, literature::PERSSON_2001, literature::BUSH_GIBSON_THOMAS_1975]);
    }
    Ok(SolverResults {
        metadata: context.metadata(papers, timing, None),
        benchmarks,
        hertz_profile,
        wave_profiles,
        ensemble,
        grid,
        work,
    })
}

type Known = (Vec<Benchmark>, Option<Profile>, Vec<Profile>);

/// The problems whose solution is known.
fn known(context: &RunContext, plan: &SolverPlan) -> Result<Known, Unsolved> {
    let mut benchmarks = Vec::new();
    let mut extend = |more: Vec<Benchmark>| {
        benchmarks.extend(more);
        context.progress.advance(1.0);
    };
    let layered_cases = plan.layered.map_or(0, |_| LAYERED_CASES.len());
    context.progress.stage("spheres", (plan.hertz.len() + layered_cases) as f64);
    for &pixels in &plan.hertz {
        extend(hertz(pixels)?);
    }
    for (case, pixels) in LAYERED_CASES.iter().zip(plan.layered.into_iter().cycle()) {
        extend(layered(case, pixels)?);
    }
    let hertz_profile = plan.hertz.first().map(|&pixels| hertz_profile(pixels)).transpose()?;
    let Some(SinusoidTask { points, shares }) = &plan.sinusoid else {
        return Ok((benchmarks, hertz_profile, Vec::new()));
    };
    context.progress.stage("waves", (points.len() * shares.len()) as f64);
    for &count in points {
        for &share in shares {
            extend(partial_contact(count, share)?);
        }
    }
    benchmarks.extend(full_contact()?);
    let in_figure = points.iter().find(|&&count| count >= PROFILE_POINTS).or(points.last());
    let profiles = in_figure.into_iter().flat_map(|&count| shares.iter().map(move |&share| (count, share)));
    let wave_profiles =
        profiles.map(|(count, share)| wave_profile(count, share)).collect::<Result<_, _>>()?;
    Ok((benchmarks, hertz_profile, wave_profiles))
}
