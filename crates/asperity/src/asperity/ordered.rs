//! Asperities highest first.

use rayon::prelude::*;

use super::Asperities;
use crate::shape::Shape;

/// Asperities in descending order of height, so that those in contact at a separation are a prefix. For searches that
/// repeatedly evaluate the highest asperities.
#[derive(Debug, Clone)]
pub struct Ordered {
    heights: Vec<f64>,
    radii: Vec<f64>,
    spheres: Option<Vec<f64>>,
    nominal_area: f64,
}

impl Ordered {
    /// Sorts asperities; equal heights are ordered by shape, so that the result does not depend on the input order.
    pub fn new(asperities: Asperities<'_>) -> Self {
        let mut all: Vec<(f64, Shape)> = asperities.each().collect();
        let shape =
            |a: &Shape, b: &Shape| a.radius.total_cmp(&b.radius).then(a.spheres.total_cmp(&b.spheres));
        all.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then_with(|| shape(&a.1, &b.1)));
        Self {
            heights: all.iter().map(|(z, _)| *z).collect(),
            radii: all.iter().map(|(_, shape)| shape.radius).collect(),
            spheres: asperities.spheres().map(|_| all.iter().map(|(_, shape)| shape.spheres).collect()),
            nominal_area: asperities.nominal_area(),
        }
    }

    /// The asperities above `separation` (m, in the frame of the heights), in descending order.
    pub fn above(&self, separation: f64) -> Asperities<'_> {
        let count = self.heights.partition_point(|&z| z > separation);
        Asperities::new(&self.heights, &self.radii, self.spheres.as_deref(), self.nominal_area).part(0..count)
    }
}
