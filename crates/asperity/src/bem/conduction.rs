//! The current through the spots of a solved contact.

use super::active::Points;
use super::compliance::ConductingPair;
use super::contact::Contact;
use super::convolution::Convolution;
use super::patch::{PatchGrid, PatchResponse};
use super::preconditioner::Stencil;
use super::tangent::{Tangent, block_shares};
use super::{Boundary, SolverError};
use crate::progress::Progress;
use crate::topography::Blocks;

/// Steps after which the currents are given up: 9 to 25 are usual.
const STEPS: usize = 2000;

/// Two bodies that conduct through the points in contact of a map: their potential is constant on these, less what a film on them takes,
/// and no current flows elsewhere.
///
/// On a map that repeats, the potential is that beyond the uniform flow through both bodies: neighbouring spots share the flow, and each
/// resists less than alone. Of a finite map it is that of a cluster of spots between half-spaces, in which neighbours raise the
/// resistance: it holds that of the map as a whole.
///
/// The patch is that of the elastic contact. Without yielding, a film and a layer the conductance is therefore the stiffness of the contact over
/// E* s, s being the mean resistivity (Barber 2003): [`Current::of_elastic`].
pub struct Conductor {
    points: [usize; 2],
    convolution: Convolution,
    stencil: Stencil,
    boundary: Boundary,
    film: f64,
    error: f64,
}

/// The current through a contact.
#[derive(Debug, Clone)]
pub struct Current {
    /// Current density at each point over its mean, the y index running fastest.
    densities: Vec<f64>,
    /// Potential over mean current density, ohm m^2 or m^2 K/W.
    resistance: f64,
    /// Estimate from above of the relative error that the iteration leaves.
    pub error: f64,
    /// Steps of conjugate gradients; there are two more convolutions.
    pub steps: usize,
}

impl Conductor {
    /// Of a map of `points` at a distance of `pixel` (m), with a film of a resistance per area (ohm m^2, m^2 K/W; 0: none) on the spots,
    /// solved to the relative `error`.
    ///
    /// # Errors
    /// A layer of finite thickness on a finite map, whose influence is not known here.
    pub fn new(
        points: [usize; 2],
        pixel: [f64; 2],
        boundary: Boundary,
        pair: &ConductingPair,
        film: f64,
        error: f64,
    ) -> Result<Self, SolverError> {
        if boundary == Boundary::Finite && pair.is_layered() {
            return Err(SolverError::LayeredConductor);
        }
        Ok(Self {
            points,
            convolution: Convolution::new(points, pixel, pair, boundary),
            stencil: Stencil::new(pixel, pair, film),
            boundary,
            film,
            error,
        })
    }

    /// The current through the points in contact of `contact`, also those that yield; shows to `progress` that it goes on. `None` without
    /// contact, and in full contact of a map that repeats, which conducts without a constriction.
    pub fn current(&self, contact: &Contact, progress: &dyn Progress) -> Option<Current> {
        debug_assert_eq!(self.points, contact.points);
        self.through(&|k| contact.pressures[k] > 0.0, progress)
    }

    /// The current through the points for which `is_spot` holds; see [`Self::current`].
    pub fn through(
        &self,
        is_spot: &(dyn Fn(usize) -> bool + Sync),
        progress: &dyn Progress,
    ) -> Option<Current> {
        let all = self.points[0] * self.points[1];
        if self.boundary != Boundary::Finite && (0..all).all(is_spot) {
            return None;
        }
        let patch = Points::selected(self.points, is_spot);
        let grid = PatchGrid {
            points: self.points,
            convolution: &self.convolution,
            stencil: self.stencil,
            wraps: self.boundary.wraps(),
            film: self.film,
            progress,
        };
        let PatchResponse { pressures, level, error, steps, .. } = grid.respond(&patch, self.error, STEPS)?;
        Some(Current { densities: pressures, resistance: level, error, steps })
    }
}

impl Current {
    /// Of the contact of `tangent` where nothing yields, on two half-spaces of the reduced modulus E* (Pa) and the mean resistivity s (ohm m,
    /// m K/W), without a film (Barber 2003).
    pub fn of_elastic(tangent: &Tangent, reduced_modulus: f64, resistivity: f64) -> Self {
        let resistance = reduced_modulus * resistivity / tangent.stiffness_of_approach();
        let densities = tangent.pressures().to_vec();
        Self { densities, resistance, error: tangent.error, steps: tangent.steps }
    }

    /// Conductance per nominal area, S/m^2 or W/(m^2 K).
    pub fn conductance(&self) -> f64 {
        self.resistance.recip()
    }

    /// The current density at each point over its mean.
    pub fn densities(&self) -> &[f64] {
        &self.densities
    }

    /// The part of the current through each block of a division of the points.
    pub fn block_shares(&self, blocks: &Blocks) -> Vec<f64> {
        block_shares(&self.densities, blocks)
    }
}
