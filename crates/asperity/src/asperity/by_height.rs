//! The asperities of a set in the order of their heights.

use rayon::prelude::*;

use super::Asperities;
use crate::memory::{collected, zeros};
use crate::numeric::sort::ascending;
use crate::shape::Shape;

/// The asperities of a set in ascending order of their heights.
#[derive(Debug, PartialEq)]
pub struct ByHeight {
    places: Vec<usize>,
    values: Vec<f64>,
}

impl ByHeight {
    /// Of these heights, m.
    pub fn new(heights: &[f64]) -> Self {
        let places = ascending(heights);
        Self { values: collected(places.par_iter().map(|&place| heights[place])), places }
    }

    /// The places in the set, equal heights in the order of the set.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// The heights, m.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// That of the set without the asperities at some places: nothing is sorted.
    pub(super) fn without(&self, left_out: &[usize]) -> Self {
        const LEFT_OUT: usize = usize::MAX;
        let mut new_places = zeros(self.places.len());
        left_out.iter().for_each(|&place| new_places[place] = LEFT_OUT);
        for (new, place) in new_places.iter_mut().filter(|place| **place != LEFT_OUT).enumerate() {
            *place = new;
        }
        let all = self.places.iter().zip(&self.values);
        let staying = all.map(|(&place, &z)| (new_places[place], z)).filter(|(place, _)| *place != LEFT_OUT);
        let (places, values) = staying.unzip();
        Self { places, values }
    }
}

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

/// The mean radius of the asperities above each height of a set.
#[derive(Debug, Clone, Copy)]
pub struct RadiiAbove<'a> {
    /// Heights, ascending, m.
    heights: &'a [f64],
    /// The mean radius of the asperities from each on, m.
    means: &'a [f64],
}

impl RadiiAbove<'_> {
    /// Of the heights of a set in their order, with the [`means_above`] them.
    pub(super) fn new<'a>(by_height: &'a ByHeight, means: &'a [f64]) -> RadiiAbove<'a> {
        RadiiAbove { heights: &by_height.values, means }
    }

    /// That of the asperities above `height` (m, in the frame of the heights), m; above all of them the radius of the highest one.
    pub fn mean(&self, height: f64) -> f64 {
        let below = self.heights.partition_point(|z| *z <= height);
        self.means[below.min(self.means.len() - 1)]
    }
}

/// The mean of `radii` from each asperity on in the order of height.
pub(super) fn means_above(by_height: &ByHeight, radii: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut means = collected(by_height.places.par_iter().map(|&place| radii[place]));
    for (index, mean) in means.iter_mut().rev().enumerate() {
        sum += *mean;
        *mean = sum / (index + 1) as f64;
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal values too, and none or all left out.
    #[test]
    fn the_order_of_a_part_is_that_of_the_whole() {
        let values: Vec<f64> = (0..100).map(|k| f64::from((k * 37) % 23)).collect();
        let whole = ByHeight::new(&values);
        for left_out in
            [vec![], vec![0], vec![99], vec![3, 4, 50, 98], (0..100).step_by(2).collect(), (0..100).collect()]
        {
            let rest: Vec<f64> = (0..100).filter(|k| !left_out.contains(k)).map(|k| values[k]).collect();
            assert_eq!(whole.without(&left_out), ByHeight::new(&rest));
        }
    }

    #[test]
    fn mean_radii_above_a_height() {
        let (heights, radii) = ([3.0, 1.0, 2.0, 2.0], [4.0, 1.0, 2.0, 6.0]);
        let by_height = ByHeight::new(&heights);
        assert_eq!((by_height.places(), by_height.values()), (&[1, 2, 3, 0][..], &[1.0, 2.0, 2.0, 3.0][..]));
        let means = means_above(&by_height, &radii);
        let above = RadiiAbove::new(&by_height, &means);
        for (height, mean) in
            [(0.0, 3.25), (1.0, 4.0), (1.5, 4.0), (2.0, 4.0), (2.5, 4.0), (3.0, 4.0), (9.0, 4.0)]
        {
            assert_eq!(above.mean(height), mean, "{height}");
        }
        let means = means_above(&by_height, &[5.0, 1.0, 2.0, 6.0]);
        let above = RadiiAbove::new(&by_height, &means);
        assert_eq!([above.mean(1.0), above.mean(2.0)], [13.0 / 3.0, 5.0]);
    }
}
