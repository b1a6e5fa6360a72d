//! Asperities highest first.

use rayon::prelude::*;

use super::AsperitySet;
use crate::numeric::interval::Interval;

/// A set with its asperities highest first, so that those in contact at any separation are a prefix
/// and the others are never touched.
#[derive(Debug, Clone)]
pub struct Ordered {
    heights: Vec<f64>,
    radii: Vec<f64>,
    nominal_area: f64,
}

impl Ordered {
    /// Orders a set. Equal heights stand in the order of their radii, so that nothing depends on
    /// the order of the input.
    pub fn new(set: &AsperitySet) -> Self {
        let mut pairs: Vec<(f64, f64)> =
            set.heights().iter().copied().zip(set.radii().iter().copied()).collect();
        pairs.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
        let (heights, radii) = pairs.into_iter().unzip();
        Self { heights, radii, nominal_area: set.nominal_area() }
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
        let low = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        Interval { low, high: self.radii.iter().copied().fold(0.0, f64::max) }
    }

    /// Nominal area, m^2.
    pub fn nominal_area(&self) -> f64 {
        self.nominal_area
    }

    /// Heights (m, highest first) and radii (m) of the asperities above `separation` (m, in the
    /// frame of the heights).
    pub fn above(&self, separation: f64) -> (&[f64], &[f64]) {
        let count = self.heights.partition_point(|&z| z > separation);
        (&self.heights[..count], &self.radii[..count])
    }
}
