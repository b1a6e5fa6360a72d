//! The effective modulus and Poisson's ratio of a layered flat (Pasaribu and Schipper 2005, Eqs. 14, 15, 17-19).

use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::weights::{LOG_PEAK, POLE_PEAK, SWELL_PEAK, Weights};
use crate::material::Material;
use crate::named_enum;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;
use crate::numeric::table::Table;

/// The octaves of a/t that the tables cover.
const OCTAVES: Range<i32> = -24..24;

named_enum! {
    /// The effective-modulus model, which combines the moduli of layer and substrate.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum ModulusModel {
        /// E_eff = E_s + (E_l - E_s) I0 (Eq. 15; Gao, Chiu and Lee 1992, Swain and Mencik 1994): exact to first order in
        /// the mismatch, accurate for E_l/E_s of 0.5 to 2.
        #[default]
        Gao = "gao",
        /// 1/mu = (1 - I0)/mu_s + I0/mu_l, mu the shear modulus (Song and Pharr 1999): compliances in series with the same
        /// weights.
        Series = "series",
    }
}

/// One of the two bodies, and its differences from the other.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    poisson: f64,
    poisson_step: f64,
    /// E in Gao's model, 1/mu in series.
    modulus: f64,
    modulus_step: f64,
}

/// Effective modulus and Poisson's ratio of a pair of materials as functions of a/t, independent of the thickness.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EffectiveModulus {
    sides: Sides,
    /// The compliance, analytic except at 0, at +-i and at zeros of E_eff, none of which is nearer to the positive axis
    /// than to 0. One polynomial replaces an arctangent, a logarithm and ten divisions.
    table: Arc<Table>,
    /// nu_eff, tabulated when a law first needs it.
    poisson: Arc<OnceLock<Table>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Sides {
    model: ModulusModel,
    layer: Side,
    substrate: Side,
}

/// That of the last pair of materials: flats that differ in thickness or hardness follow each other, and a table takes most of the time of one.
static LAST: Mutex<Option<EffectiveModulus>> = Mutex::new(None);

impl EffectiveModulus {
    pub(super) fn new(model: ModulusModel, layer: &Material, substrate: &Material) -> Self {
        let sides = Sides::new(model, layer, substrate);
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = last.as_ref().filter(|known| known.sides == sides) {
            return known.clone();
        }
        let table = Table::new(OCTAVES, |inverse| sides.at(inverse).0);
        let new = Self { sides, table: Arc::new(table), poisson: Arc::default() };
        *last = Some(new.clone());
        new
    }

    pub(super) fn model(&self) -> ModulusModel {
        self.sides.model
    }

    /// nu_eff (Eq. 14) at `inverse` = 1/xi = a/t.
    pub(super) fn poisson(&self, inverse: f64) -> f64 {
        self.sides.poisson(&Weights::at(inverse))
    }

    /// The contribution (1 - nu_eff^2)/E_eff of the flat to 1/E*, 1/Pa, and its d/d ln w, at each `inverse` = 1/xi =
    /// a/t.
    #[inline(always)]
    pub(super) fn compliance<N: Real>(&self, inverse: N) -> (N, N) {
        let (value, slope) = match self.table.at(inverse) {
            Some(found) => found,
            None => self.outside(inverse),
        };
        // a grows as the square root of w.
        (value, slope * 0.5)
    }

    #[inline(always)]
    fn outside<N: Real>(&self, inverse: N) -> (N, N) {
        let [value, slope] = inverse.each(|inverse| self.sides.at(inverse).into());
        (value, slope)
    }

    /// nu_eff (Eq. 14) and its d/d ln w at each `inverse` = 1/xi = a/t.
    #[inline(always)]
    pub(super) fn poisson_and_slope<N: Real>(&self, inverse: N) -> (N, N) {
        let sides = &self.sides;
        let table = self.poisson.get_or_init(|| Table::new(OCTAVES, |x| sides.poisson(&Weights::at(x))));
        let [value, slope] = match table.at(inverse) {
            Some(found) => found.into(),
            None => inverse.each(|inverse| {
                let weights = Weights::at(inverse);
                // ln xi decreases with ln a.
                [sides.poisson(&weights), -sides.substrate.poisson_step * weights.log]
            }),
        };
        (value, slope * 0.5)
    }

    /// The range between Poisson's ratios of layer and substrate.
    pub(super) fn poisson_range(&self) -> Interval {
        Interval::between(self.sides.layer.poisson, self.sides.substrate.poisson)
    }

    /// The distance beyond 0, in a/t, at which the compliance is -`other` (1/Pa), with E_eff, or 1/mu_eff in series,
    /// extrapolated linearly from that of the layer. Infinite if it decreases instead.
    pub(super) fn pole(&self, other: f64) -> f64 {
        /// Where the nonlinear part is below rounding.
        const NEAR: f64 = 1e-9;
        let (value, slope) = self.sides.at(NEAR);
        let growth = slope / (value * NEAR);
        let pole = match self.sides.model {
            ModulusModel::Gao => (1.0 + value / other) / -growth,
            ModulusModel::Series => (1.0 + other / value) / growth,
        };
        if pole > 0.0 { pole } else { f64::INFINITY }
    }

    /// Bounds of compliance and nu_eff over a range of `inverse` = 1/xi, each with bounds of its d/d ln w.
    pub(super) fn over(&self, inverse: Interval) -> [(Interval, Interval); 2] {
        self.sides.over(inverse).map(|(value, slope)| (value, slope * 0.5))
    }
}

impl Sides {
    fn new(model: ModulusModel, layer: &Material, substrate: &Material) -> Self {
        let modulus = |body: &Material| match model {
            ModulusModel::Gao => body.young(),
            ModulusModel::Series => 2.0 * (1.0 + body.poisson()) / body.young(),
        };
        let side = |from: &Material, to: &Material| Side {
            poisson: from.poisson(),
            poisson_step: to.poisson() - from.poisson(),
            modulus: modulus(from),
            modulus_step: modulus(to) - modulus(from),
        };
        Self { model, layer: side(layer, substrate), substrate: side(substrate, layer) }
    }

    /// The body of larger weight.
    #[inline]
    fn side(&self, weights: &Weights) -> &Side {
        if weights.in_layer { &self.layer } else { &self.substrate }
    }

    /// nu_eff (Eq. 14).
    #[inline]
    fn poisson(&self, weights: &Weights) -> f64 {
        let side = self.side(weights);
        side.poisson + side.poisson_step * weights.of_poisson()
    }

    /// E_eff (Eq. 15), or 1/mu_eff.
    #[inline]
    fn modulus(&self, weights: &Weights, poisson: f64) -> f64 {
        let side = self.side(weights);
        side.modulus + side.modulus_step * weights.of_modulus(poisson)
    }

    /// The compliance at `inverse` = 1/xi, and its d/d ln(1/xi).
    fn at(&self, inverse: f64) -> (f64, f64) {
        let weights = Weights::at(inverse);
        let poisson = self.poisson(&weights);
        let modulus = self.modulus(&weights, poisson);
        // Derivatives in ln xi: of nu, of I0 at fixed nu and through nu, of E or 1/mu.
        let poisson_slope = self.substrate.poisson_step * weights.log;
        let rest = (1.0 - poisson).recip();
        let weight_slope = weights.slope_of_modulus(poisson)
            - 0.5 * (weights.log + weights.pole) * rest * rest * poisson_slope;
        let modulus_slope = self.substrate.modulus_step * weight_slope / modulus;
        let (value, slope) = match self.model {
            ModulusModel::Gao => (
                (1.0 - poisson) * (1.0 + poisson) / modulus,
                -2.0 * poisson * rest / (1.0 + poisson) * poisson_slope - modulus_slope,
            ),
            ModulusModel::Series => (0.5 * (1.0 - poisson) * modulus, modulus_slope - rest * poisson_slope),
        };
        (value, -value * slope)
    }

    /// Bounds of the values of [`Self::at`], and of nu_eff and its d/d ln(1/xi): nu_eff is linear in I1, which
    /// increases with xi; I0 increases with xi and decreases with nu. The three unimodal terms of the slope are bounded
    /// by their ends and peaks.
    fn over(&self, inverse: Interval) -> [(Interval, Interval); 2] {
        let (thick, thin) = (Weights::at(inverse.low), Weights::at(inverse.high));
        let poisson = Interval::between(self.poisson(&thick), self.poisson(&thin));
        let modulus = Interval::between(self.modulus(&thick, poisson.low), self.modulus(&thin, poisson.high));
        let hump = |value: fn(&Weights) -> f64, peak: f64| {
            let ends = Interval::between(value(&thick), value(&thin));
            if inverse.contains(peak) { ends.hull(Interval::point(value(&Weights::at(peak)))) } else { ends }
        };
        let log = hump(|weights| weights.log, LOG_PEAK);
        let pole = hump(|weights| weights.pole, POLE_PEAK);
        let swell = hump(Weights::swell, SWELL_PEAK);

        let rest = (-poisson + 1.0).recip();
        let poisson_slope = log * self.substrate.poisson_step;
        let weight_slope = (swell + (poisson * -2.0 + 1.0) * log) * rest * 0.5
            - (log + pole) * rest * rest * poisson_slope * 0.5;
        let modulus_slope = weight_slope * modulus.recip() * self.substrate.modulus_step;
        let (value, slope) = match self.model {
            ModulusModel::Gao => {
                let plane = Interval::between(
                    (1.0 - poisson.low) * (1.0 + poisson.low),
                    (1.0 - poisson.high) * (1.0 + poisson.high),
                );
                let share = poisson * rest * (poisson + 1.0).recip();
                (plane * modulus.recip(), -(share * poisson_slope * 2.0) - modulus_slope)
            }
            ModulusModel::Series => ((-poisson + 1.0) * modulus * 0.5, modulus_slope - rest * poisson_slope),
        };
        // ln xi = -ln(1/xi).
        [(value, -(value * slope)), (poisson, -poisson_slope)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However far the moduli lie apart: no zero of E_eff comes near the axis.
    #[test]
    fn the_table_is_the_formula() {
        let mut worst = (0.0f64, 0.0f64);
        for model in ModulusModel::ALL {
            for ratio in [1e-6, 1e-3, 0.1, 0.9, 1.1, 10.0, 1e3, 1e6] {
                for (nu_layer, nu_substrate) in [(0.0, 0.499), (0.499, 0.0), (0.3, 0.3)] {
                    let body = |young, nu| Material::new(young, nu, None, None).unwrap();
                    let pair = (body(ratio * 1e11, nu_layer), body(1e11, nu_substrate));
                    let modulus = EffectiveModulus::new(model, &pair.0, &pair.1);
                    for k in -4000..4000 {
                        let inverse = (f64::from(k) * 4.1e-3).exp();
                        let (value, slope) = modulus.table.at(inverse).unwrap();
                        let (exact, exact_slope) = modulus.sides.at(inverse);
                        worst.0 = worst.0.max((value / exact - 1.0).abs());
                        worst.1 = worst.1.max((slope - exact_slope).abs() / exact);
                    }
                }
            }
        }
        assert!(worst.0 < 5e-15 && worst.1 < 5e-12, "{worst:?}");
    }
}
