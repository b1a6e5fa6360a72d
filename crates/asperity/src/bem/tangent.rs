//! How approach, gap and pressures of a solved contact change with the load.

use super::Boundary;
use super::active::Points;
use super::contact::{AT_CAP, Contact};
use super::patch::PatchResponse;
use crate::numeric::sum::sum_of;
use crate::topography::Blocks;

/// The derivative of a contact by the mean pressure, for an increasing load: points in contact below the cap stay in contact,
/// points at the cap stay at it, the others stay open. The border of the contact moves too, but pressure and gap are zero
/// there, so that this is of second order in the increase.
#[derive(Debug, Clone)]
pub struct Tangent {
    /// Pressure at each point by the mean pressure.
    pressures: Vec<f64>,
    /// Decrease of the mean gap by the mean pressure, m/Pa.
    gap: f64,
    /// Increase of the approach by the mean pressure, m/Pa.
    approach: f64,
    /// Points that change their pressure.
    count: usize,
    /// Estimate from above of the relative error that the iteration leaves.
    pub error: f64,
    /// Steps of conjugate gradients; there are two more convolutions.
    pub steps: usize,
}

impl Tangent {
    /// The points of `contact` that change their pressure.
    pub(super) fn patch(contact: &Contact) -> Points {
        let cap = AT_CAP * contact.cap;
        Points::selected(contact.points, |k| contact.pressures[k] > 0.0 && contact.pressures[k] < cap)
    }

    /// From the response of the patch of `contact`.
    pub(super) fn new(contact: &Contact, response: PatchResponse) -> Self {
        let PatchResponse { pressures, displacements, level, count, error, steps } = response;
        let cap = AT_CAP * contact.cap;
        let of = &contact.pressures;
        let mean = |value: &(dyn Fn(usize) -> f64 + Sync)| sum_of(of.len(), value) / of.len() as f64;
        let gap = if contact.boundary == Boundary::Finite {
            mean(&|k| if of[k] > 0.0 { 0.0 } else { level - displacements[k] })
        } else {
            // Displacements of a map that repeats have no mean, and the patch is at one level: the points at the cap are left.
            level + mean(&|k| if of[k] < cap { 0.0 } else { displacements[k] - level })
        };
        Self { pressures, gap, approach: level, count, error, steps }
    }

    /// -dp/dd, p being the mean pressure and d the mean gap, Pa/m.
    pub fn stiffness(&self) -> f64 {
        self.gap.recip()
    }

    /// dp by the approach, Pa/m: the same as the stiffness on a map that repeats where nothing yields.
    pub fn stiffness_of_approach(&self) -> f64 {
        self.approach.recip()
    }

    /// The pressure at each point by the mean pressure, the y index running fastest.
    pub fn pressures(&self) -> &[f64] {
        &self.pressures
    }

    /// Points in contact below the cap.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The part of an increase of the load that each block of a division of the points carries.
    pub fn block_shares(&self, blocks: &Blocks) -> Vec<f64> {
        block_shares(&self.pressures, blocks)
    }
}

/// The part of the loads, whose mean is 1, on each block of a division of the points.
pub(super) fn block_shares(loads: &[f64], blocks: &Blocks) -> Vec<f64> {
    let all = loads.len() as f64;
    let mut shares = vec![0.0; blocks.count()];
    for (k, &load) in loads.iter().enumerate().filter(|(_, load)| **load != 0.0) {
        shares[blocks.of_point(k)] += load / all;
    }
    shares
}
