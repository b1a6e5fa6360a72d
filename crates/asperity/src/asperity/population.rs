//! A population of asperities, and sets drawn from it.

use std::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{AsperitySet, SetError};
use crate::distribution::Heights;
use crate::memory::zeros;
use crate::numeric::parallel::for_each_row;

/// Heights per ChaCha stream, the smallest part of a set. All published random results depend on it.
pub const STREAM: usize = 4096;

/// Asperities of one radius whose heights follow a distribution (Greenwood and Williamson 1966).
#[derive(Debug, Clone, PartialEq)]
pub struct Population {
    /// Radius of every asperity, m.
    pub radius: f64,
    /// Standard deviation of the asperity heights, m; their mean is 0.
    pub sigma: f64,
    /// Asperities per nominal area, 1/m^2.
    pub density: f64,
    /// Distribution of height/sigma.
    pub heights: Heights,
}

/// How the heights of a set are taken from a population.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Draw {
    /// Independent random draws, determined by the seed.
    Random([u8; 32]),
    /// The quantiles at the middle of n equally probable strata.
    Quantiles,
}

impl Population {
    /// A set of `count` asperities on the nominal area count/density; the same on any number of
    /// threads.
    ///
    /// # Errors
    /// A count of 0, or values that [`AsperitySet::new`] rejects.
    pub fn set(&self, count: usize, draw: Draw) -> Result<AsperitySet, SetError> {
        let heights = self.heights_of(count, draw);
        AsperitySet::new(heights, vec![self.radius; count], count as f64 / self.density)
    }

    /// The asperities `streams` * [`STREAM`] of [`Self::set`], on their share of its nominal area: any part of a set that
    /// is larger than memory.
    ///
    /// # Errors
    /// As [`Self::set`]; a part without asperities.
    pub fn part(&self, streams: Range<usize>, count: usize, draw: Draw) -> Result<AsperitySet, SetError> {
        let end = count.min(streams.end.saturating_mul(STREAM));
        let length = end.saturating_sub(streams.start.saturating_mul(STREAM));
        let heights = self.heights_from(streams.start, length, count, draw);
        AsperitySet::new(heights, vec![self.radius; length], length as f64 / self.density)
    }

    /// The heights of [`Self::set`], m.
    pub(crate) fn heights_of(&self, count: usize, draw: Draw) -> Vec<f64> {
        self.heights_from(0, count, count, draw)
    }

    /// `length` of the `count` heights, from a stream on.
    fn heights_from(&self, stream: usize, length: usize, count: usize, draw: Draw) -> Vec<f64> {
        let mut heights = zeros(length);
        for_each_row(&mut heights, STREAM, &|k, chunk| match draw {
            Draw::Random(seed) => self.draw(seed, stream + k, chunk),
            Draw::Quantiles => {
                let first = (stream + k) * STREAM;
                chunk
                    .iter_mut()
                    .enumerate()
                    .for_each(|(i, p)| *p = ((first + i) as f64 + 0.5) / count as f64);
                self.heights.map_probabilities(chunk, self.sigma);
            }
        });
        heights
    }

    /// Heights of one ChaCha stream.
    fn draw(&self, seed: [u8; 32], stream: usize, heights: &mut [f64]) {
        let mut rng = ChaCha8Rng::from_seed(seed);
        rng.set_stream(stream as u64);
        self.heights.draw(&mut rng, heights);
        heights.iter_mut().for_each(|z| *z *= self.sigma);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::REGISTRY;

    const UNIT: Population = Population { radius: 1.0, sigma: 2.0, density: 4.0, heights: Heights::GAUSSIAN };

    #[test]
    fn quantiles_are_the_middles_of_equally_probable_strata() {
        let set = UNIT.set(2, Draw::Quantiles).unwrap();
        let quartile = 2.0 * 0.674_489_750_196_081_7;
        assert!((set.heights()[0] + quartile).abs() < 1e-14);
        assert!((set.heights()[1] - quartile).abs() < 1e-14);
        assert_eq!((set.radii(), set.nominal_area()), (&[1.0, 1.0][..], 0.5));
        let exponential = Population { heights: Heights::EXPONENTIAL, ..UNIT };
        let median = exponential.set(1, Draw::Quantiles).unwrap().heights()[0];
        assert!((median - 2.0 * (2f64.ln() - 1.0)).abs() < 1e-15);
    }

    #[test]
    fn draws_have_the_mean_and_deviation_of_their_density() {
        for heights in REGISTRY.iter().map(|entry| entry.example().unwrap()) {
            let population = Population { heights: heights.clone(), ..UNIT };
            let set = population.set(200_000, Draw::Random([3; 32])).unwrap();
            let found = crate::asperity::Statistics::new(&set);
            assert!(found.mean_height.abs() < 0.02, "{heights:?}: {}", found.mean_height);
            assert!((found.sigma - 2.0).abs() < 0.03, "{heights:?}: {}", found.sigma);
            assert!((found.skewness.unwrap() - heights.skewness()).abs() < 0.1, "{heights:?}");
        }
    }

    #[test]
    fn parts_make_up_the_set() {
        let count = 3 * STREAM + 100;
        for draw in [Draw::Random([7; 32]), Draw::Quantiles] {
            let whole = UNIT.set(count, draw).unwrap();
            let parts = [0..1, 1..3, 3..9].map(|streams| UNIT.part(streams, count, draw).unwrap());
            let heights: Vec<f64> = parts.iter().flat_map(|part| part.heights().to_vec()).collect();
            assert_eq!(heights, whole.heights());
            assert_eq!(parts.map(|part| part.nominal_area()), [1024.0, 2048.0, 25.0]);
            assert_eq!(UNIT.part(4..5, count, draw), Err(SetError::Empty));
            assert_eq!(UNIT.set(0, draw), Err(SetError::Empty));
        }
    }
}
