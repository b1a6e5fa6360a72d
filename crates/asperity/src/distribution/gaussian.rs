//! Gaussian heights.

use std::f64::consts::{PI, SQRT_2};
use std::fmt;

use libm::erfc;

use super::normal_quantiles::normal_quantiles;
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

/// F_n(h) = int_h^inf (s - h)^n phi(s) ds, phi the standard normal density, for real n > -1, in
/// closed form through the parabolic cylinder function (DLMF 12.4.1, 12.7.12, 12.7.13).
///
/// Greenwood and Williamson's elastic contact is P/A_nom = (4/3) eta E* R^.5 sigma^1.5 F_1.5(h), A/A_nom = pi eta R
/// sigma F_1(h). The two series cancel as h grows: for n up to 1.5 the relative error is below 3e-11 up to h = 3.
/// Independent of the quadrature, for checks of it.
pub fn gaussian_moment(n: f64, h: f64) -> f64 {
    use statrs::function::gamma::gamma;
    let z = 0.5 * h * h;
    let even = PI.sqrt() / gamma(0.5 * n + 1.0) * kummer(0.5 * (n + 1.0), 0.5, z);
    let odd = SQRT_2 * PI.sqrt() * h / gamma(0.5 * (n + 1.0)) * kummer(0.5 * n + 1.0, 1.5, z);
    gamma(n + 1.0) / (2.0 * PI).sqrt() * 2f64.powf(-0.5 * (n + 1.0)) * (-z).exp() * (even - odd)
}

/// Kummer's M(a, b, z) for positive arguments: a series of positive terms.
fn kummer(a: f64, b: f64, z: f64) -> f64 {
    let (mut term, mut sum, mut k) = (1.0, 1.0, 0.0);
    while term > sum * (0.1 * f64::EPSILON) {
        term *= (a + k) / ((b + k) * (k + 1.0)) * z;
        sum += term;
        k += 1.0;
    }
    sum
}
