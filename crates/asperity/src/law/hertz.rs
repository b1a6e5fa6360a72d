//! Hertz: the elastic sphere of Greenwood and Williamson.

use std::f64::consts::PI;

use super::{Law, Pair, Pairs, Property, ScalableLaw, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;

/// A sphere that stays elastic at any indentation (Greenwood and Williamson 1966):
///
/// ```text
/// A = pi b w                       (Pasaribu and Schipper 2005, Eq. 6)
/// P = (4/3) E* b^.5 w^1.5          (Eq. 10)
/// ```
///
/// Valid for w much smaller than b and below the onset of yield. No jumps; hardness is not used.
#[derive(Debug, Clone, Copy, Default)]
pub struct Hertz;

impl Hertz {
    /// Description of the law for ellipses.
    pub(crate) const ON_ELLIPSES: &str = "Hertz's elastic contact of an elliptic paraboloid with two principal curvatures. Valid below the onset of yield.";

    /// The elastic contact, also the elastic range of other laws.
    #[inline(always)]
    pub(super) fn elastic<N: Real>(w: N, b: N, reduced_modulus: N) -> Contacts<N> {
        let square = b * w;
        let radius = square.sqrt();
        let stiffness = reduced_modulus * 2.0 * radius;
        let all = w.all_true();
        Contacts {
            area: square * PI,
            load: stiffness * w * (2.0 / 3.0),
            stiffness,
            elastic: all,
            plastic: !all,
        }
    }
}

impl Law for Hertz {
    fn name(&self) -> &'static str {
        "hertz"
    }

    fn about(&self) -> &'static str {
        "Elastic throughout. Valid below the onset of yield; beyond it, the elastic limiting case."
    }

    fn papers(&self) -> &'static [Paper] {
        &[literature::GREENWOOD_WILLIAMSON_1966]
    }

    fn yield_limits(&self, _: &Material) -> Result<YieldLimits, Property> {
        Ok(YieldLimits::NEVER_YIELDS)
    }

    fn is_hertz(&self) -> bool {
        true
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        Self::elastic(w, b, pair.reduced_modulus)
    }

    fn critical_ratios(&self, _: &Pair) -> Vec<f64> {
        Vec::new()
    }
}

impl ScalableLaw for Hertz {
    fn load_exponents(&self, _: Interval) -> Interval {
        Interval::point(1.5)
    }
}
