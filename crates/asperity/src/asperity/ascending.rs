//! The asperities of a set in the order of a column, and their mean radius above a height.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use crate::distribution::{EqualHeights, Heights, Smoothed};
use crate::memory::{collected, reserve, zeros};
use crate::numeric::parallel::once;
use crate::numeric::sort::ascending;

/// The asperities of a set in ascending order of a column, such as their heights.
#[derive(Debug, PartialEq)]
pub struct Ascending {
    places: Vec<usize>,
    values: Vec<f64>,
}

impl Ascending {
    /// Of a column of `values`.
    pub fn new(values: &[f64]) -> Self {
        let places = ascending(values);
        Self { values: collected(places.par_iter().map(|&place| values[place])), places }
    }

    /// The places in the set, equal values in the order of the set.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// That of the set without the asperities at some places: nothing is sorted.
    fn without(&self, left_out: &[usize]) -> Self {
        let staying = Staying::new(self.places.len(), left_out);
        let rest = staying.count;
        // Each is written, and the next one over it unless it stays.
        let (mut places, mut values) = (zeros(rest + 1), zeros(rest + 1));
        let mut next = 0;
        for (&place, &value) in self.places.iter().zip(&self.values) {
            let (stays, before) = staying.at(place);
            places[next] = before;
            values[next] = value;
            next += usize::from(stays);
        }
        places.truncate(rest);
        values.truncate(rest);
        Self { places, values }
    }
}

/// Which asperities of a set stay, where some are left out: of each word of places a bit for those that stay, and their number before
/// it. Both fit into a cache, which a new place for each asperity would not.
pub(super) struct Staying {
    words: Vec<(u64, usize)>,
    /// Number of asperities that stay.
    count: usize,
}

impl Staying {
    const BITS: usize = u64::BITS as usize;

    /// Of `all` asperities those that are not at the places `left_out`.
    pub fn new(all: usize, left_out: &[usize]) -> Self {
        let mut words = vec![(u64::MAX, 0); all.div_ceil(Self::BITS)];
        left_out.iter().for_each(|&place| words[place / Self::BITS].0 &= !(1 << (place % Self::BITS)));
        let mut count = 0;
        for (bits, before) in &mut words {
            *before = count;
            count += bits.count_ones() as usize;
        }
        Self { words, count: all - left_out.len() }
    }

    /// Whether an asperity stays, and how many before it.
    #[inline]
    fn at(&self, place: usize) -> (bool, usize) {
        let (bits, before) = self.words[place / Self::BITS];
        let bit = 1 << (place % Self::BITS);
        (bits & bit != 0, before + (bits & (bit - 1)).count_ones() as usize)
    }

    /// The values of those that stay.
    pub fn of<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let first = &values[..values.len().min(self.count + 1)];
        let mut kept = Vec::new();
        reserve(&mut kept, first.len());
        kept.extend_from_slice(first);
        // Each is written, and the next one over it unless it stays: no branch to be guessed.
        let mut next = 0;
        for (&(mut bits, _), values) in self.words.iter().zip(values.chunks(Self::BITS)) {
            for &value in values {
                kept[next] = value;
                next += (bits & 1) as usize;
                bits >>= 1;
            }
        }
        kept.truncate(self.count);
        kept
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
    /// That of the asperities above `height` (m, in the frame of the heights), m; above all of them the radius of the highest one.
    pub fn mean(&self, height: f64) -> f64 {
        let below = self.heights.partition_point(|z| *z <= height);
        self.means[below.min(self.means.len() - 1)]
    }
}

/// The mean of `radii` from each asperity on in the order of height.
fn means_above(by_height: &Ascending, radii: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut means = collected(by_height.places.par_iter().map(|&place| radii[place]));
    for (index, mean) in means.iter_mut().rev().enumerate() {
        sum += *mean;
        *mean = sum / (index + 1) as f64;
    }
    means
}

/// What follows from a set, found when it is first asked for. Two sets are compared without it.
#[derive(Debug, Clone, Default)]
pub(super) struct OnDemand(Arc<Found>);

#[derive(Debug, Default)]
struct Found {
    by_height: OnceLock<Ascending>,
    by_radius: OnceLock<Ascending>,
    means_above: OnceLock<Vec<f64>>,
    smoothed: OnceLock<Result<Heights, EqualHeights>>,
}

impl OnDemand {
    /// The order of `heights`: from that of the whole set where it is known.
    pub(super) fn by_height(&self, heights: &[f64], whole: Option<Whole>) -> &Ascending {
        order(&self.0.by_height, heights, whole.map(|whole| (&whole.found.0.by_height, whole.left_out)))
    }

    /// The order of `radii`, in the same way.
    pub(super) fn by_radius(&self, radii: &[f64], whole: Option<Whole>) -> &Ascending {
        order(&self.0.by_radius, radii, whole.map(|whole| (&whole.found.0.by_radius, whole.left_out)))
    }

    /// The mean radius above a height of asperities of `radii`.
    pub(super) fn radii_above<'a>(&'a self, by_height: &'a Ascending, radii: &[f64]) -> RadiiAbove<'a> {
        let means = once(&self.0.means_above, || means_above(by_height, radii));
        RadiiAbove { heights: &by_height.values, means }
    }

    /// The heights of a set as a smoothed density.
    pub(super) fn smoothed(&self, by_height: &Ascending) -> Result<Heights, EqualHeights> {
        let smoothed = || Smoothed::of_ascending(by_height.values()).map(Heights::new);
        once(&self.0.smoothed, smoothed).clone()
    }
}

/// The order of `values`: from that of the whole set where it is known.
fn order<'a>(
    found: &'a OnceLock<Ascending>,
    values: &[f64],
    whole: Option<(&OnceLock<Ascending>, &[usize])>,
) -> &'a Ascending {
    once(found, || {
        let known = whole.and_then(|(whole, left_out)| Some(whole.get()?.without(left_out)));
        known.unwrap_or_else(|| Ascending::new(values))
    })
}

/// What was found of a set, and the places of its asperities that are left out.
#[derive(Clone, Copy)]
pub(super) struct Whole<'a> {
    pub found: &'a OnDemand,
    pub left_out: &'a [usize],
}

impl PartialEq for OnDemand {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal values too, and none or all left out.
    #[test]
    fn the_order_of_a_part_is_that_of_the_whole() {
        let values: Vec<f64> = (0..100).map(|k| f64::from((k * 37) % 23)).collect();
        let whole = Ascending::new(&values);
        for left_out in
            [vec![], vec![0], vec![99], vec![3, 4, 50, 98], (0..100).step_by(2).collect(), (0..100).collect()]
        {
            let rest: Vec<f64> = (0..100).filter(|k| !left_out.contains(k)).map(|k| values[k]).collect();
            assert_eq!(whole.without(&left_out), Ascending::new(&rest));
        }
    }

    #[test]
    fn mean_radii_above_a_height() {
        let (heights, radii) = ([3.0, 1.0, 2.0, 2.0], [4.0, 1.0, 2.0, 6.0]);
        let by_height = Ascending::new(&heights);
        assert_eq!((by_height.places(), by_height.values()), (&[1, 2, 3, 0][..], &[1.0, 2.0, 2.0, 3.0][..]));
        let means = means_above(&by_height, &radii);
        let above = RadiiAbove { heights: by_height.values(), means: &means };
        for (height, mean) in
            [(0.0, 3.25), (1.0, 4.0), (1.5, 4.0), (2.0, 4.0), (2.5, 4.0), (3.0, 4.0), (9.0, 4.0)]
        {
            assert_eq!(above.mean(height), mean, "{height}");
        }
        let means = means_above(&by_height, &[5.0, 1.0, 2.0, 6.0]);
        let above = RadiiAbove { heights: by_height.values(), means: &means };
        assert_eq!([above.mean(1.0), above.mean(2.0)], [13.0 / 3.0, 5.0]);
    }
}
