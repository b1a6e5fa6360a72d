//! The separation at which a surface carries a given load.

use super::{Model, Response};

/// Separations below this are not searched, in sigma.
pub const LOWEST_SEPARATION: f64 = -10.0;

/// A pressure that a model was pressed to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// The response at the largest separation that carries the pressure.
    pub response: Response,
    /// Whether the pressure lies in a jump of the law: the response carries more than was asked,
    /// and any larger separation less.
    pub in_jump: bool,
}

/// A pressure that a model does not carry at any separation that is searched.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a nominal pressure of {wanted:e} Pa is not reached; the largest that is, at a separation of {LOWEST_SEPARATION} sigma, is {largest:e} Pa"
)]
pub struct Unreachable {
    /// What was asked, Pa.
    pub wanted: f64,
    /// What can be reached, Pa.
    pub largest: f64,
}

/// The response of `model` at the largest separation with at least `pressure` (Pa, positive).
///
/// # Errors
/// A pressure that is not reached down to [`LOWEST_SEPARATION`], with the largest that is.
pub fn at_pressure(model: &dyn Model, pressure: f64) -> Result<Reached, Unreachable> {
    /// Wider than what rounding of a separation does to a pressure, at 40 sigma.
    const ROUNDING: f64 = 1e-11;
    match model.separation_at(pressure) {
        Some(h) => {
            let response = model.respond(h);
            let in_jump = response.pressure.total() > pressure * (1.0 + ROUNDING);
            Ok(Reached { response, in_jump })
        }
        None => {
            let largest = model.respond(LOWEST_SEPARATION).pressure.total();
            Err(Unreachable { wanted: pressure, largest })
        }
    }
}
