//! Two ways of summing one micro-contact: the integral over a height density and the sum over
//! real asperities.

mod block;
mod curve;
mod deterministic;
mod load_control;
mod plane;
mod response;
mod sparse;
mod statistical;

pub use curve::{Curve, respond_within};
pub use deterministic::Deterministic;
pub use load_control::{LOWEST_SEPARATION, Reached, Unreachable, at_pressure, at_pressures, reached_at};
pub use plane::ReferencePlane;
pub use response::{INTERACTION, Response, SamplingError};
pub use statistical::{MeanRadius, Statistical};

use crate::numeric::levels::{Point, last_reaching_all};

/// Numbers of contacts.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactCounts {
    /// Number of contacts at each separation.
    pub contacts: Vec<f64>,
    /// One over the nominal area, 1/m^2.
    pub per_area: f64,
}

/// A way of summing a micro-contact over a rough surface. Separations are d/sigma, from the plane's mean height.
pub trait Model: Sync {
    /// Where separations are measured from.
    fn plane(&self) -> ReferencePlane;

    /// The responses at the separations d/sigma: a curve costs less at once than point by point.
    fn respond_all(&self, separations: &[f64]) -> Vec<Response>;

    /// The contacts at each of the separations d/sigma, where they can be counted without the rest.
    fn count_contacts(&self, _: &[f64]) -> Option<ContactCounts> {
        None
    }

    /// Whether the load of an asperity may decrease as the flat comes nearer, so that a pressure may be reached more than once.
    fn may_decrease(&self) -> bool;

    /// For each of the pressures (Pa, positive) the largest separation with at least that in
    /// [[`LOWEST_SEPARATION`], infinity), `None` if there is none.
    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>>;

    /// The response at the separation `h` = d/sigma.
    fn respond(&self, h: f64) -> Response {
        self.respond_all(&[h])[0]
    }

    /// [`Self::separations_at`] of one pressure.
    fn separation_at(&self, pressure: f64) -> Option<f64> {
        self.separations_at(&[pressure])[0]
    }

    /// The largest separations in [`low`, `high`] with at least each of `pressures` (Pa), `None` where it is not reached at
    /// `low`, of a pressure that nowhere there rises with the separation.
    fn last_reaching(&self, pressures: &[f64], low: f64, high: f64) -> Vec<Option<f64>> {
        let sigma = self.plane().sigma;
        let curve = |separations: &[f64]| -> Vec<Point> {
            let point = |response: Response| Point {
                x: response.separation_over_sigma,
                value: response.pressure.total(),
                slope: -response.stiffness * sigma,
            };
            self.respond_all(separations).into_iter().map(point).collect()
        };
        last_reaching_all(curve, pressures, &descent(low, high))
    }
}

/// Separations from `high` down to `low`, in steps of a quarter of sigma where contacts begin and of one far out.
fn descent(low: f64, high: f64) -> Vec<f64> {
    /// Few asperities are higher.
    const FAR: f64 = 6.0;
    /// Beyond that most densities are gone; what is left is one step.
    const END: f64 = 48.0;
    let mut grid = vec![high];
    let mut next = if high > END { END } else { high.ceil() - 1.0 };
    while next > low {
        if next < high {
            grid.push(next);
        }
        next -= if next > FAR { 1.0 } else { 0.25 };
    }
    if low < high {
        grid.push(low);
    }
    grid
}
