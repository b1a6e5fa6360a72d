//! Running `[solver-validation]`.

use std::time::Instant;

use super::findings::SolverFindings;
use super::plan::{SinusoidTask, SolverPlan};
use crate::solver::ensemble::{EnsembleFindings, ensemble};
use crate::solver::published::ENSEMBLE;
use crate::solver::work::{WorkPoint, work};
use crate::solver::{
    LAYERED_CASES, Measured, Profile, Unsolved, full_contact, hertz, hertz_profile, layered, partial_contact,
    wave_profile,
};
use asperity::literature;
use asperity_framework::RunContext;
use asperity_framework::input::InputError;
use asperity_framework::metadata::{Metadata, Timing};

/// Points per wavelength of the pressures in a figure, if the spec has no fewer.
const PROFILE_POINTS: usize = 64;

/// Comparisons of the solver.
#[derive(Debug)]
pub struct SolverResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// Problems with a known solution, problem by problem, resolution by resolution.
    pub measured: Vec<Measured>,
    /// Hertz's pressures on the coarsest grid.
    pub hertz_profile: Option<Profile>,
    /// Pressures of a wave, load by load.
    pub wave_profiles: Vec<Profile>,
    pub ensemble: Option<EnsembleFindings>,
    pub work: Vec<WorkPoint>,
    /// Dual gap of the contacts whose work is counted.
    pub work_error: Option<f64>,
    pub findings: SolverFindings,
}

impl SolverResults {
    /// Warnings, a line each.
    pub fn warnings(&self) -> Vec<String> {
        self.findings.warnings(&self.measured)
    }
}

pub(super) fn run(context: &RunContext, plan: &SolverPlan) -> Result<SolverResults, InputError> {
    let start = Instant::now();
    let refuse = |error: Unsolved| InputError::file(&context.source.path, error);
    let (measured, hertz_profile, wave_profiles) = known(context, plan).map_err(refuse)?;
    let ensemble = plan.ensemble.as_ref().map(|task| {
        let contacts = task.points.len() * task.realisations * task.pressures.len();
        context.progress.stage("ensemble", contacts as f64);
        let seed = |realisation: usize| context.stream_seed(&format!("solver ensemble {realisation}"));
        ensemble(&ENSEMBLE, task, seed, context.progress)
    });
    let ensemble = ensemble.transpose().map_err(refuse)?;
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
        findings: SolverFindings::of(&measured, ensemble.as_ref(), &work),
        measured,
        hertz_profile,
        wave_profiles,
        ensemble,
        work,
        work_error: plan.work.as_ref().map(|task| task.error),
    })
}

type Known = (Vec<Measured>, Option<Profile>, Vec<Profile>);

/// The problems whose solution is known.
fn known(context: &RunContext, plan: &SolverPlan) -> Result<Known, Unsolved> {
    let (mut measured, mut waves) = (Vec::new(), Vec::new());
    let done = || context.progress.advance(1.0);
    context
        .progress
        .stage("spheres", (plan.hertz.len() + plan.layered.map_or(0, |_| LAYERED_CASES.len())) as f64);
    for &pixels in &plan.hertz {
        measured.extend(hertz(pixels)?);
        done();
    }
    let hertz_profile = plan.hertz.first().map(|&pixels| hertz_profile(pixels)).transpose()?;
    if let Some(pixels) = plan.layered {
        for case in &LAYERED_CASES {
            measured.extend(layered(case, pixels)?);
            done();
        }
    }
    if let Some(SinusoidTask { points, shares }) = &plan.sinusoid {
        context.progress.stage("waves", (points.len() * shares.len()) as f64);
        for &count in points {
            for &share in shares {
                measured.extend(partial_contact(count, share)?);
                done();
            }
        }
        let of_figure =
            points.iter().copied().find(|&count| count >= PROFILE_POINTS).or(points.last().copied());
        for (&share, count) in shares.iter().zip(std::iter::repeat(of_figure)) {
            waves.extend(count.map(|count| wave_profile(count, share)).transpose()?);
        }
        measured.extend(full_contact()?);
    }
    Ok((measured, hertz_profile, waves))
}
