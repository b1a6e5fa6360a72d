//! Correlations for the conductance of rough joints, as programs for finite elements use them.

use std::f64::consts::{PI, SQRT_2};

use crate::literature::{self, Paper};
use crate::named_enum;

named_enum! {
    /// A correlation of the conductance with the load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Correlation {
        /// Plastic contact (Cooper, Mikic and Yovanovich 1969): 1.25 (m/sigma) (p/H)^0.95/s.
        CooperMikicYovanovich = "cooper-mikic-yovanovich",
        /// Elastic contact (Mikic 1974): 1.55 (m/sigma) (2^0.5 p/(E* m))^0.94/s.
        Mikic = "mikic",
    }
}

/// What the correlations take of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// r.m.s. height sigma of the sum of both surfaces, m.
    pub sigma: f64,
    /// Mean absolute slope m of profiles of that surface.
    pub slope: f64,
    /// E*, Pa.
    pub modulus: f64,
    /// Hardness of the softer body, Pa; infinite if neither yields.
    pub hardness: f64,
}

impl Joint {
    /// Of a surface of r.m.s. height `sigma` (m) and r.m.s. `gradient` of both directions together, whose slopes are Gaussian and the same
    /// in all directions: m = gradient/pi^0.5.
    pub fn isotropic(sigma: f64, gradient: f64, modulus: f64, hardness: f64) -> Self {
        Self { sigma, slope: gradient / PI.sqrt(), modulus, hardness }
    }
}

impl Correlation {
    /// Conductance per nominal area times the mean resistivity s of the bodies (1/m) at a nominal `pressure` (Pa); `None` of a plastic contact
    /// of bodies that never yield. The exponents and factors are those in use, of Mikic's also 1.54; the original
    /// of Mikic was not consulted.
    pub fn conductance(self, joint: &Joint, pressure: f64) -> Option<f64> {
        let Joint { sigma, slope, modulus, hardness } = *joint;
        let of = |factor: f64, ratio: f64, exponent: f64| factor * slope / sigma * ratio.powf(exponent);
        match self {
            Self::CooperMikicYovanovich => hardness.is_finite().then(|| of(1.25, pressure / hardness, 0.95)),
            Self::Mikic => Some(of(1.55, SQRT_2 * pressure / (modulus * slope), 0.94)),
        }
    }

    /// Its authors.
    pub const fn label(self) -> &'static str {
        match self {
            Self::CooperMikicYovanovich => "Cooper-Mikic-Yovanovich (plastic)",
            Self::Mikic => "Mikic (elastic)",
        }
    }

    /// Its source.
    pub const fn paper(self) -> Paper {
        match self {
            Self::CooperMikicYovanovich => literature::COOPER_MIKIC_YOVANOVICH_1969,
            Self::Mikic => literature::MIKIC_1974,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spot::tube_factor;

    /// x of erfc(x)/2 = `tail`.
    fn quantile(tail: f64) -> f64 {
        let (mut low, mut high) = (-6.0, 6.0);
        for _ in 0..100 {
            let x = 0.5 * (low + high);
            if 0.5 * libm::erfc(x) > tail { low = x } else { high = x }
        }
        low
    }

    /// The fits are within 2 % of their models: h sigma s/m = exp(-x^2)/(2 (2 pi)^0.5 psi), erfc(x)/2 = p/H = A/A_nom; of elastic contact
    /// exp(-x^2)/(4 pi^0.5 psi), erfc(x)/4 = A/A_nom = 2^0.5 p/(E* m).
    #[test]
    fn the_fits_are_those_of_their_models() {
        let joint = Joint { sigma: 2e-6, slope: 0.15, modulus: 1e11, hardness: 2e9 };
        for area in [1e-5, 1e-4, 1e-3, 1e-2] {
            let plastic = |x: f64| (-x * x).exp() / (2.0 * (2.0 * PI).sqrt() * tube_factor(area));
            let elastic = |x: f64| (-x * x).exp() / (4.0 * PI.sqrt() * tube_factor(area));
            let unit = joint.slope / joint.sigma;
            let found =
                Correlation::CooperMikicYovanovich.conductance(&joint, area * joint.hardness).unwrap();
            assert!((found / unit / plastic(quantile(area)) - 1.0).abs() < 0.02, "{area}");
            let pressure = area * joint.modulus * joint.slope / SQRT_2;
            let found = Correlation::Mikic.conductance(&joint, pressure).unwrap();
            assert!((found / unit / elastic(quantile(2.0 * area)) - 1.0).abs() < 0.02, "{area}");
        }
        let rigid = Joint { hardness: f64::INFINITY, ..joint };
        assert_eq!(Correlation::CooperMikicYovanovich.conductance(&rigid, 1e6), None);
        assert!((Joint::isotropic(1.0, 0.2, 1.0, 1.0).slope - 0.2 / PI.sqrt()).abs() < 1e-15);
    }
}
