//! Kogut and Etsion: power laws fitted to finite-element results.

use std::f64::consts::PI;

use super::ceb::{CRITICAL, HARDNESS_FACTOR};
use super::regimes::{exponents_passed, in_range};
use super::{Hertz, Law, OfPoisson, Pair, Pairs, Property, ScalableLaw, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{Mask, Real};

/// The elastic-plastic sphere of Kogut and Etsion (2002), with u = w/wc:
///
/// ```text
/// K = 0.454 + 0.41 nu,   wc = (pi K H/(2 E*))^2 b          (Chang, Etsion and Bogy 1987)
/// Pc = (2/3) K H pi b wc,   Ac = pi b wc
/// u < 1:          A = pi b w,               P = (4/3) E* b^.5 w^1.5
/// 1 <= u < 6:     A/Ac = 0.93 u^1.136,      P/Pc = 1.03 u^1.425
/// 6 <= u < 110:   A/Ac = 0.94 u^1.146,      P/Pc = 1.40 u^1.263
/// u >= 110:       A = 2 pi b w,             P = H A        (Abbott and Firestone)
/// ```
///
/// The loads and limits are as published; the area coefficients are those commonly reported, not checked against the
/// original, and agree with the published mean pressures. K H is that of the body that yields first (the smaller K H),
/// H that of the softer one.
///
/// The fit was made for spheres of w up to 110 wc much smaller than b, against a rigid flat.
///
/// Jumps, from below to above: at u = 1 the load by 1.03, the area by 0.93; at 6 by 1.0168 and 1.0290; at 110 the area
/// by 1.0712, and the load by (3/K) 110/(1.40 110^1.263), which is 1.0788 for nu = 0.3, 1.3710 for 0, and below 1 (the
/// load drops) for nu above 0.4108.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct KogutEtsion;

/// A range that begins at u: A/Ac and P/Pc are coefficient u^exponent.
struct Range {
    from: f64,
    area: [f64; 2],
    load: [f64; 2],
}

/// The two elastic-plastic ranges: plastic flow below the surface, then also at the surface.
const RANGES: [Range; 2] = [
    Range { from: 1.0, area: [0.93, 1.136], load: [1.03, 1.425] },
    Range { from: 6.0, area: [0.94, 1.146], load: [1.40, 1.263] },
];

/// w/wc at which the contact becomes plastic.
const PLASTIC: f64 = 110.0;

/// `far` where `is_far`, otherwise `near`.
#[inline(always)]
fn either<N: Real>(is_far: N::Mask, [near, far]: [f64; 2], zero: N) -> N {
    N::select(is_far, zero.splat(far), zero.splat(near))
}

/// A coefficient times a power, for either range.
#[inline(always)]
fn power<N: Real>(is_far: N::Mask, [near, far]: [[f64; 2]; 2], ln_u: N) -> N {
    either(is_far, [near[0], far[0]], ln_u) * (either(is_far, [near[1], far[1]], ln_u) * ln_u).exp()
}

/// The fitted powers of `u` = w/wc.
#[inline(always)]
fn elastic_plastic<N: Real>(w: N, b: N, u: N, critical: N, onset: N) -> Contacts<N> {
    let [near, far] = &RANGES;
    let is_far = w.splat(far.from).le(u);
    let ln_u = u.ln();
    let critical_area = b * PI * critical;
    let load = onset * (2.0 / 3.0) * critical_area * power(is_far, [near.load, far.load], ln_u);
    let nowhere = !w.all_true();
    Contacts {
        area: critical_area * power(is_far, [near.area, far.area], ln_u),
        load,
        stiffness: either(is_far, [near.load[1], far.load[1]], w) * load / w,
        elastic: nowhere,
        plastic: nowhere,
    }
}

impl Law for KogutEtsion {
    fn name(&self) -> &'static str {
        "kogut-etsion"
    }

    fn about(&self) -> &'static str {
        "Power laws fitted to finite elements in two ranges beyond wc, the onset of yield of Chang, Etsion \
         and Bogy; fully plastic from 110 wc. Area and load jump between the ranges. Fitted up to \
         110 wc, for w much smaller than R."
    }

    fn papers(&self) -> &'static [Paper] {
        &[
            literature::KOGUT_ETSION_2002,
            literature::CHANG_ETSION_BOGY_1987,
            literature::ABBOTT_FIRESTONE_1933,
        ]
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
        let elastic = w.lt(critical);
        if elastic.all() {
            return Hertz::elastic(w, b, pair.reduced_modulus);
        }
        let u = w / critical;
        let plastic = w.splat(PLASTIC).le(u);
        let between = elastic_plastic(w, b, u, critical, pair.yield_limits.onset);
        in_range(w, b, pair, [elastic, plastic], between)
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        let critical = pair.ratio(CRITICAL);
        let all = RANGES.iter().map(|range| range.from).chain([PLASTIC]);
        if critical.is_finite() { all.map(|u| u * critical).collect() } else { Vec::new() }
    }
}

impl ScalableLaw for KogutEtsion {
    const ONSET: OfPoisson = HARDNESS_FACTOR;

    fn load_exponents(&self, u: Interval) -> Interval {
        let [near, far] = RANGES.map(|range| (range.from * CRITICAL, Interval::point(range.load[1])));
        exponents_passed(
            u,
            &[(0.0, Interval::point(1.5)), near, far, (PLASTIC * CRITICAL, Interval::point(1.0))],
        )
    }
}
