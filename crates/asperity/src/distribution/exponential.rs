//! Exponential heights.

use std::fmt;

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use statrs::distribution::{ContinuousCDF, Exp};

use super::normal::{PANELS, log_hazard};
use super::{Entry, Exponent, FOLDINGS, FOLDINGS_PER_PANEL, HeightDistribution, Heights, whole_panels};
use crate::literature::{GREENWOOD_WILLIAMSON_1966, Paper};
use crate::numeric::lanes::Real;

pub(super) const ENTRY: Entry =
    Entry { name: "exponential", parameters: &[], make: |_| Ok(Heights::EXPONENTIAL) };

/// Exponential heights, z >= -1. For homogeneous bodies the area is then exactly proportional to the load under any law
/// (Greenwood and Williamson 1966).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exponential;

impl Exponent for Exponential {
    #[inline(always)]
    fn exponent<N: Real>(self, h: f64, x: N) -> N {
        if h >= -1.0 { x } else { (x + h) + 1.0 }
    }
}

impl fmt::Display for Exponential {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

impl HeightDistribution for Exponential {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn label(&self) -> &'static str {
        "exponential"
    }

    fn papers(&self) -> &'static [Paper] {
        &[GREENWOOD_WILLIAMSON_1966]
    }

    fn skewness(&self) -> f64 {
        2.0
    }

    fn kurtosis(&self) -> f64 {
        9.0
    }

    fn support(&self) -> [f64; 2] {
        [-1.0, f64::INFINITY]
    }

    fn density(&self, z: f64) -> f64 {
        if z < -1.0 { 0.0 } else { (-(z + 1.0)).exp() }
    }

    fn survival(&self, z: f64) -> f64 {
        (-(z + 1.0)).exp().min(1.0)
    }

    fn quantile(&self, p: f64) -> f64 {
        match Exp::new(1.0) {
            Ok(unit) => unit.inverse_cdf(p) - 1.0,
            Err(_) => unreachable!("the unit rate is valid"),
        }
    }

    fn height_at_normal(&self, g: f64) -> f64 {
        log_hazard(&PANELS, g).exp() - 1.0
    }

    fn draw(&self, rng: &mut ChaCha8Rng, heights: &mut [f64]) {
        for z in heights {
            let excess: f64 = Exp1.sample(rng);
            *z = excess - 1.0;
        }
    }

    fn decreasing_from(&self) -> f64 {
        -1.0
    }

    fn highest_separation(&self) -> f64 {
        745.0
    }

    fn scale(&self, h: f64) -> f64 {
        if h >= -1.0 { (-(h + 1.0)).exp() } else { 1.0 }
    }

    fn window(&self, h: f64) -> [f64; 2] {
        let start = (-1.0 - h).max(0.0);
        [start, start + FOLDINGS]
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        let foldings = (self.exponent(h, to) - self.exponent(h, from)).abs();
        whole_panels(foldings / FOLDINGS_PER_PANEL)
    }

    fn variable_is_indentation(&self) -> bool {
        true
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        (-self.exponent(h, x)).exp()
    }

    fn apply_density(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        self.apply_exponent(h, nodes, weights);
    }
}
