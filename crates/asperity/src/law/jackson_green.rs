//! Jackson and Green: a finite-element fit in which the hardness decreases with the contact radius.

use std::f64::consts::PI;
use std::sync::Arc;

use super::ceb::CRITICAL;
use super::{Hertz, Inapplicable, Law, Pair, Pairs, Property, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::lanes::{Mask, Real};
use crate::numeric::table::Table;

/// The elastic-plastic sphere of Jackson and Green (2005), with u = w/wc:
///
/// ```text
/// C = 1.295 exp(0.736 nu),   wc = (pi C Y/(2 E*))^2 b,   Pc = (4/3) (b/E*)^2 (pi C Y/2)^3
/// u < 1.9:   A = pi b w,               P = (4/3) E* b^.5 w^1.5
/// u >= 1.9:  A = pi b w (u/1.9)^B,     B = 0.14 exp(23 Y/E*)
///            P/Pc = exp(-u^(5/12)/4) u^1.5 + (4 HG/(C Y)) [1 - exp(-u^(5/9)/25)] u
///            HG/Y = 2.84 [1 - exp(-0.82 (a/b)^-0.7)],   a = (A/pi)^.5
/// ```
///
/// C Y is that of the body that yields first (the smaller C Y), Y alone that of the weaker one. A body without yield
/// strength and hardness never yields; one with a hardness must also have a yield strength, which is never derived.
///
/// The fit was made for steels with Y/E* from about 0.001 to 0.008, against a rigid flat, up to a/b = 0.41. Far beyond
/// that, near u = 1800, its load would decrease with indentation, for Y/E* above 0.0657 at nu = 0.5 and above 0.0761 at
/// nu = 0: pairs above 0.065 are rejected. The mean pressure tends to HG, which decreases with the contact radius: no
/// contact counts as plastic.
///
/// Jumps: the area is continuous; at u = 1.9 the load jumps by exp(-1.9^(5/12)/4) + (4 HG/(C Y)) [1 -
/// exp(-1.9^(5/9)/25)] 1.9^-.5, for small a/b by 1.0047 at nu = 0.3, by 1.0748 at 0, by 0.9678 at 0.49: it decreases
/// for nu above 0.3229, and for larger a/b, where HG is smaller, at smaller nu too (at 0.3 from Y/E* = 0.029 on).
///
/// The law does not depend on u alone, since HG depends on a/b and B on Y/E*. For one pair of bodies a/b follows from
/// u, so that [`Law::tuned`] tabulates the law. It is not defined for layered bodies.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JacksonGreen {
    tuned: Option<Arc<Tuned>>,
}

/// w/wc up to which the contact is Hertz's.
const ELASTIC: f64 = 1.9;

/// The largest Y/E*: beyond it the load would decrease somewhere with indentation.
const MAX_STRENGTH_RATIO: f64 = 0.065;

/// Range of Y/E* of the steels of the fit.
const FITTED: [f64; 2] = [0.001, 0.008];

/// P/Pc, d(P/Pc)/d ln w, and A/(pi b w).
#[derive(Debug, Clone, Copy)]
struct Normalised<N = f64> {
    load: N,
    load_slope: N,
    growth: N,
}

/// The law tabulated for one pair.
#[derive(Debug, PartialEq)]
struct Tuned {
    pair: Pair,
    /// P/Pc against u/1.9.
    load: Table,
    growth: Table,
}

impl Tuned {
    /// The octaves of u/1.9: u up to 2e12, far beyond w = b for any metal.
    const OCTAVES: std::ops::Range<i32> = 0..40;

    fn new(pair: &Pair) -> Self {
        let normalised = |v: f64| normalised(ELASTIC * v, pair);
        Self {
            pair: *pair,
            load: Table::new(Self::OCTAVES, |v| normalised(v).load),
            growth: Table::new(Self::OCTAVES, |v| normalised(v).growth),
        }
    }

    #[inline(always)]
    fn at<N: Real>(&self, v: N) -> Option<Normalised<N>> {
        let (load, load_slope) = self.load.at(v)?;
        let (growth, _) = self.growth.at(v)?;
        Some(Normalised { load, load_slope, growth })
    }
}

/// The law itself at `u` >= 1.9.
fn normalised(u: f64, pair: &Pair) -> Normalised {
    let YieldLimits { onset, strength } = pair.yield_limits;
    let exponent = 0.14 * (23.0 * strength / pair.reduced_modulus).exp();
    let growth = (u / ELASTIC).powf(exponent);
    let elastic = (-0.25 * u.powf(5.0 / 12.0)).exp() * u.powf(1.5);
    let elastic_slope = elastic * (1.5 - 5.0 / 48.0 * u.powf(5.0 / 12.0));

    // (a/b)^2 = A/(pi b^2).
    let width = (pair.ratio(CRITICAL) * u * growth).sqrt();
    let sharp = 0.82 * width.powf(-0.7);
    let sharp_slope = -0.35 * (1.0 + exponent) * sharp;
    let hardness = -(-sharp).exp_m1();
    let hardness_slope = (-sharp).exp() * sharp_slope;

    let spread = u.powf(5.0 / 9.0) / 25.0;
    let plastic = -(-spread).exp_m1();
    let plastic_slope = (-spread).exp() * (5.0 / 9.0) * spread;

    let factor = 4.0 * 2.84 * strength / onset * u;
    Normalised {
        load: elastic + factor * hardness * plastic,
        load_slope: elastic_slope
            + factor * (hardness * plastic + hardness_slope * plastic + hardness * plastic_slope),
        growth,
    }
}

impl JacksonGreen {
    /// Beyond the elastic range, at `v` = u/1.9.
    #[inline(always)]
    fn at<N: Real>(&self, v: N, pair: &Pairs<N>) -> Normalised<N> {
        // The law is not used under a layer: the pair is the same in every lane.
        let YieldLimits { onset, strength } = pair.yield_limits;
        let yield_limits = YieldLimits { onset: onset.first(), strength: strength.first() };
        let pair = Pair { reduced_modulus: pair.reduced_modulus.first(), yield_limits };
        if let Some(tuned) = self.tuned.as_ref().filter(|tuned| tuned.pair == pair)
            && let Some(normalised) = tuned.at(v)
        {
            return normalised;
        }
        let [load, load_slope, growth] = v.each(|v| {
            let Normalised { load, load_slope, growth } = normalised(ELASTIC * v, &pair);
            [load, load_slope, growth]
        });
        Normalised { load, load_slope, growth }
    }
}

impl Law for JacksonGreen {
    fn name(&self) -> &'static str {
        "jackson-green"
    }

    fn about(&self) -> &'static str {
        "A finite-element fit in which the limiting mean pressure decreases as the contact grows; elastic \
         up to 1.9 times its own critical indentation. Fitted for steels with Y/E* from 0.001 to 0.008 and \
         up to a/R = 0.41."
    }

    fn papers(&self) -> &'static [Paper] {
        &[literature::JACKSON_GREEN_2005]
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        match (body.yield_strength(), body.hardness()) {
            (Some(strength), _) => {
                Ok(YieldLimits { onset: 1.295 * (0.736 * body.poisson()).exp() * strength, strength })
            }
            (None, Some(_)) => Err(Property::YieldStrength),
            (None, None) => Ok(YieldLimits::NEVER_YIELDS),
        }
    }

    fn needs(&self) -> Option<Property> {
        Some(Property::YieldStrength)
    }

    fn check(&self, pair: &Pair) -> Result<(), Inapplicable> {
        let ratio = pair.yield_limits.strength / pair.reduced_modulus;
        if ratio <= MAX_STRENGTH_RATIO {
            Ok(())
        } else {
            Err(Inapplicable::TooStrong { law: self.name(), ratio, most: MAX_STRENGTH_RATIO })
        }
    }

    fn caveat(&self, pair: &Pair) -> Option<String> {
        let ratio = pair.yield_limits.strength / pair.reduced_modulus;
        let [from, to] = FITTED;
        (!(from..=to).contains(&ratio))
            .then(|| format!("law {}: Y/E* = {ratio:.4}; it was fitted for {from} to {to}", self.name()))
    }

    fn tuned(self, pair: &Pair) -> Self {
        Self { tuned: Some(Arc::new(Tuned::new(pair))) }
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        let critical = pair.ratio(CRITICAL) * b;
        // 0 if the pair never yields.
        let u = w / critical;
        let elastic = u.lt(w.splat(ELASTIC));
        if elastic.all() {
            return Hertz::elastic(w, b, pair.reduced_modulus);
        }
        let v = N::select(elastic, w.splat(1.0), u / ELASTIC);
        let normalised = self.at(v, pair);
        let critical_load = pair.yield_limits.onset * (2.0 / 3.0 * PI) * b * critical;
        let nowhere = !w.all_true();
        let between = Contacts {
            area: b * PI * w * normalised.growth,
            load: critical_load * normalised.load,
            stiffness: critical_load * normalised.load_slope / w,
            elastic: nowhere,
            plastic: nowhere,
        };
        if elastic.any() {
            let springing = Hertz::elastic(w, b, pair.reduced_modulus);
            return Contacts::select(elastic, &springing, &between);
        }
        between
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        let first = pair.ratio(ELASTIC * CRITICAL);
        if first.is_finite() { vec![first] } else { Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least d ln P/d ln u from u = 1.9 to 1e8.
    fn least_exponent(ratio: f64, poisson: f64) -> f64 {
        let (modulus, strength) = (1e11, ratio * 1e11);
        let onset = 1.295 * f64::exp(0.736 * poisson) * strength;
        let pair = Pair { reduced_modulus: modulus, yield_limits: YieldLimits { onset, strength } };
        let exponent = |k: i32| {
            let found = normalised(ELASTIC * 1.003f64.powi(k), &pair);
            found.load_slope / found.load
        };
        (0..5900).map(exponent).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_load_falls_beyond_the_strongest_pairs_and_not_before() {
        for poisson in [0.0, 0.3, 0.5] {
            assert!(least_exponent(MAX_STRENGTH_RATIO, poisson) > 0.0, "{poisson}");
        }
        assert!(least_exponent(0.0656, 0.4999) > 0.0 && least_exponent(0.0659, 0.4999) < 0.0);
        assert!(least_exponent(0.0760, 0.0) > 0.0 && least_exponent(0.0763, 0.0) < 0.0);
    }
}
