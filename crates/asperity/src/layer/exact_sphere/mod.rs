//! A sphere on an elastic layer bonded to an elastic half-space: the exact frictionless contact.
//!
//! With the pressure p(r) = -int_r^a g'(tau) (tau^2 - r^2)^-.5 dtau, which vanishes outside the contact, the problem
//! reduces to one integral equation of the second kind for g (Perriot and Barthel 2004). Relative error 1e-12 for
//! moduli in the ratio 1:1000 to 1000:1, the tested range.

mod influence;
mod kernel;

use crate::literature::{self, Paper};
use crate::material::Material;
use influence::State;

pub(crate) use influence::Influence;
pub(crate) use kernel::Kernel;

/// The largest contact radius supported, in layer thicknesses.
pub const LARGEST_RATIO: f64 = 1000.0;

/// |ln(prescribed/found indentation)| from which one linear step reaches rounding.
const CLOSE: f64 = 1e-8;

/// A sphere, rigid or elastic, on an elastic layer bonded to an elastic half-space; no friction, no adhesion, small
/// strains. The sphere deforms as a half-space.
///
/// The contact area is assumed to be a full disc; separation of a very stiff layer within it is not modelled.
///
/// Quantities that depend on the materials only are shared by all contacts of one `LayeredSphere`, from any number of
/// threads.
#[derive(Debug, Clone)]
pub struct LayeredSphere {
    influence: Influence,
    /// 1 + E1*/E* of the sphere.
    shift: f64,
    /// E1*, Pa.
    modulus: f64,
    /// R, m.
    radius: f64,
    /// t, m.
    thickness: f64,
}

/// The contact at one indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticContact {
    /// Radius of the contact a, m.
    pub contact_radius: f64,
    /// Approach of distant points of the two bodies w, m.
    pub indentation: f64,
    /// Load P, N.
    pub load: f64,
    /// dP/dw, N/m.
    pub stiffness: f64,
}

impl LayeredSphere {
    /// A sphere (rigid if `None`) of `radius` (m) on a layer of `thickness` (m), both positive and finite.
    pub fn new(
        ball: Option<&Material>,
        radius: f64,
        layer: &Material,
        substrate: &Material,
        thickness: f64,
    ) -> Self {
        let modulus = |body: &Material| body.young() / ((1.0 - body.poisson()) * (1.0 + body.poisson()));
        Self {
            influence: Influence::new(Kernel::new(layer, substrate), 2.0 * LARGEST_RATIO),
            shift: 1.0 + ball.map_or(0.0, |ball| modulus(layer) / modulus(ball)),
            modulus: modulus(layer),
            radius,
            thickness,
        }
    }

    /// The contact of radius `a`, m. `None` unless 0 < a <= [`LARGEST_RATIO`] t: beyond, the layer has a negligible
    /// effect.
    pub fn at_contact_radius(&self, a: f64) -> Option<ElasticContact> {
        self.solve(a / self.thickness).map(|state| self.contact(a / self.thickness, &state))
    }

    /// The contact under the indentation `w`, m. `None` unless w > 0 and a <= [`LARGEST_RATIO`] t.
    ///
    /// Newton's method for ln w over ln a, within a bracket: three to six solutions, a dozen under a layer
    /// 1000 times stiffer than its substrate.
    pub fn at_indentation(&self, w: f64) -> Option<ElasticContact> {
        let target = w / self.thickness * (self.radius / self.thickness);
        if target.is_nan() || target <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut a = target.sqrt().min(LARGEST_RATIO);
        loop {
            let state = self.solve(a)?;
            let gap = (target / state.indentation).ln();
            if gap.abs() <= CLOSE {
                let missing = target - state.indentation;
                let wider = missing / state.slope;
                let reached = State {
                    indentation: target,
                    load: state.load + state.stiffness * missing,
                    stiffness: state.stiffness + state.stiffening * wider,
                    ..state
                };
                return Some(self.contact(a + wider, &reached));
            }
            if gap > 0.0 {
                low = a;
            } else {
                high = a;
            }
            if low == LARGEST_RATIO {
                return None;
            }
            let newton = a * (gap * state.indentation / (a * state.slope)).exp();
            let next = newton.min(LARGEST_RATIO);
            let inside = next > low && next < high;
            a = if inside { next } else { 0.5 * (low + high.min(LARGEST_RATIO)) };
        }
    }

    /// The sources of the solution.
    pub fn papers() -> &'static [Paper] {
        &[literature::PERRIOT_BARTHEL_2004]
    }

    fn solve(&self, a: f64) -> Option<State> {
        (a > 0.0 && a <= LARGEST_RATIO).then(|| State::solve(&self.influence, self.shift, a))?
    }

    fn contact(&self, a: f64, state: &State) -> ElasticContact {
        let t = self.thickness;
        ElasticContact {
            contact_radius: a * t,
            indentation: state.indentation * t * (t / self.radius),
            load: state.load * self.modulus * t * t * (t / self.radius),
            stiffness: state.stiffness * self.modulus * t,
        }
    }
}
