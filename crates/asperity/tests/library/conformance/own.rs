//! A law from outside of the library.

use std::f64::consts::PI;

use asperity::law::{LawOption, OptionError, Property};
use asperity::numeric::lanes::{Mask, Real};
use asperity::numeric::{Interval, LARGEST};
use asperity::{Contacts, FullyPlastic, Hertz, Law, Material, Pair, Pairs, Paper, ScalableLaw, YieldLimits};
use std::ops::Bound;

/// Hertz up to w = onset b (H/E*)^2, Abbott and Firestone from there on, with nothing between.
#[derive(Clone)]
pub struct Abrupt {
    pub onset: f64,
}

const ONSET: LawOption = LawOption {
    name: "onset",
    about: "w1 E*^2/(b H^2)",
    default: 1.0,
    example: 2.0,
    range: (Bound::Excluded(0.0), Bound::Included(LARGEST)),
    allowed: "a positive number",
};

impl Law for Abrupt {
    fn name(&self) -> &'static str {
        "abrupt"
    }

    fn about(&self) -> &'static str {
        "Elastic, then plastic."
    }

    fn papers(&self) -> &'static [Paper] {
        &[]
    }

    fn options(&self) -> &'static [LawOption] {
        &[ONSET]
    }

    fn option_values(&self) -> Vec<f64> {
        vec![self.onset]
    }

    fn with_options(self, values: &[f64]) -> Result<Self, OptionError> {
        ONSET.check(values[0])?;
        Ok(Self { onset: values[0] })
    }

    fn yields_by(&self) -> Option<Property> {
        Some(Property::Hardness)
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        Ok(self.yield_limits_by_hardness(body))
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        let elastic = w.lt(pair.ratio(self.onset) * b);
        let hertz = Hertz.contacts(w, b, pair);
        if elastic.all() {
            return hertz;
        }
        Contacts::select(elastic, &hertz, &FullyPlastic.contacts(w, b, pair))
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        Some(pair.ratio(self.onset)).filter(|ratio| ratio.is_finite()).into_iter().collect()
    }
}

impl ScalableLaw for Abrupt {
    fn load_exponents(&self, u: Interval) -> Interval {
        let [low, high] = [u.high, u.low].map(|u| if u < self.onset { 1.5 } else { 1.0 });
        Interval { low, high }
    }
}

/// The load above the boundary over that below it.
pub fn jump(onset: f64) -> f64 {
    1.5 * PI / onset.sqrt()
}
