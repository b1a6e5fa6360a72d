//! Abbott and Firestone: the truncated profile of a fully plastic asperity.

use std::f64::consts::PI;

use super::{Law, Pair, Pairs, Property, ScalableLaw, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;

/// A sphere that is plastic from first contact on, with the truncated area of its profile (Abbott and Firestone 1933):
///
/// ```text
/// A = 2 pi b w,   P = H A          (Pasaribu and Schipper 2005, Eqs. 8, 12)
/// ```
///
/// Valid for w much smaller than b and far beyond the onset of yield: a limiting case. H is that of the softer body. No
/// elastic range, no jumps; the modulus is not used.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FullyPlastic;

impl FullyPlastic {
    /// The contact of a sphere truncated at the flat, at the mean pressure `strength` (Pa).
    #[inline(always)]
    pub(super) fn plastic<N: Real>(w: N, b: N, strength: N) -> Contacts<N> {
        let slope = b * (2.0 * PI);
        let stiffness = strength * slope;
        let all = w.all_true();
        Contacts { area: slope * w, load: stiffness * w, stiffness, elastic: !all, plastic: all }
    }
}

impl Law for FullyPlastic {
    fn name(&self) -> &'static str {
        "fully-plastic"
    }

    fn about(&self) -> &'static str {
        "Plastic throughout: the contact area is the section of the undeformed profile, the mean pressure \
         the hardness. Limiting case of large indentations; overestimates the area of elastic contacts."
    }

    fn papers(&self) -> &'static [Paper] {
        &[literature::ABBOTT_FIRESTONE_1933]
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        Ok(self.yield_limits_by_hardness(body))
    }

    fn needs(&self) -> Option<Property> {
        Some(Property::Hardness)
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        Self::plastic(w, b, pair.yield_limits.strength)
    }

    fn critical_ratios(&self, _: &Pair) -> Vec<f64> {
        Vec::new()
    }
}

impl ScalableLaw for FullyPlastic {
    fn load_exponents(&self, _: Interval) -> Interval {
        Interval::point(1.0)
    }
}
