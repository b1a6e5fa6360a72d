//! Asperities highest first.

use std::ops::Range;

use rayon::prelude::*;

use super::AsperitySet;
use crate::law::Shape;
use crate::numeric::interval::Interval;

/// A set with its asperities highest first, so that those in contact at any separation are a prefix
/// and the others are never touched.
#[derive(Debug, Clone)]
pub struct Ordered {
    heights: Vec<f64>,
    radii: Vec<f64>,
    spheres: Option<Vec<f64>>,
    nominal_area: f64,
}

/// Some asperities of an ordered set, as a struct of arrays.
#[derive(Debug, Clone, Copy)]
pub struct Asperities<'a> {
    heights: &'a [f64],
    radii: &'a [f64],
    spheres: Option<&'a [f64]>,
}

impl Ordered {
    /// Orders a set of spheres. Equal heights stand in the order of their radii, so that nothing depends on
    /// the order of the input.
    pub fn new(set: &AsperitySet) -> Self {
        let mut pairs: Vec<(f64, f64)> =
            set.heights().iter().copied().zip(set.radii().iter().copied()).collect();
        pairs.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
        let (heights, radii) = pairs.into_iter().unzip();
        Self { heights, radii, spheres: None, nominal_area: set.nominal_area() }
    }

    /// Orders a set of elliptic paraboloids likewise; `None` where the set does not know its principal curvatures.
    pub fn of_ellipses(set: &AsperitySet) -> Option<Self> {
        let ellipses = set.ellipses()?;
        let mut all: Vec<(f64, Shape)> =
            (set.heights().par_iter().zip(ellipses)).map(|(&z, ellipse)| (z, ellipse.shape())).collect();
        let shape =
            |a: &Shape, b: &Shape| a.radius.total_cmp(&b.radius).then(a.spheres.total_cmp(&b.spheres));
        all.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then_with(|| shape(&a.1, &b.1)));
        Some(Self {
            heights: all.iter().map(|(z, _)| *z).collect(),
            radii: all.iter().map(|(_, shape)| shape.radius).collect(),
            spheres: Some(all.iter().map(|(_, shape)| shape.spheres).collect()),
            nominal_area: set.nominal_area(),
        })
    }

    /// Number of asperities.
    pub fn count(&self) -> usize {
        self.heights.len()
    }

    /// Height of the highest asperity, m.
    pub fn highest(&self) -> f64 {
        self.heights[0]
    }

    /// The range of the radii, m.
    pub fn radii(&self) -> Interval {
        Interval::of(&self.radii)
    }

    /// The range of the numbers of spheres.
    pub fn spheres(&self) -> Interval {
        self.spheres.as_deref().map_or(Interval::point(1.0), Interval::of)
    }

    /// Nominal area, m^2.
    pub fn nominal_area(&self) -> f64 {
        self.nominal_area
    }

    /// The asperities above `separation` (m, in the frame of the heights), highest first.
    pub fn above(&self, separation: f64) -> Asperities<'_> {
        let count = self.heights.partition_point(|&z| z > separation);
        let all = Asperities { heights: &self.heights, radii: &self.radii, spheres: self.spheres.as_deref() };
        all.part(0..count)
    }
}

impl<'a> Asperities<'a> {
    /// Number of asperities.
    pub fn count(&self) -> usize {
        self.heights.len()
    }

    /// Heights, m.
    pub fn heights(&self) -> &'a [f64] {
        self.heights
    }

    /// Radii, m; of ellipses those of the spheres that stand for them.
    pub fn radii(&self) -> &'a [f64] {
        self.radii
    }

    /// How many spheres stand for each; `None` where each is one.
    pub fn spheres(&self) -> Option<&'a [f64]> {
        self.spheres
    }

    /// The shape of one.
    #[inline]
    pub fn shape(&self, index: usize) -> Shape {
        let spheres = self.spheres.map_or(1.0, |spheres| spheres[index]);
        Shape { radius: self.radii[index], spheres }
    }

    /// Those of a range.
    pub fn part(&self, range: Range<usize>) -> Self {
        Self {
            heights: &self.heights[range.clone()],
            radii: &self.radii[range.clone()],
            spheres: self.spheres.map(|spheres| &spheres[range]),
        }
    }

    /// Hands over each height (m) and shape.
    #[inline]
    pub fn each(&self, mut see: impl FnMut(f64, Shape)) {
        for (index, &z) in self.heights.iter().enumerate() {
            see(z, self.shape(index));
        }
    }
}
