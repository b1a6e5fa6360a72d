//! The effective hardness of a layered flat (Pasaribu and Schipper 2005, Eq. 16; Bhattacharya and Nix 1988).

use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;

/// H_eff(w), with x the exponent:
///
/// ```text
/// softer layer:  H_s + (H_l - H_s) exp(-x),  x = (Y_l/Y_s) (E_s/E_l) (w/t)^2
/// harder layer:  H_s + (H_l - H_s) exp(-x),  x = (H_l/H_s)/((Y_l/Y_s) (E_l/E_s)^.5) (w/t)
/// ```
///
/// It changes monotonically from H_l to H_s with increasing w. A yield strength that is not given is taken as H/3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EffectiveHardness {
    layer: f64,
    substrate: f64,
    /// The coefficient of (w/t)^power in x.
    factor: f64,
    is_softer: bool,
}

/// The exponent x beyond which the layer has no effect, whatever its hardness.
const MAX_EXPONENT: f64 = 180.0;

impl EffectiveHardness {
    /// The effective hardness; `None` if neither body has a hardness.
    pub(super) fn new(layer: &Material, substrate: &Material) -> Option<Self> {
        let (of_layer, of_substrate) = layer.hardness().zip(substrate.hardness())?;
        let strength = |body: &Material, hardness: f64| body.yield_strength().unwrap_or(hardness / 3.0);
        let strengths = strength(layer, of_layer) / strength(substrate, of_substrate);
        let moduli = layer.young() / substrate.young();
        let is_softer = of_layer < of_substrate;
        let factor = if is_softer {
            strengths / moduli
        } else {
            of_layer / of_substrate / (strengths * moduli.sqrt())
        };
        Some(Self { layer: of_layer, substrate: of_substrate, factor, is_softer })
    }

    fn power(&self) -> f64 {
        if self.is_softer { 2.0 } else { 1.0 }
    }

    /// Hardness and dH/d ln w, Pa, at `depth` = w/t.
    #[inline(always)]
    pub(super) fn at<N: Real>(&self, depth: N) -> (N, N) {
        let linear = depth * self.factor;
        let x = if self.is_softer { linear * depth } else { linear };
        // exp(-x) and exp(-x) - 1.
        let (left, lost) = (-x).exp_and_exp_m1();
        let step = self.layer - self.substrate;
        // A sum of positive terms in either case.
        let hardness = if self.is_softer { lost * step + self.layer } else { left * step + self.substrate };
        let rate = -step * self.power();
        (hardness, x.min(x.splat(MAX_EXPONENT)) * rate * left)
    }

    /// Bounds of the hardness (Pa) and of d ln H/d ln w over the range `depth` of w/t.
    pub(super) fn over(&self, depth: Interval) -> (Interval, Interval) {
        let ends = [self.at(depth.low), self.at(depth.high)];
        let hardness = Interval::between(ends[0].0, ends[1].0);
        // x exp(-x) is highest at x = 1.
        let swell = |(_, slope): (f64, f64)| slope.abs();
        let [low, high] = ends.map(swell);
        let mut swells = Interval::between(low, high);
        let peak = self.depth(1.0);
        if depth.contains(peak) {
            swells = swells.hull(Interval::point(swell(self.at(peak))));
        }
        let size = swells * hardness.recip();
        (hardness, if self.is_softer { size } else { -size })
    }

    /// The depth w/t at which H_eff equals `hardness` (Pa); `None` if there is none.
    pub(super) fn reaching(&self, hardness: f64) -> Option<f64> {
        let left = (hardness - self.substrate) / (self.layer - self.substrate);
        (left > 0.0 && left < 1.0).then(|| self.depth(-left.ln()))
    }

    fn depth(&self, x: f64) -> f64 {
        (x / self.factor).powf(self.power().recip())
    }

    /// Depths w/t, ascending, between which H, 1/H and ln H are smooth enough for a quadrature panel. Their
    /// singularities are the complex zeros of H_eff, 2 pi apart in x.
    pub(super) fn scales(&self) -> Vec<f64> {
        const STEPS: [f64; 5] = [0.5, 4.0, 10.0, 20.0, 40.0];
        let ratio = self.layer / self.substrate;
        let first = (self.is_softer && ratio < 0.3).then_some(ratio);
        first.into_iter().chain(STEPS).map(|x| self.depth(x)).collect()
    }

    /// The range from H_l to H_s, Pa.
    pub(super) fn range(&self) -> Interval {
        Interval::between(self.layer, self.substrate)
    }

    /// The depth w/t beyond which H_eff is constant.
    pub(super) fn end(&self) -> f64 {
        self.depth(MAX_EXPONENT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(layer: f64, substrate: f64) -> EffectiveHardness {
        let body = |young, hardness| Material::new(young, 0.3, Some(hardness), None).unwrap();
        EffectiveHardness::new(&body(18e9, layer), &body(210e9, substrate)).unwrap()
    }

    #[test]
    fn from_the_layer_to_the_substrate() {
        for (layer, substrate) in [(0.17e9, 7.6e9), (21e9, 7.6e9), (5e9, 5e9), (1e30, 1e-30)] {
            let found = of(layer, substrate);
            assert_eq!(found.at(1e-23).0, layer);
            assert!(
                (found.at(1e7).0 / substrate - 1.0).abs() < 1e-15
                    && found.at(1e7).1.abs() < 1e-12 * substrate
            );
        }
    }

    /// With yield strengths in the ratio of the hardnesses the factors are (H_l/H_s)(E_s/E_l) and (E_s/E_l)^.5.
    #[test]
    fn factors_without_yield_strengths() {
        let x = |layer: f64, power: i32, factor: f64| {
            let (hardness, _) = of(layer, 7.6e9).at(0.5);
            let expected = 7.6e9 + (layer - 7.6e9) * (-factor * 0.5f64.powi(power)).exp();
            assert!((hardness / expected - 1.0).abs() < 1e-14, "{hardness:e} {expected:e}");
        };
        x(0.17e9, 2, 0.17 / 7.6 * 210.0 / 18.0);
        x(21e9, 1, (210.0f64 / 18.0).sqrt());
    }

    #[test]
    fn given_yield_strengths_are_used() {
        let body =
            |young, hardness, strength| Material::new(young, 0.3, Some(hardness), Some(strength)).unwrap();
        let found = EffectiveHardness::new(&body(18e9, 0.17e9, 10e6), &body(210e9, 7.6e9, 2e9)).unwrap();
        let expected = 7.6e9 - 7.43e9 * (-(10e6 / 2e9) * (210.0 / 18.0) * 4.0f64).exp();
        assert!((found.at(2.0).0 / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_depth_of_a_hardness() {
        let found = of(0.17e9, 7.6e9);
        let w = found.reaching(3e9).unwrap();
        assert!((found.at(w).0 / 3e9 - 1.0).abs() < 1e-13);
        assert_eq!((found.reaching(8e9), found.reaching(0.1e9), found.reaching(7.6e9)), (None, None, None));
        assert_eq!(of(5e9, 5e9).reaching(5e9), None);
    }
}
