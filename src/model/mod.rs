//! Two ways of adding up one micro-contact: the integral over a height density and the sum over
//! real asperities.

mod deterministic;
mod load_control;
mod response;
mod statistical;

pub use deterministic::Deterministic;
pub use load_control::{LOWEST_SEPARATION, Reached, Unreachable, at_pressure};
pub use response::{INTERACTION, Response, SamplingError};
pub use statistical::{MeanRadius, Statistical};

use crate::asperity::Statistics;

/// Where separations are measured from, and in what unit they are quoted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// The height that separation 0 means, m: the mean asperity height.
    pub mean: f64,
    /// Standard deviation of the asperity heights, m.
    pub sigma: f64,
}

impl From<&Statistics> for Datum {
    fn from(statistics: &Statistics) -> Self {
        Self { mean: statistics.mean_height, sigma: statistics.sigma }
    }
}

/// A way of adding up. Separations are d/sigma, from the datum's mean height.
pub trait Model: Sync {
    /// Where separations are measured from.
    fn datum(&self) -> Datum;

    /// Everything at the separation `h` = d/sigma.
    fn respond(&self, h: f64) -> Response;

    /// The largest separation with at least `pressure` (Pa, positive) in
    /// [[`LOWEST_SEPARATION`], infinity), `None` if there is none.
    fn separation_at(&self, pressure: f64) -> Option<f64>;
}
