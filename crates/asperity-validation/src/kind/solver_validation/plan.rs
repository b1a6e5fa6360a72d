//! Problems and resolutions, checked.

use std::fmt;
use std::ops::RangeInclusive;

use super::spec::{EnsembleSpec, GridSpec, SinusoidSpec, SolverSpec, WorkSpec};
use crate::kind::boundary_elements::{PIXELS, check_range, range_words, whole};
use crate::solver::LAYERED_CASES;
use crate::solver::ensemble::EnsembleTask;
use crate::solver::grid::{FINE, GRIDS, GridCase, GridTask};
use crate::solver::published::ENSEMBLE;
use crate::solver::work::WorkTask;
use asperity::bem::Options;
use asperity_contact_framework::input::quantity::{Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

/// Points per wavelength.
const WAVE_POINTS: RangeInclusive<f64> = 8.0..=16384.0;
/// Pressure over that which closes the gap of a wave.
const SHARES: RangeInclusive<f64> = 1e-4..=0.9999;
/// Points along the side of a rough surface.
const SURFACE_POINTS: RangeInclusive<f64> = 64.0..=8192.0;
/// Pressures on a rough surface, over E* or over E* g.
const PRESSURES: RangeInclusive<f64> = 1e-6..=10.0;

/// Points along the side of the fine grid: at least eight shortest waves.
const FINE_POINTS: RangeInclusive<f64> = 256.0..=8192.0;
/// Pressures over E* g, below the cap.
const BELOW_CAP: RangeInclusive<f64> = 1e-6..=0.19;

/// What is run.
pub struct SolverPlan {
    /// Pixels per contact radius of Hertz's contact.
    pub hertz: Vec<usize>,
    pub sinusoid: Option<SinusoidTask>,
    /// Pixels per contact radius of the spheres on a layer.
    pub layered: Option<usize>,
    pub ensemble: Option<EnsembleTask>,
    pub grid: Option<GridTask>,
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

impl fmt::Display for SolverPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { hertz, sinusoid, layered, ensemble, grid, work } = self;
        let lines = [
            (!hertz.is_empty()).then(|| format!("Hertz at {hertz:?} pixels per contact radius")),
            sinusoid.as_ref().map(|SinusoidTask { points, shares }| {
                format!("a wave of {points:?} points at {shares:?} p*, and waves in full contact")
            }),
            layered.map(|pixels| {
                let count = LAYERED_CASES.len();
                format!("{count} spheres on a layer at {pixels} pixels per contact radius")
            }),
            ensemble.as_ref().map(|EnsembleTask { points, realisations, pressures, .. }| {
                let loads = pressures.len();
                format!("{realisations} surfaces of the published ensemble on {points:?} points a side, {loads} loads")
            }),
            grid.as_ref().map(|GridTask { points, realisations, pressures, .. }| {
                let (cases, grids, loads) = (GridCase::ALL.len(), GRIDS.len(), pressures.len());
                format!(
                    "{cases} x {realisations} surfaces on {points} points a side and {grids} coarser grids, {loads} loads"
                )
            }),
            work.as_ref().map(|WorkTask { points, pressures, .. }| {
                format!("work on {points:?} points a side, {} loads", pressures.len())
            }),
        ];
        lines.into_iter().flatten().try_for_each(|line| writeln!(f, "  {line}"))
    }
}

/// Reads `[solver-validation]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<SolverSpec>) -> Result<SolverPlan, InputError> {
    let SolverSpec { hertz, sinusoid, layered_sphere, ensemble, grid, work } = table.get_ref();
    let hertz = hertz.as_ref().map(|spec| counts(file, &spec.pixels, PIXELS, "{} pixels per contact radius"));
    let layered = layered_sphere.as_ref().map(|spec| -> Result<usize, InputError> {
        let pixels = spec.pixels.get_ref().0;
        let allowed = "{} pixels per contact radius";
        check_range(file, spec.pixels.span(), &[pixels as f64], &PIXELS, allowed)?;
        Ok(pixels as usize)
    });
    let is_empty = hertz.is_none() && sinusoid.is_none() && layered.is_none();
    let plan = SolverPlan {
        hertz: hertz.transpose()?.unwrap_or_default(),
        sinusoid: sinusoid.as_ref().map(|spec| sinusoid_task(file, spec)).transpose()?,
        layered: layered.transpose()?,
        ensemble: ensemble.as_ref().map(|spec| ensemble_task(file, spec)).transpose()?,
        grid: grid.as_ref().map(|spec| grid_task(file, spec)).transpose()?,
        work: work.as_ref().map(|spec| work_task(file, spec)).transpose()?,
    };
    if is_empty && ensemble.is_none() && grid.is_none() && work.is_none() {
        let message = "found no problem; allowed: at least one of [solver-validation.hertz], [solver-validation.sinusoid], \
                       [solver-validation.layered-sphere], [solver-validation.ensemble], [solver-validation.grid] and \
                       [solver-validation.work]";
        return Err(file.source.error_at(table.span(), message));
    }
    Ok(plan)
}

fn sinusoid_task(file: &SpecFile, spec: &SinusoidSpec) -> Result<SinusoidTask, InputError> {
    Ok(SinusoidTask {
        points: counts(file, &spec.points, WAVE_POINTS, "{} points per wavelength")?,
        shares: ascending(file, &spec.pressure, SHARES, "{} of the pressure that closes the gap")?,
    })
}

fn ensemble_task(file: &SpecFile, spec: &EnsembleSpec) -> Result<EnsembleTask, InputError> {
    let points = counts(file, &spec.points, SURFACE_POINTS, "{} points along a side")?;
    if let Some(error) = points.iter().find_map(|&points| ENSEMBLE.check(points).err()) {
        return Err(file.source.error_at(spec.points.span(), error));
    }
    Ok(EnsembleTask {
        points,
        realisations: file.several(&spec.realisations, "surfaces")?,
        pressures: ascending(file, &spec.pressure, PRESSURES, "{} of E*")?,
        error: error(file, &spec.error)?,
    })
}

fn grid_task(file: &SpecFile, spec: &GridSpec) -> Result<GridTask, InputError> {
    let points = spec.points.get_ref().0;
    check_range(file, spec.points.span(), &[points as f64], &FINE_POINTS, "{} points along a side")?;
    if !points.is_multiple_of(FINE as u64) {
        let message = format!("found {points} points along a side; allowed: a multiple of {FINE}");
        return Err(file.source.error_at(spec.points.span(), message));
    }
    Ok(GridTask {
        points: points as usize,
        realisations: file.several(&spec.realisations, "surfaces")?,
        pressures: ascending(file, &spec.pressure, BELOW_CAP, "{} of E* times the r.m.s. gradient")?,
        error: error(file, &spec.error)?,
    })
}

fn work_task(file: &SpecFile, spec: &WorkSpec) -> Result<WorkTask, InputError> {
    Ok(WorkTask {
        points: counts(file, &spec.points, SURFACE_POINTS, "{} points along a side")?,
        pressures: ascending(file, &spec.pressure, PRESSURES, "{} of E* times the r.m.s. gradient")?,
        error: error(file, &spec.error)?,
    })
}

fn error(file: &SpecFile, raw: &Spanned<Quantity<Pure>>) -> Result<f64, InputError> {
    let error = raw.get_ref().value();
    if Options::ERRORS.contains(&error) {
        return Ok(error);
    }
    let message =
        format!("found {error:e}; allowed: a relative dual gap of {}", range_words(&Options::ERRORS));
    Err(file.source.error_at(raw.span(), message))
}

/// Values of a range, which ascend.
fn ascending(
    file: &SpecFile,
    raw: &Spanned<LogSweep<Pure>>,
    range: RangeInclusive<f64>,
    allowed: &str,
) -> Result<Vec<f64>, InputError> {
    let values = &raw.get_ref().values;
    check_range(file, raw.span(), values, &range, allowed)?;
    if values.windows(2).any(|pair| pair[0] >= pair[1]) {
        let message = "found values that do not ascend; allowed: each larger than the one before";
        return Err(file.source.error_at(raw.span(), message));
    }
    Ok(values.clone())
}

/// The same, rounded to whole numbers.
fn counts(
    file: &SpecFile,
    raw: &Spanned<LogSweep<Pure>>,
    range: RangeInclusive<f64>,
    allowed: &str,
) -> Result<Vec<usize>, InputError> {
    Ok(whole(&ascending(file, raw, range, allowed)?))
}
