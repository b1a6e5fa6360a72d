//! Chang, Etsion and Bogy: volume conservation of a yielding asperity.

use std::f64::consts::PI;

use super::regimes::exponents_passed;
use super::{Hertz, Law, OfPoisson, Pair, Pairs, Property, ScalableLaw, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{Mask, Real};

/// The elastic-plastic sphere of Chang, Etsion and Bogy (1987):
///
/// ```text
/// K = 0.454 + 0.41 nu,   wc = (pi K H/(2 E*))^2 b
/// w <= wc:  A = pi b w,              P = (4/3) E* b^.5 w^1.5
/// w >  wc:  A = pi b w (2 - wc/w),   P = K H A
/// ```
///
/// K H is the maximum pressure at the onset of yield, with nu and H of the body that yields first (the smaller K H).
/// The paper takes H = 2.8 Y; here the given hardness is used, never one derived from a yield strength.
///
/// Beyond wc the mean pressure stays at K H, below the hardness: contacts remain elastic-plastic at any indentation.
///
/// Valid for w much smaller than b. Jumps: the load by 1.5 at wc, where the mean pressure jumps from (2/3) K H to K H;
/// the area is continuous there, its slope doubles. The jump is part of the published model.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ceb;

/// K of Chang, Etsion and Bogy (1987), fitted to the maximum shear stress under a Hertz contact.
pub(super) const HARDNESS_FACTOR: OfPoisson = OfPoisson { constant: 0.454, slope: 0.41 };

/// wc/b over (onset/E*)^2.
pub(super) const CRITICAL: f64 = PI * PI / 4.0;

impl Law for Ceb {
    fn name(&self) -> &'static str {
        "ceb"
    }

    fn about(&self) -> &'static str {
        "Elastic up to its own onset of yield; beyond it the volume is conserved and the mean pressure is \
         K H, so that the load jumps by 50 % at the onset. Valid for w much smaller than R."
    }

    fn papers(&self) -> &'static [Paper] {
        &[literature::CHANG_ETSION_BOGY_1987]
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        Ok(self.yield_limits_by_hardness(body))
    }

    fn needs(&self) -> Option<Property> {
        Some(Property::Hardness)
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        let critical = pair.ratio(CRITICAL) * b;
        let elastic = w.le(critical);
        let springing = Hertz::elastic(w, b, pair.reduced_modulus);
        if elastic.all() {
            return springing;
        }
        let slope = b * PI;
        let area = slope * (w + (w - critical));
        let pressure = pair.yield_limits.onset;
        let nowhere = !w.all_true();
        let between = Contacts {
            area,
            load: pressure * area,
            stiffness: pressure * slope * 2.0,
            elastic: nowhere,
            plastic: nowhere,
        };
        Contacts::select(elastic, &springing, &between)
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        let critical = pair.ratio(CRITICAL);
        if critical.is_finite() { vec![critical] } else { Vec::new() }
    }
}

impl ScalableLaw for Ceb {
    const ONSET: OfPoisson = HARDNESS_FACTOR;

    /// 1.5, then 2 u/(2 u - 1) with u = w/wc: from 2 down to 1.
    fn load_exponents(&self, u: Interval) -> Interval {
        let exponent = |u: f64| {
            let u = (u / CRITICAL).max(1.0);
            (1.0 - 0.5 / u).recip()
        };
        let beyond = Interval { low: exponent(u.high), high: exponent(u.low) };
        exponents_passed(u, &[(0.0, Interval::point(1.5)), (CRITICAL, beyond)])
    }
}
