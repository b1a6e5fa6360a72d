//! Zhao, Maietta and Chang: from elastic deformation to fully plastic flow.

use std::f64::consts::PI;
use std::ops::Bound;

use super::regimes::in_range;
use super::{Hertz, Law, LawOption, OptionError, Pair, Pairs, Property, ScalableLaw, YieldLimits};
use crate::contact::Contacts;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::LARGEST;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{Mask, Real};

/// The elastic - elastic-plastic - plastic sphere of Zhao, Maietta and Chang (2000), in the notation
/// of Pasaribu and Schipper (2005):
///
/// ```text
/// w1 = onset b (H/E*)^2,  w2 = c w1                                   (Eqs. 2, 4)
/// w <= w1:  A = pi b w,                     P = (4/3) E* b^.5 w^1.5    (Eqs. 6, 10)
/// w <  w2:  A = pi b w [1 + 3x^2 - 2x^3],   P = H [1 - 0.6 ln(w2/w)/ln c] A    (Eqs. 7, 11)
/// w >= w2:  A = 2 pi b w,                   P = H A                    (Eqs. 8, 12)
/// with x = (w - w1)/(w2 - w1)
/// ```
///
/// Jumps: none with the default onset (0.3 pi)^2. The area is C1 at w1 and C0 at w2; of the load, d ln P/d ln w drops
/// at both. With the rounded onset 0.89 the load drops by 0.0976 % at w1; with any other onset k it changes there by
/// the factor 0.3 pi/k^.5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zmc {
    onset: f64,
    transition_ratio: f64,
    inverse_log_ratio: f64,
}

/// w1 E*^2/(b H^2).
const ONSET: LawOption = LawOption {
    name: "onset",
    about: "w1 E*^2/(b H^2), the dimensionless onset of yield",
    default: Zmc::ONSET,
    example: 0.89,
    range: (Bound::Included(1.0 / LARGEST), Bound::Included(LARGEST)),
    allowed: "a positive finite number ((0.3 pi)^2 = 0.8883 makes the load continuous)",
};

/// c.
const TRANSITION_RATIO: LawOption = LawOption {
    name: "transition-ratio",
    about: "c = w2/w1, the onset of full plasticity over that of yield",
    default: Zmc::TRANSITION_RATIO,
    example: 110.0,
    range: (Bound::Excluded(1.0), Bound::Included(LARGEST)),
    allowed: "a finite number above 1 (54 in Zhao, Maietta, Chang 2000)",
};

impl Zmc {
    /// Description of the law for ellipses.
    pub(crate) const ON_ELLIPSES: &str = "The regimes of Zhao, Maietta and Chang for an elliptic paraboloid: Hertz's contact ellipse from the two \
         principal curvatures, and the onset of yield of that ellipse. Derived here from Hertz's solution, not fitted.";

    /// (0.3 pi)^2 = (3 pi k/4)^2 with k = 0.4: the onset of yield that makes the load continuous.
    pub const ONSET: f64 = 0.09 * PI * PI;

    /// w2/w1 of Zhao, Maietta and Chang (2000), Eq. 4 of Pasaribu and Schipper (2005).
    pub const TRANSITION_RATIO: f64 = 54.0;

    /// The law with the onset coefficient w1 E*^2/(b H^2) and the transition ratio c = w2/w1.
    ///
    /// # Errors
    /// An onset that is not positive and finite; a ratio that is not finite and above 1.
    pub fn new(onset: f64, transition_ratio: f64) -> Result<Self, OptionError> {
        ONSET.check(onset)?;
        TRANSITION_RATIO.check(transition_ratio)?;
        Ok(Self { onset, transition_ratio, inverse_log_ratio: transition_ratio.ln().recip() })
    }

    /// Eqs. 7 and 11 at `u` = w/w1, x = (u - 1)/(c - 1), and their slopes:
    ///
    /// ```text
    /// A = pi b w r,   r = 1 + 3x^2 - 2x^3 = 1 + x^2 (3 - 2x),   dA/dw = pi b [r + 6 (x - x^2) u/(c - 1)]
    /// P = p A,        p = H [1 - 0.6 ln(c/u)/ln c] = 0.4 H + s ln u,   s = 0.6 H/ln c,   dp/dw = s/w
    /// ```
    #[inline(always)]
    fn elastic_plastic<N: Real>(&self, w: N, b: N, u: N, hardness: N) -> Contacts<N> {
        let span = self.transition_ratio - 1.0;
        let x = (u - 1.0) * span.recip();
        let three_minus_two_x = x.polynomial(&[-2.0, 3.0]);
        let area_ratio = (x * x).mul_add(three_minus_two_x, w.splat(1.0));
        let area_over_w = b * PI * area_ratio;
        let area_slope = (b * PI).mul_add(u * (6.0 / span) * (x - x * x), area_over_w);
        let area = area_over_w * w;
        let pressure_slope = hardness * (0.6 * self.inverse_log_ratio);
        let pressure = u.ln().mul_add(pressure_slope, hardness * 0.4);
        let nowhere = !w.all_true();
        Contacts {
            area,
            load: pressure * area,
            stiffness: pressure.mul_add(area_slope, pressure_slope * area_over_w),
            elastic: nowhere,
            plastic: nowhere,
        }
    }

    /// d ln P/d ln w of elastic-plastic contacts over a range of x.
    fn exponents_between(&self, x: Interval) -> Interval {
        let span = self.transition_ratio - 1.0;
        let growth = |x: f64| 1.0 + x * x * (3.0 - 2.0 * x);
        let slope = 0.6 * self.inverse_log_ratio;
        let pressure = |x: f64| slope / (0.4 + slope * (span * x).ln_1p());
        let steep = x.of_unimodal(|x| 6.0 * x * (1.0 - x), 0.5);
        Interval {
            low: 1.0 + pressure(x.high) + (x.low + span.recip()) * steep.low / growth(x.high),
            high: 1.0 + pressure(x.low) + (x.high + span.recip()) * steep.high / growth(x.low),
        }
    }
}

impl Default for Zmc {
    fn default() -> Self {
        Self {
            onset: Self::ONSET,
            transition_ratio: Self::TRANSITION_RATIO,
            inverse_log_ratio: Self::TRANSITION_RATIO.ln().recip(),
        }
    }
}

impl Law for Zmc {
    fn name(&self) -> &'static str {
        "zmc"
    }

    fn about(&self) -> &'static str {
        "Elastic up to w1; fully plastic from w2 = c w1, with the hardness as mean pressure and twice the \
         elastic area; in between, the mean pressure is logarithmic in w and the area interpolated by a \
         cubic. Load and area are continuous with the default onset."
    }

    fn papers(&self) -> &'static [Paper] {
        &[literature::ZHAO_MAIETTA_CHANG_2000, literature::PASARIBU_SCHIPPER_2005]
    }

    fn options(&self) -> &'static [LawOption] {
        &[ONSET, TRANSITION_RATIO]
    }

    fn option_values(&self) -> Vec<f64> {
        vec![self.onset, self.transition_ratio]
    }

    fn with_options(self, values: &[f64]) -> Result<Self, OptionError> {
        Self::new(values[0], values[1])
    }

    fn yields_by(&self) -> Option<Property> {
        Some(Property::Hardness)
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        Ok(self.yield_limits_by_hardness(body))
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        // Infinite where neither body yields.
        let w1 = pair.ratio(self.onset) * b;
        let elastic = w.le(w1);
        if elastic.all() {
            return Hertz::elastic(w, b, pair.reduced_modulus);
        }
        let u = w / w1;
        let plastic = w.splat(self.transition_ratio).le(u);
        let between = self.elastic_plastic(w, b, u, pair.yield_limits.onset);
        in_range(w, b, pair, [elastic, plastic], between)
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        let w1 = pair.ratio(self.onset);
        if w1.is_finite() { vec![w1, self.transition_ratio * w1] } else { Vec::new() }
    }
}

impl ScalableLaw for Zmc {
    /// 1.5 in the elastic and 1 in the plastic range. In between it is 1 plus terms of mean pressure and area, each
    /// bounded by its extremes on pieces of x.
    fn load_exponents(&self, u: Interval) -> Interval {
        /// Number of pieces of x from 0 to 1.
        const PIECES: f64 = 64.0;
        let span = self.transition_ratio - 1.0;
        let place = |u: f64| ((u / self.onset - 1.0) / span).clamp(0.0, 1.0);
        let x = Interval { low: place(u.low), high: place(u.high) };
        let elastic = (u.low <= self.onset).then_some(Interval::point(1.5));
        let plastic = (u.high >= self.transition_ratio * self.onset).then_some(Interval::point(1.0));
        let count = ((x.high - x.low) * PIECES).ceil();
        let between = (0..count as i32).map(|k| {
            let end = |k: i32| x.low + (x.high - x.low) * f64::from(k) / count;
            self.exponents_between(Interval { low: end(k), high: end(k + 1) })
        });
        let all = elastic.into_iter().chain(plastic).chain(between).reduce(Interval::hull);
        all.unwrap_or_else(|| self.exponents_between(x))
    }
}
