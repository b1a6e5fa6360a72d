//! Gaussian heights.

use std::f64::consts::{PI, SQRT_2};
use std::fmt;

use libm::erfc;

use super::normal::normal_quantiles;
use super::{
    Entry, Exponent, FOLDINGS, FOLDINGS_PER_BELL, FOLDINGS_PER_PANEL, HeightDistribution, Heights,
    whole_panels,
};
use crate::literature::{GREENWOOD_WILLIAMSON_1966, Paper, ZHAO_MAIETTA_CHANG_2000};
use crate::numeric::lanes::Real;

pub(super) const ENTRY: Entry = Entry { name: "gaussian", parameters: &[], make: |_| Ok(Heights::GAUSSIAN) };

/// Normal heights (Greenwood and Williamson 1966; Zhao, Maietta and Chang 2000).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gaussian;

impl Exponent for Gaussian {
    #[inline(always)]
    fn exponent<N: Real>(self, h: f64, x: N) -> N {
        if h >= 0.0 { x * (x * 0.5 + h) } else { (x + h) * 0.5 * (x + h) }
    }
}

impl Gaussian {
    /// -ln of the density at the height h + x relative to [`scale`](HeightDistribution::scale).
    #[inline(always)]
    pub fn exponent<N: Real>(self, h: f64, x: N) -> N {
        Exponent::exponent(self, h, x)
    }

    /// Whether the density has its maximum between the indentations `from` and `to`.
    pub fn contains_peak(self, h: f64, from: f64, to: f64) -> bool {
        from < -h && -h < to
    }

    /// The change of ln(density) between the indentations `from` and `to`: its e-foldings.
    pub fn e_foldings(self, h: f64, from: f64, to: f64) -> f64 {
        let (start, end) = (self.exponent(h, from), self.exponent(h, to));
        if self.contains_peak(h, from, to) { start + end } else { (end - start).abs() }
    }

    /// Number of panels, not rounded, that resolve the density between the indentations `from` and `to`.
    pub(super) fn fractional_panels(self, h: f64, from: f64, to: f64) -> f64 {
        let resolved = if self.contains_peak(h, from, to) { FOLDINGS_PER_BELL } else { FOLDINGS_PER_PANEL };
        self.e_foldings(h, from, to) / resolved
    }
}

impl fmt::Display for Gaussian {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

impl HeightDistribution for Gaussian {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn label(&self) -> &'static str {
        "Gaussian"
    }

    fn papers(&self) -> &'static [Paper] {
        &[GREENWOOD_WILLIAMSON_1966, ZHAO_MAIETTA_CHANG_2000]
    }

    fn skewness(&self) -> f64 {
        0.0
    }

    fn kurtosis(&self) -> f64 {
        3.0
    }

    fn support(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    fn density(&self, z: f64) -> f64 {
        (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
    }

    fn survival(&self, z: f64) -> f64 {
        0.5 * erfc(z / SQRT_2)
    }

    fn map_probabilities(&self, field: &mut [f64], scale: f64) {
        normal_quantiles(field);
        self.map_normals(field, scale);
    }

    fn height_at_normal(&self, g: f64) -> f64 {
        g
    }

    fn decreasing_from(&self) -> f64 {
        0.0
    }

    fn highest_separation(&self) -> f64 {
        39.0
    }

    fn scale(&self, h: f64) -> f64 {
        if h < 0.0 {
            return 1.0 / (2.0 * PI).sqrt();
        }
        // h^2/2 as an exact sum of two numbers: one rounding would cost h^2 ulp.
        let square = h * h;
        let rest = h.mul_add(h, -square);
        (-0.5 * square).exp() * (1.0 - 0.5 * rest) / (2.0 * PI).sqrt()
    }

    fn window(&self, h: f64) -> [f64; 2] {
        let reach = 2.0 * FOLDINGS;
        // For h >= 0 the root of x h + x^2/2 = 40, written without cancellation.
        if h >= 0.0 {
            [0.0, reach / (h + (h * h + reach).sqrt())]
        } else {
            [(-h - reach.sqrt()).max(0.0), reach.sqrt() - h]
        }
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        whole_panels(self.fractional_panels(h, from, to))
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

/// F_n(h) = int_h^inf (s - h)^n phi(s) ds, phi the standard normal density, for real n above -1 and h from -1000; NaN beyond.
///
/// Greenwood and Williamson's elastic contact is P/A_nom = (4/3) eta E* R^.5 sigma^1.5 F_1.5(h), A/A_nom = pi eta R
/// sigma F_1(h). The relative error is below 1e-13 for n up to 30 wherever the value is a normal number, which it is up to about
/// h = 38. By the trapezoidal rule over u with s - h = exp(u - exp(-u)) (Takahasi and Mori 1974): independent of the quadrature of the
/// models, for checks of it.
pub fn gaussian_moment(n: f64, h: f64) -> f64 {
    if !(n > -1.0 && n.is_finite() && (-1000.0..f64::INFINITY).contains(&h)) {
        return f64::NAN;
    }
    // Beyond these the integrand is below exp(-40) of what it is where it is largest.
    let low = (-(40.0 / (n + 1.0)).ln()).min(-3.0);
    let high = ((-h).max(0.0) + 10.0 + 2.0 * (n + 1.0).sqrt()).ln() + 1.0;
    let step = 32f64.max(-16.0 * h).recip();
    let term = |k: usize| {
        let u = low + k as f64 * step;
        let e = (-u).exp();
        ((n + 1.0) * (u - e) - Gaussian.exponent(h, (u - e).exp())).exp() * (1.0 + e)
    };
    Gaussian.scale(h) * step * (0..=((high - low) / step) as usize + 1).map(term).sum::<f64>()
}
