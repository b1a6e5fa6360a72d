//! Asperities as a struct of arrays: spheres, or a number of equal spheres for each ellipse.

use std::ops::Range;

use super::SetError;
use super::set::far_origin;
use crate::numeric::interval::Interval;
use crate::shape::Shape;

/// Borrowed heights and shapes of asperities on a nominal area.
#[derive(Debug, Clone, Copy)]
pub struct Asperities<'a> {
    heights: &'a [f64],
    radii: &'a [f64],
    spheres: Option<&'a [f64]>,
    nominal_area: f64,
}

impl<'a> Asperities<'a> {
    /// One sphere per asperity, or a number of `spheres` each, with `heights` and `radii` (m) on a `nominal_area` (m^2).
    pub(crate) fn new(
        heights: &'a [f64],
        radii: &'a [f64],
        spheres: Option<&'a [f64]>,
        nominal_area: f64,
    ) -> Self {
        debug_assert!(heights.len() == radii.len() && spheres.is_none_or(|all| all.len() == radii.len()));
        Self { heights, radii, spheres, nominal_area }
    }

    /// Spheres of the given heights and radii (m) on a nominal area (m^2), where they lie: nothing is copied.
    ///
    /// # Errors
    /// As [`AsperitySet::new`](super::AsperitySet::new).
    pub fn of_spheres(heights: &'a [f64], radii: &'a [f64], nominal_area: f64) -> Result<Self, SetError> {
        SetError::check(heights, radii, nominal_area)?;
        Ok(Self::new(heights, radii, None, nominal_area))
    }

    /// Whether all heights are so far from zero that their differences are better stored: see
    /// [`AsperitySet::near_zero`](super::AsperitySet::near_zero).
    pub fn is_far_from_zero(&self) -> bool {
        far_origin(self.heights).is_some()
    }

    /// Number of asperities.
    pub fn count(&self) -> usize {
        self.heights.len()
    }

    /// Nominal area, m^2.
    pub fn nominal_area(&self) -> f64 {
        self.nominal_area
    }

    /// Heights, m.
    pub fn heights(&self) -> &'a [f64] {
        self.heights
    }

    /// Radii, m; for ellipses, of their equivalent spheres.
    pub fn radii(&self) -> &'a [f64] {
        self.radii
    }

    /// Number of spheres per asperity; `None` if every asperity is one sphere.
    pub fn spheres(&self) -> Option<&'a [f64]> {
        self.spheres
    }

    /// Height of the highest asperity, m.
    pub fn highest(&self) -> f64 {
        Interval::new(self.heights).high
    }

    /// The range of the radii, m.
    pub fn radius_range(&self) -> Interval {
        Interval::new(self.radii)
    }

    /// The range of the numbers of spheres.
    pub fn sphere_range(&self) -> Interval {
        self.spheres.map_or(Interval::point(1.0), Interval::new)
    }

    /// The shape of asperity `index`.
    #[inline]
    pub fn shape(&self, index: usize) -> Shape {
        let spheres = self.spheres.map_or(1.0, |spheres| spheres[index]);
        Shape { radius: self.radii[index], spheres }
    }

    /// The asperities of an index range, on the same nominal area.
    pub fn part(&self, range: Range<usize>) -> Self {
        Self {
            heights: &self.heights[range.clone()],
            radii: &self.radii[range.clone()],
            spheres: self.spheres.map(|spheres| &spheres[range]),
            ..*self
        }
    }

    /// Iterates over heights (m) and shapes.
    pub fn each(self) -> impl Iterator<Item = (f64, Shape)> + 'a {
        (0..self.count()).map(move |index| (self.heights[index], self.shape(index)))
    }
}
