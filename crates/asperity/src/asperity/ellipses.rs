//! Ellipses of summits: one, and a set of them with the equivalent spheres of each and its mean shape.

use rayon::prelude::*;

use super::{Asperities, AsperitySet};
use crate::numeric::sum::sum_of;
use crate::shape::Shape;

/// The equivalent spheres of the ellipses of a set.
#[derive(Debug, Clone)]
pub struct Ellipses<'a> {
    set: &'a AsperitySet,
    radii: Vec<f64>,
    spheres: Vec<f64>,
}

impl<'a> Ellipses<'a> {
    /// The equivalent spheres of a set; `None` if its principal curvatures are unknown.
    pub fn new(set: &'a AsperitySet) -> Option<Self> {
        let (radii, spheres) = set
            .ellipses()?
            .par_iter()
            .map(|ellipse| (ellipse.shape().radius, ellipse.shape().spheres))
            .unzip();
        Some(Self { set, radii, spheres })
    }

    /// The asperities.
    pub fn asperities(&self) -> Asperities<'_> {
        Asperities::new(self.set.heights(), &self.radii, Some(&self.spheres), self.set.nominal_area())
    }
}

/// The mean shape of a set of ellipses: the input of the statistical model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipticity {
    /// Mean of the mean curvatures, 1/m.
    pub mean_curvature: f64,
    /// Mean of the smaller principal curvature over the larger one, from 0 to 1; 1 for spheres.
    pub mean_ratio: f64,
}

impl Ellipticity {
    /// The mean shape of a set; `None` if it has no ellipses.
    pub fn new(set: &AsperitySet) -> Option<Self> {
        let ellipses = set.ellipses()?;
        let mean = |term: fn(&Ellipse) -> f64| {
            sum_of(ellipses.len(), |i| term(&ellipses[i])) / ellipses.len() as f64
        };
        Some(Self {
            mean_curvature: mean(|ellipse| ellipse.mean_curvature),
            mean_ratio: mean(|ellipse| ellipse.curvature_ratio.recip()),
        })
    }

    /// The shape of the mean asperity.
    pub fn shape(&self) -> Shape {
        Shape::ellipse(self.mean_curvature, self.mean_ratio.recip())
    }
}

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
    fn the_mean_of_ellipses() {
        let ellipse = |ratio| Ellipse { mean_curvature: 2.0 + ratio, curvature_ratio: ratio };
        let set = AsperitySet::new(vec![0.0, 1.0], vec![1.0; 2], 1.0).unwrap();
        assert_eq!(Ellipticity::new(&set), None);
        let set = set.with_ellipses(vec![ellipse(1.0), ellipse(4.0)]).unwrap();
        let found = Ellipticity::new(&set).unwrap();
        assert_eq!(found, Ellipticity { mean_curvature: 4.5, mean_ratio: 0.625 });
        assert_eq!(found.shape(), Shape::ellipse(4.5, 1.6));
        assert!(set.clone().with_ellipses(vec![ellipse(1.0)]).is_err());
    }

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
