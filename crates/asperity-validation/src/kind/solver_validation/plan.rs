//! Problems and resolutions, checked.

use std::fmt;
use std::ops::RangeInclusive;

use super::spec::{EnsembleSpec, SinusoidSpec, SolverSpec, WorkSpec};
use crate::solver::LAYERED_CASES;
use crate::solver::ensemble::EnsembleTask;
use crate::solver::published::ENSEMBLE;
use crate::solver::work::WorkTask;
use asperity::bem::{Boundary, Options, Solver};
use asperity_framework::input::Spanned;
use asperity_framework::input::quantity::{Pure, Quantity};
use asperity_framework::input::sweep::LogSweep;
use asperity_framework::input::{InputError, SpecFile};

/// Pixels per contact radius: fewer show no circle.
const PIXELS: RangeInclusive<f64> = 4.0..=400.0;
/// Points per wavelength.
const WAVE_POINTS: RangeInclusive<f64> = 8.0..=16384.0;
/// Pressure over that which closes the gap of a wave.
const SHARES: RangeInclusive<f64> = 1e-4..=0.9999;
/// Points along the side of a rough surface.
const SURFACE_POINTS: RangeInclusive<f64> = 64.0..=8192.0;
/// Pressures on a rough surface, over E* or over E* g.
const PRESSURES: RangeInclusive<f64> = 1e-6..=10.0;

/// What is run.
pub struct SolverPlan {
    /// Pixels per contact radius of Hertz's contact.
    pub hertz: Vec<usize>,
    pub sinusoid: Option<SinusoidTask>,
    /// Pixels per contact radius of the spheres on a layer.
    pub layered: Option<usize>,
    pub ensemble: Option<EnsembleTask>,
    pub work: Option<WorkTask>,
}

/// A wave in partial contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SinusoidTask {
    /// Points per wavelength, ascending.
    pub points: Vec<usize>,
    /// p/p*.
    pub shares: Vec<f64>,
}

impl SolverPlan {
    /// Bytes of the largest map and its solver.
    pub fn memory(&self) -> u128 {
        /// Sides of a map over the contact radius, in halves.
        const SIDE: (usize, usize) = (5, 2);
        let spheres = self.hertz.iter().chain(&self.layered).map(|pixels| {
            let points = (SIDE.0 * pixels).div_ceil(SIDE.1);
            (points, Boundary::Finite)
        });
        let of_ensemble = self.ensemble.iter().flat_map(|task| &task.points);
        let of_work = self.work.iter().flat_map(|task| &task.points);
        let rough = of_ensemble.chain(of_work).map(|&points| (points, Boundary::Periodic));
        let bytes = spheres.chain(rough).map(|(points, boundary)| {
            // The map, and its heights before they are scaled.
            16 * (points * points) as u128 + Solver::memory([points; 2], boundary)
        });
        bytes.max().unwrap_or(0)
    }

    /// Points of all maps that are solved, times the convolutions of each: about as many micro-contacts would take as long.
    pub fn work(&self) -> u128 {
        const CONVOLUTIONS: u128 = 50;
        let square = |points: &usize| (points * points) as u128;
        let spheres = self.hertz.iter().map(|pixels| 25 * square(pixels)).sum::<u128>()
            + self
                .layered
                .iter()
                .map(|pixels| 25 * LAYERED_CASES.len() as u128 * square(pixels))
                .sum::<u128>();
        let ensemble = self.ensemble.iter().map(|task| {
            let contacts = (task.realisations * task.pressures.len()) as u128;
            contacts * task.points.iter().map(square).sum::<u128>()
        });
        let work = self
            .work
            .iter()
            .map(|task| task.pressures.len() as u128 * task.points.iter().map(square).sum::<u128>());
        CONVOLUTIONS * (spheres + ensemble.sum::<u128>() + work.sum::<u128>())
    }
}

impl fmt::Display for SolverPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if !self.hertz.is_empty() {
            writeln!(f, "  Hertz at {:?} pixels per contact radius", self.hertz)?;
        }
        if let Some(task) = &self.sinusoid {
            writeln!(
                f,
                "  a wave of {:?} points at {:?} p*, and waves in full contact",
                task.points, task.shares
            )?;
        }
        if let Some(pixels) = self.layered {
            writeln!(
                f,
                "  {} spheres on a layer at {pixels} pixels per contact radius",
                LAYERED_CASES.len()
            )?;
        }
        if let Some(task) = &self.ensemble {
            let EnsembleTask { points, realisations, pressures, .. } = task;
            let loads = pressures.len();
            writeln!(
                f,
                "  {realisations} surfaces of the published ensemble on {points:?} points a side, {loads} loads"
            )?;
        }
        if let Some(task) = &self.work {
            writeln!(f, "  work on {:?} points a side, {} loads", task.points, task.pressures.len())?;
        }
        Ok(())
    }
}

/// Reads `[solver-validation]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<SolverSpec>) -> Result<SolverPlan, InputError> {
    let SolverSpec { hertz, sinusoid, layered_sphere, ensemble, work } = table.get_ref();
    let of_hertz = hertz.as_ref().map(|spec| whole(file, &spec.pixels, PIXELS, "pixels per contact radius"));
    let layered = layered_sphere.as_ref().map(|spec| {
        let pixels = spec.pixels.get_ref().0;
        if PIXELS.contains(&(pixels as f64)) {
            return Ok(pixels as usize);
        }
        let message = format!("found {pixels}; allowed: {} pixels per contact radius", range(&PIXELS));
        Err(file.source.error_at(spec.pixels.span(), message))
    });
    let plan = SolverPlan {
        hertz: of_hertz.transpose()?.unwrap_or_default(),
        sinusoid: sinusoid.as_ref().map(|spec| sinusoid_task(file, spec)).transpose()?,
        layered: layered.transpose()?,
        ensemble: ensemble.as_ref().map(|spec| ensemble_task(file, spec)).transpose()?,
        work: work.as_ref().map(|spec| work_task(file, spec)).transpose()?,
    };
    let is_empty = hertz.is_none() && sinusoid.is_none() && layered_sphere.is_none();
    if is_empty && ensemble.is_none() && work.is_none() {
        let message = "found no problem; allowed: at least one of [solver-validation.hertz], [solver-validation.sinusoid], \
                       [solver-validation.layered-sphere], [solver-validation.ensemble] and [solver-validation.work]";
        return Err(file.source.error_at(table.span(), message));
    }
    Ok(plan)
}

fn sinusoid_task(file: &SpecFile, spec: &SinusoidSpec) -> Result<SinusoidTask, InputError> {
    Ok(SinusoidTask {
        points: whole(file, &spec.points, WAVE_POINTS, "points per wavelength")?,
        shares: within(file, &spec.pressure, SHARES, "of the pressure that closes the gap")?,
    })
}

fn ensemble_task(file: &SpecFile, spec: &EnsembleSpec) -> Result<EnsembleTask, InputError> {
    let points = whole(file, &spec.points, SURFACE_POINTS, "points along a side")?;
    if let Some(error) = points.iter().find_map(|&points| ENSEMBLE.check(points).err()) {
        return Err(file.source.error_at(spec.points.span(), error));
    }
    Ok(EnsembleTask {
        points,
        realisations: file.several(&spec.realisations, "surfaces")?,
        pressures: within(file, &spec.pressure, PRESSURES, "of E*")?,
        error: error(file, &spec.error)?,
    })
}

fn work_task(file: &SpecFile, spec: &WorkSpec) -> Result<WorkTask, InputError> {
    Ok(WorkTask {
        points: whole(file, &spec.points, SURFACE_POINTS, "points along a side")?,
        pressures: within(file, &spec.pressure, PRESSURES, "of E* times the r.m.s. gradient")?,
        error: error(file, &spec.error)?,
    })
}

fn error(file: &SpecFile, raw: &Spanned<Quantity<Pure>>) -> Result<f64, InputError> {
    let error = raw.get_ref().value();
    if Options::ERRORS.contains(&error) {
        return Ok(error);
    }
    let message = format!("found {error:e}; allowed: a relative dual gap of {}", range(&Options::ERRORS));
    Err(file.source.error_at(raw.span(), message))
}

/// "4 to 400"
fn range(allowed: &RangeInclusive<f64>) -> String {
    let plain = |value: f64| if value < 1e-3 { format!("{value:e}") } else { value.to_string() };
    format!("{} to {}", plain(*allowed.start()), plain(*allowed.end()))
}

/// Ascending values of a range.
fn within(
    file: &SpecFile,
    raw: &Spanned<LogSweep<Pure>>,
    allowed: RangeInclusive<f64>,
    what: &str,
) -> Result<Vec<f64>, InputError> {
    let values = &raw.get_ref().values;
    if let Some(value) = values.iter().find(|value| !allowed.contains(value)) {
        let message = format!("found {value}; allowed: {} {what}", range(&allowed));
        return Err(file.source.error_at(raw.span(), message));
    }
    if values.windows(2).any(|pair| pair[0] >= pair[1]) {
        let message = "found values that do not ascend; allowed: each larger than the one before";
        return Err(file.source.error_at(raw.span(), message));
    }
    Ok(values.clone())
}

/// The same, rounded to whole numbers.
fn whole(
    file: &SpecFile,
    raw: &Spanned<LogSweep<Pure>>,
    allowed: RangeInclusive<f64>,
    what: &str,
) -> Result<Vec<usize>, InputError> {
    let mut whole: Vec<usize> =
        within(file, raw, allowed, what)?.into_iter().map(|value| value.round() as usize).collect();
    whole.dedup();
    Ok(whole)
}
