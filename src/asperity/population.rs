//! A population of asperities by its three numbers, and sets drawn from it.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal};
use rayon::prelude::*;

use super::{AsperitySet, HeightDensity, SetError};
use crate::numeric::sum::CHUNK;

/// Asperities of one radius whose heights follow a density (Greenwood and Williamson 1966).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Population {
    /// Radius of every asperity, m.
    pub radius: f64,
    /// Standard deviation of the asperity heights, m; their mean is 0.
    pub sigma: f64,
    /// Asperities per nominal area, 1/m^2.
    pub density: f64,
    /// Density of the heights.
    pub heights: HeightDensity,
}

/// How the heights of a set are taken from a population.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Draw {
    /// Independent draws; the seed decides them all.
    Random([u8; 32]),
    /// One asperity at the middle of each of n equally probable strata.
    Quantiles,
}

impl Population {
    /// A set of `count` asperities on the nominal area count/density; the same on any number of
    /// threads.
    ///
    /// # Errors
    /// A count of 0, or numbers that make no set.
    pub fn set(&self, count: usize, draw: Draw) -> Result<AsperitySet, SetError> {
        let mut heights = vec![0.0; count];
        heights.par_chunks_mut(CHUNK).enumerate().for_each(|(k, chunk)| match draw {
            Draw::Random(seed) => self.draw(seed, k, chunk),
            Draw::Quantiles => {
                for (i, z) in chunk.iter_mut().enumerate() {
                    let p = ((k * CHUNK + i) as f64 + 0.5) / count as f64;
                    *z = self.sigma * self.heights.quantile(p);
                }
            }
        });
        AsperitySet::new(heights, vec![self.radius; count], count as f64 / self.density)
    }

    /// Each chunk has a ChaCha stream of its own.
    fn draw(&self, seed: [u8; 32], stream: usize, heights: &mut [f64]) {
        let mut rng = ChaCha8Rng::from_seed(seed);
        rng.set_stream(stream as u64);
        for z in heights {
            let standard: f64 = match self.heights {
                HeightDensity::Gaussian => StandardNormal.sample(&mut rng),
                HeightDensity::Exponential => {
                    let excess: f64 = Exp1.sample(&mut rng);
                    excess - 1.0
                }
            };
            *z = self.sigma * standard;
        }
    }
}
