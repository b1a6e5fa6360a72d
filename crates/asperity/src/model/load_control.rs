//! The separation of a prescribed load.

use super::{Model, Response};
use crate::numeric::parallel;

/// Separations below this are not searched, in sigma.
pub const LOWEST_SEPARATION: f64 = -10.0;

/// The response at a prescribed pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// The response at the largest separation of at least the prescribed pressure.
    pub response: Response,
    /// Whether the pressure lies within a load jump of the law: the response then has a higher pressure, and any larger
    /// separation a lower one.
    pub in_jump: bool,
}

/// A pressure that a model does not reach at any separation from [`LOWEST_SEPARATION`] on.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a nominal pressure of {wanted:e} Pa is not reached; allowed: below {largest:.2e} Pa, the largest at separations from {LOWEST_SEPARATION} sigma on"
)]
pub struct Unreachable {
    /// The prescribed pressure, Pa.
    pub wanted: f64,
    /// The largest pressure that can be reached, Pa.
    pub largest: f64,
}

/// The response of `model` at the largest separation where its pressure is at least `pressure` (Pa, positive).
///
/// # Errors
/// A pressure that is not reached from [`LOWEST_SEPARATION`] on; the error holds the largest pressure.
pub fn at_pressure(model: &dyn Model, pressure: f64) -> Result<Reached, Unreachable> {
    at_pressures(model, &[pressure]).remove(0)
}

/// [`at_pressure`] for each of many pressures (Pa, positive), searched together.
pub fn at_pressures(model: &dyn Model, pressures: &[f64]) -> Vec<Result<Reached, Unreachable>> {
    let found = reached_at(model, pressures);
    let largest = if found.contains(&None) { largest_pressure(model) } else { 0.0 };
    let answer = |(found, &wanted): (Option<Reached>, &f64)| found.ok_or(Unreachable { wanted, largest });
    found.into_iter().zip(pressures).map(answer).collect()
}

/// [`at_pressures`] with `None` for a pressure that is not reached, without a search for the largest pressure.
pub fn reached_at(model: &dyn Model, pressures: &[f64]) -> Vec<Option<Reached>> {
    if pressures.is_empty() {
        return Vec::new();
    }
    let answer = |(response, wanted): (Option<Response>, &f64)| {
        let response = response?;
        let excess = response.pressure.total() - wanted;
        Some(Reached { response, in_jump: excess > rounding(model, &response) })
    };
    model.responses_at(pressures).into_iter().zip(pressures).map(answer).collect()
}

/// The error of a pressure (Pa) due to rounding of the separation in the frame of the heights.
fn rounding(model: &dyn Model, response: &Response) -> f64 {
    /// Relative rounding error of a pressure at a given separation, far in the tail.
    const RELATIVE: f64 = 1e-11;
    let plane = model.plane();
    let step = 8.0 * f64::EPSILON * (response.separation.abs() + plane.mean.abs() + plane.sigma);
    response.stiffness * step + RELATIVE * response.pressure.total()
}

/// The largest pressure (Pa) on a grid over the range searched; if the load never decreases on approach, that at the
/// lowest separation.
fn largest_pressure(model: &dyn Model) -> f64 {
    /// Grid points per sigma.
    const PER_SIGMA: i32 = 16;
    let steps = 2 * PER_SIGMA * LOWEST_SEPARATION.abs() as i32;
    let grid: Vec<f64> =
        (0..=steps).map(|k| LOWEST_SEPARATION + f64::from(k) / f64::from(PER_SIGMA)).collect();
    model.respond_all(&grid).iter().map(|response| response.pressure.total()).fold(0.0, f64::max)
}

/// Searches each pressure that has not been `found` yet, all of them in parallel.
pub(super) fn search_missing(
    found: &mut [Option<f64>],
    pressures: &[f64],
    search: impl Fn(f64) -> Option<f64> + Sync,
) {
    let missing: Vec<usize> = (0..found.len()).filter(|&k| found[k].is_none()).collect();
    let answers = parallel::map(missing.len(), |k| search(pressures[missing[k]]));
    missing.into_iter().zip(answers).for_each(|(k, answer)| found[k] = answer);
}
