//! Height densities of the statistical model, standardised: zero mean, unit standard deviation.
//!
//! Heights z, separations h and indentations x = z - h are in units of sigma here.

use statrs::distribution::{ContinuousCDF, Exp, Normal};
use std::f64::consts::{PI, SQRT_2};

use crate::numeric::lanes::Real;

/// How many e-foldings of a density count: exp(-40) = 4e-18 of its largest value.
const FOLDINGS: f64 = 40.0;

/// Density of asperity heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum HeightDensity {
    /// Normal heights (Greenwood and Williamson 1966; Zhao, Maietta and Chang 2000).
    Gaussian,
    /// Exponential heights, z >= -1: every homogeneous micro-contact then gives an area exactly
    /// proportional to the load (Greenwood and Williamson 1966).
    Exponential,
}

impl HeightDensity {
    /// The name that specs and tables use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gaussian => "gaussian",
            Self::Exponential => "exponential",
        }
    }

    /// The name that sentences use.
    pub const fn adjective(self) -> &'static str {
        match self {
            Self::Gaussian => "Gaussian",
            Self::Exponential => "exponential",
        }
    }

    /// The most frequent height.
    pub const fn mode(self) -> f64 {
        match self {
            Self::Gaussian => 0.0,
            Self::Exponential => -1.0,
        }
    }

    /// A separation at and beyond which the density has no f64 left.
    pub const fn highest_separation(self) -> f64 {
        match self {
            Self::Gaussian => 39.0,
            Self::Exponential => 745.0,
        }
    }

    /// The indentations above separation `h` at which the density is not negligible.
    pub fn window(self, h: f64) -> [f64; 2] {
        match self {
            Self::Gaussian => {
                let reach = 2.0 * FOLDINGS;
                // For h >= 0 the root of x h + x^2/2 = 40, written without cancellation.
                if h >= 0.0 {
                    [0.0, reach / (h + (h * h + reach).sqrt())]
                } else {
                    [(-h - reach.sqrt()).max(0.0), reach.sqrt() - h]
                }
            }
            Self::Exponential => {
                let start = (-1.0 - h).max(0.0);
                [start, start + FOLDINGS]
            }
        }
    }

    /// The factor of the density at height h + x that does not depend on x, so that
    /// density = scale(h) exp(-exponent(h, x)) keeps full relative accuracy in the far tail.
    pub fn scale(self, h: f64) -> f64 {
        match self {
            Self::Gaussian if h >= 0.0 => {
                // h^2/2 as an exact sum of two numbers: one rounding would cost h^2 ulp.
                let square = h * h;
                let rest = h.mul_add(h, -square);
                (-0.5 * square).exp() * (1.0 - 0.5 * rest) / (2.0 * PI).sqrt()
            }
            Self::Gaussian => 1.0 / (2.0 * PI).sqrt(),
            Self::Exponential if h >= -1.0 => (-(h + 1.0)).exp(),
            Self::Exponential => 1.0,
        }
    }

    /// See [`HeightDensity::scale`]; `x` within the window.
    #[inline(always)]
    pub fn exponent<N: Real>(self, h: f64, x: N) -> N {
        match self {
            Self::Gaussian if h >= 0.0 => x * (x * 0.5 + h),
            Self::Gaussian => (x + h) * 0.5 * (x + h),
            Self::Exponential if h >= -1.0 => x,
            Self::Exponential => (x + h) + 1.0,
        }
    }

    /// Whether the density rises and falls again between the indentations `from` and `to`.
    pub fn turns(self, h: f64, from: f64, to: f64) -> bool {
        self == Self::Gaussian && from < -h && -h < to
    }

    /// How many times the density changes by a factor e between the indentations `from` and `to`.
    pub fn foldings(self, h: f64, from: f64, to: f64) -> f64 {
        let (start, end) = (self.exponent(h, from), self.exponent(h, to));
        if self.turns(h, from, to) { start + end } else { (end - start).abs() }
    }

    /// Density at the height `z`.
    pub fn density(self, z: f64) -> f64 {
        match self {
            Self::Gaussian => (-0.5 * z * z).exp() / (2.0 * PI).sqrt(),
            Self::Exponential if z < -1.0 => 0.0,
            Self::Exponential => (-(z + 1.0)).exp(),
        }
    }

    /// The height that a fraction `p` in (0, 1) of all asperities lies below (statrs).
    pub fn quantile(self, p: f64) -> f64 {
        match self {
            Self::Gaussian => Normal::standard().inverse_cdf(p),
            Self::Exponential => match Exp::new(1.0) {
                Ok(unit) => unit.inverse_cdf(p) - 1.0,
                Err(_) => unreachable!("the unit rate is valid"),
            },
        }
    }
}

/// F_n(h) = int_h^inf (s - h)^n phi(s) ds, phi the standard normal density, for real n > -1, in
/// closed form through the parabolic cylinder function (DLMF 12.4.1, 12.7.12, 12.7.13).
///
/// Greenwood and Williamson's elastic contact is P/A_nom = (4/3) eta E* R^.5 sigma^1.5 F_1.5(h),
/// A/A_nom = pi eta R sigma F_1(h). The two series cancel as h grows: for n up to 1.5
/// the relative error is below 3e-11 up to h = 3. It shares nothing with the quadrature and is there to check it.
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
