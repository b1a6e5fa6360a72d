//! The asperities of a set by height, and their mean radius above a height.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use crate::distribution::{EqualHeights, Heights, Smoothed};
use crate::numeric::sort::ascending;

/// The asperities of a set in ascending order of height.
#[derive(Debug)]
pub struct ByHeight {
    places: Vec<usize>,
    heights: Vec<f64>,
}

impl ByHeight {
    /// Of `heights`, m.
    pub fn new(heights: &[f64]) -> Self {
        let places = ascending(heights);
        Self { heights: places.par_iter().map(|&place| heights[place]).collect(), places }
    }

    /// The places in the set, equal heights in the order of the set.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// The heights, m.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }
}

/// The mean radius of the asperities above each height of a set.
#[derive(Debug)]
pub struct RadiiAbove {
    /// Heights, ascending, m.
    heights: Vec<f64>,
    /// The mean radius of the asperities from each on, m.
    means: Vec<f64>,
}

impl RadiiAbove {
    /// Of asperities of `radii` (m), at least one.
    fn new(by_height: &ByHeight, radii: &[f64]) -> Self {
        let mut sum = 0.0;
        let mut means: Vec<f64> = by_height.places.par_iter().map(|&place| radii[place]).collect();
        for (index, mean) in means.iter_mut().rev().enumerate() {
            sum += *mean;
            *mean = sum / (index + 1) as f64;
        }
        Self { heights: by_height.heights.clone(), means }
    }

    /// That of the asperities above `height` (m, in the frame of the heights), m; above all of them the radius of the highest one.
    pub fn mean(&self, height: f64) -> f64 {
        let below = self.heights.partition_point(|z| *z <= height);
        self.means[below.min(self.means.len() - 1)]
    }
}

/// What follows from a set, found when it is first asked for. Two sets are compared without it.
#[derive(Debug, Clone, Default)]
pub(super) struct OnDemand(Arc<Found>);

#[derive(Debug, Default)]
struct Found {
    by_height: OnceLock<ByHeight>,
    radii_above: OnceLock<RadiiAbove>,
    smoothed: OnceLock<Result<Heights, EqualHeights>>,
}

impl OnDemand {
    pub(super) fn by_height(&self, heights: &[f64]) -> &ByHeight {
        self.0.by_height.get_or_init(|| ByHeight::new(heights))
    }

    pub(super) fn radii_above(&self, heights: &[f64], radii: &[f64]) -> &RadiiAbove {
        self.0.radii_above.get_or_init(|| RadiiAbove::new(self.by_height(heights), radii))
    }

    pub(super) fn smoothed(&self, heights: &[f64]) -> Result<Heights, EqualHeights> {
        let smoothed = || Smoothed::of_ascending(self.by_height(heights).heights()).map(Heights::new);
        self.0.smoothed.get_or_init(smoothed).clone()
    }
}

impl PartialEq for OnDemand {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_radii_above_a_height() {
        let (heights, radii) = ([3.0, 1.0, 2.0, 2.0], [4.0, 1.0, 2.0, 6.0]);
        let by_height = ByHeight::new(&heights);
        assert_eq!((by_height.places(), by_height.heights()), (&[1, 2, 3, 0][..], &[1.0, 2.0, 2.0, 3.0][..]));
        let above = RadiiAbove::new(&by_height, &radii);
        for (height, mean) in
            [(0.0, 3.25), (1.0, 4.0), (1.5, 4.0), (2.0, 4.0), (2.5, 4.0), (3.0, 4.0), (9.0, 4.0)]
        {
            assert_eq!(above.mean(height), mean, "{height}");
        }
        let above = RadiiAbove::new(&by_height, &[5.0, 1.0, 2.0, 6.0]);
        assert_eq!([above.mean(1.0), above.mean(2.0)], [13.0 / 3.0, 5.0]);
    }
}
