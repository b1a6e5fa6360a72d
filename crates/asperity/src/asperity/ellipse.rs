//! Asperities of two principal curvatures.

use crate::shape::Shape;

/// An elliptic paraboloid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse {
    /// Mean of the principal curvatures, 1/m.
    pub mean_curvature: f64,
    /// The larger principal curvature over the smaller one, at least 1.
    pub curvature_ratio: f64,
}

/// The largest ratio of principal curvatures of an elliptic summit.
const MAX_CURVATURE_RATIO: f64 = 1e6;

impl Ellipse {
    /// From positive principal curvatures (1/m).
    pub fn new(kx: f64, ky: f64) -> Self {
        Self { mean_curvature: 0.5 * (kx + ky), curvature_ratio: kx.max(ky) / kx.min(ky) }
    }

    /// From the principal curvatures (1/m, the larger first) of a summit, whose mean is positive. A summit whose
    /// smaller curvature is not positive, or negligible, becomes a sphere of its mean curvature.
    pub fn of_summit(principal: [f64; 2]) -> Self {
        let [larger, smaller] = principal;
        let mean_curvature = 0.5 * (larger + smaller);
        let ratio = larger / smaller;
        let is_ellipse = smaller > 0.0 && ratio <= MAX_CURVATURE_RATIO;
        Self { mean_curvature, curvature_ratio: if is_ellipse { ratio.max(1.0) } else { 1.0 } }
    }

    /// The principal curvatures (1/m), the larger first.
    pub fn principal(&self) -> [f64; 2] {
        let smaller = 2.0 * self.mean_curvature / (1.0 + self.curvature_ratio);
        [2.0 * self.mean_curvature - smaller, smaller]
    }

    /// Principal curvatures (1/m, the larger first) of which [`Self::new`] makes this ellipse: those of [`Self::principal`] but for a few
    /// units of their last digit, to the bit where there are such.
    pub fn exact_principal(&self) -> [f64; 2] {
        const STEPS: i64 = 8;
        let near = |k: f64, steps: i64| f64::from_bits(k.to_bits().wrapping_add_signed(steps));
        let [larger, smaller] = self.principal();
        let steps = (0..=STEPS).flat_map(|step| [step, -step]);
        let made = |(a, b): (i64, i64)| [near(larger, a), near(smaller, b)];
        let all = steps.flat_map(|a| (0..=STEPS).flat_map(move |b| [(a, b), (a, -b)]));
        all.map(made)
            .find(|&[larger, smaller]| Self::new(larger, smaller) == *self)
            .unwrap_or([larger, smaller])
    }

    /// The equivalent spheres of the paraboloid.
    pub fn shape(&self) -> Shape {
        Shape::ellipse(self.mean_curvature, self.curvature_ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_curvatures_are_those_given() {
        for [larger, smaller] in [[3.0, 1.0], [2e4, 2e4], [1e5, 1.0]] {
            let [found, other] = Ellipse::new(smaller, larger).principal();
            assert!(
                (found / larger - 1.0).abs() < 1e-15 && (other / smaller - 1.0).abs() < 1e-10,
                "{found} {other}"
            );
        }
    }

    #[test]
    fn an_ellipse_is_made_again_to_the_bit() {
        let mut inexact = 0;
        for k in 1..20_000 {
            let larger = 1e4 * (1.0 + f64::from(k).sin().abs());
            let smaller = larger * (0.7 * f64::from(k)).cos().abs().powi(k % 40);
            let ellipse = Ellipse::of_summit([larger, smaller]);
            let [kx, ky] = ellipse.exact_principal();
            assert_eq!(Ellipse::new(kx, ky), ellipse, "{larger:e} {smaller:e}");
            let [kx, ky] = ellipse.principal();
            inexact += u32::from(Ellipse::new(kx, ky) != ellipse);
        }
        assert!(inexact > 1000, "{inexact}: rounding is not tried");
    }

    #[test]
    fn a_summit_that_is_no_ellipse_is_the_sphere_of_its_mean_curvature() {
        for smaller in [-1.0, 0.0, 1e-9] {
            let found = Ellipse::of_summit([4.0, smaller]);
            assert_eq!((found.mean_curvature, found.curvature_ratio), (0.5 * (4.0 + smaller), 1.0));
        }
        assert_eq!(Ellipse::of_summit([4.0, 1.0]), Ellipse { mean_curvature: 2.5, curvature_ratio: 4.0 });
    }
}
