//! A set of ellipses: the equivalent spheres of each, and its mean shape.

use rayon::prelude::*;

use super::{Asperities, AsperitySet, Ellipse};
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
}
