//! Two ways of summing one micro-contact: the integral over a height density and the sum over individual asperities.

mod block;
mod deterministic;
mod greenwood_tripp;
mod load_control;
mod mixture;
mod radius_in_contact;
mod response;
mod statistical;
mod validity;
mod weight;

pub use deterministic::Deterministic;
pub(crate) use greenwood_tripp::power_law;
pub use greenwood_tripp::{GreenwoodTrippError, meeting_pairs};
pub use load_control::{LOWEST_SEPARATION, Reached, Unreachable, at_pressure, at_pressures, reached_at};
pub(crate) use mixture::Mixture;
pub use mixture::{SummitShape, joint_model};
pub use radius_in_contact::RadiusInContact;
pub(crate) use response::WithMedium;
pub use response::{Medium, ReferencePlane, Response, SamplingError};
pub use statistical::{MeanRadius, Statistical};
pub use validity::{
    Exceeded, INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, LoadSharing, MIN_CONTACTS,
};

use crate::numeric::levels::{Point, last_reaching_all};

/// A way of summing a micro-contact over a rough surface. Separations are d/sigma, measured from [`Self::plane`].
pub trait Model: Sync {
    /// Where separations are measured from.
    fn plane(&self) -> ReferencePlane;

    /// The responses at the separations d/sigma; faster than point by point.
    fn respond_all(&self, separations: &[f64]) -> Vec<Response>;

    /// [`Self::respond_all`] without the sums over spots, which are then 0: for searches.
    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.respond_all(separations)
    }

    /// Whether the load may decrease on approach, so that a pressure may be reached more than once.
    fn may_decrease(&self) -> bool;

    /// For each of the pressures (Pa, positive) the largest separation d/sigma in [[`LOWEST_SEPARATION`], infinity)
    /// with at least that pressure; `None` if there is none.
    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>>;

    /// The responses at [`Self::separations_at`].
    fn responses_at(&self, pressures: &[f64]) -> Vec<Option<Response>> {
        responses_at(self, pressures)
    }

    /// The response at the separation `h` = d/sigma.
    fn respond(&self, h: f64) -> Response {
        self.respond_all(&[h])[0]
    }

    /// [`Self::separations_at`] of one pressure.
    fn separation_at(&self, pressure: f64) -> Option<f64> {
        self.separations_at(&[pressure])[0]
    }

    /// For each of `pressures` (Pa) the response, without spots, at the largest separation in [`low`, `high`] with at least that pressure;
    /// `None` if it is not reached at `low`. The pressure must not increase with the separation in this range. The search begins at the
    /// separations `near`, where there are any.
    fn last_reaching(&self, pressures: &[f64], low: f64, high: f64, near: &[f64]) -> Vec<Option<Response>> {
        /// Separations evaluated at a time.
        const WAVE: usize = 16;
        let sigma = self.plane().sigma;
        let mut evaluated: Vec<Response> = Vec::new();
        let curve = |separations: &[f64]| -> Vec<Point> {
            let responses = self.respond_without_spots(separations);
            let point = |response: &Response| Point {
                x: response.separation_over_sigma,
                value: response.pressure.total(),
                slope: -response.stiffness * sigma,
            };
            let points = responses.iter().map(point).collect();
            evaluated.extend(responses);
            points
        };
        let mut first: Vec<f64> = near.iter().copied().filter(|h| low < *h && *h < high).collect();
        first.sort_by(|a, b| b.total_cmp(a));
        let (grid, lowest) = (descent(low, high), first.last().copied());
        let waves: Vec<&[f64]> = match lowest {
            None => grid.chunks(WAVE).collect(),
            Some(lowest) => {
                first.insert(0, high);
                let below = grid.partition_point(|h| *h >= lowest);
                std::iter::once(&first[..]).chain(grid[below..].chunks(WAVE)).collect()
            }
        };
        let found = last_reaching_all(curve, pressures, &waves);
        let response = |h: f64| evaluated.iter().rev().find(|response| response.separation_over_sigma == h);
        found.into_iter().map(|h| response(h?).copied()).collect()
    }
}

/// The responses of a model at its separations of `pressures`, each evaluated once more.
fn responses_at<M: Model + ?Sized>(model: &M, pressures: &[f64]) -> Vec<Option<Response>> {
    let found = model.separations_at(pressures);
    let reached: Vec<f64> = found.iter().copied().flatten().collect();
    let mut responses = model.respond_all(&reached).into_iter();
    found.into_iter().map(|h| h.and_then(|_| responses.next())).collect()
}

/// The separations d/sigma of responses.
fn separations_of(responses: Vec<Option<Response>>) -> Vec<Option<f64>> {
    responses.into_iter().map(|response| response.map(|response| response.separation_over_sigma)).collect()
}

/// Separations from `high` down to `low`, in steps of a quarter of sigma where contacts begin and of more far out.
fn descent(low: f64, high: f64) -> Vec<f64> {
    /// Separations (in sigma) and the steps above them.
    const FAR: [(f64, f64); 2] = [(12.0, 4.0), (6.0, 2.0)];
    const NEAR: f64 = 0.25;
    /// The separation beyond which densities are negligible: one step.
    const END: f64 = 48.0;
    let mut grid = vec![high];
    let mut next = if high > END { END } else { high.ceil() - 1.0 };
    while next > low {
        if next < high {
            grid.push(next);
        }
        next -= FAR.into_iter().find(|(from, _)| next > *from).map_or(NEAR, |(_, step)| step);
    }
    if low < high {
        grid.push(low);
    }
    grid
}
