//! A population of asperities, and sets drawn from it; asperity heights from surface heights (Nayak 1971), where sigma is that of the
//! surface, and the sum of two such surfaces.

use std::f64::consts::PI;
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

/// An isotropic Gaussian surface, given by its standard deviation and the density and mean curvature of its summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceHeights {
    /// 1/(mean summit curvature), m.
    pub radius: f64,
    /// Standard deviation of the surface heights, m.
    pub sigma: f64,
    /// Summits per area, 1/m^2.
    pub density: f64,
}

/// No isotropic Gaussian surface has these three numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "density * radius * sigma = {product:.4} {of}; allowed: above {least:.4}, where Nayak's alpha reaches 1.5"
)]
pub struct SurfaceHeightsError {
    product: f64,
    least: f64,
    of: &'static str,
}

/// (density radius sigma)^2 = alpha/(768 pi), and alpha is at least 1.5.
const MIN_PRODUCT: f64 = 0.024934;

/// The same with the sigma of the asperities: (1.5 - (1 + 16/pi - 3 3^.5))/(768 pi).
const MIN_PRODUCT_OF_ASPERITIES: f64 = 0.015812;

/// 1 + 16/pi - 3 3^.5: the variance that summits lack, in m2^2/m4.
fn lost_variance() -> f64 {
    1.0 + 16.0 / PI - 3.0 * 3f64.sqrt()
}

impl SurfaceHeights {
    fn product(&self) -> f64 {
        self.density * self.radius * self.sigma
    }

    /// Nayak's bandwidth parameter alpha = m0 m4/m2^2, from eta = m4/(6 pi 3^.5 m2) and a mean
    /// curvature of (8/3)(m4/pi)^.5.
    pub fn alpha(&self) -> f64 {
        768.0 * PI * self.product().powi(2)
    }

    /// Standard deviation of the summit heights, m: sigma (1 - (1 + 16/pi - 3 3^.5)/alpha)^.5.
    ///
    /// # Errors
    /// `alpha` at most 1.5, which no surface has.
    pub fn asperity_sigma(&self) -> Result<f64, SurfaceHeightsError> {
        let alpha = self.alpha();
        if alpha > 1.5 {
            Ok(self.sigma * (1.0 - lost_variance() / alpha).sqrt())
        } else {
            Err(SurfaceHeightsError {
                product: self.product(),
                least: MIN_PRODUCT,
                of: "with heights = \"surface\"",
            })
        }
    }

    /// Mean summit height above the mean plane, m: 4 (m0/(pi alpha))^.5.
    pub fn mean_asperity_height(&self) -> f64 {
        4.0 * self.sigma / (PI * self.alpha()).sqrt()
    }

    /// The surface whose summits are a population of Gaussian heights.
    ///
    /// # Errors
    /// A population that is too smooth for its density: the summits of no such surface.
    pub fn of_asperities(population: &Population) -> Result<Self, SurfaceHeightsError> {
        let &Population { radius, sigma, density, .. } = population;
        let product = density * radius * sigma;
        let surface = Self { radius, sigma, density };
        // m2^2/m4 = m0/alpha.
        let lost = lost_variance() * sigma * sigma / surface.alpha();
        if product > MIN_PRODUCT_OF_ASPERITIES {
            Ok(Self { sigma: (sigma * sigma + lost).sqrt(), ..surface })
        } else {
            let least = MIN_PRODUCT_OF_ASPERITIES;
            Err(SurfaceHeightsError { product, least, of: "of asperities" })
        }
    }

    /// Its profile moments m0 (m^2), m2 and m4 (1/m^2).
    pub fn spectral_moments(&self) -> [f64; 3] {
        let m4 = PI * (3.0 / (8.0 * self.radius)).powi(2);
        [self.sigma * self.sigma, m4 / (6.0 * PI * 3f64.sqrt() * self.density), m4]
    }

    /// The sum of two independent surfaces: their moments add.
    pub fn composite(bodies: [Self; 2]) -> Self {
        let [first, second] = bodies.map(|body| body.spectral_moments());
        let [m0, m2, m4]: [f64; 3] = std::array::from_fn(|k| first[k] + second[k]);
        Self {
            radius: 3.0 / 8.0 * (PI / m4).sqrt(),
            sigma: m0.sqrt(),
            density: m4 / (6.0 * PI * 3f64.sqrt() * m2),
        }
    }

    /// Its asperities, of one radius and Gaussian heights.
    ///
    /// # Errors
    /// As [`Self::asperity_sigma`].
    pub fn population(&self) -> Result<Population, SurfaceHeightsError> {
        let &Self { radius, density, .. } = self;
        Ok(Population { radius, sigma: self.asperity_sigma()?, density, heights: Heights::GAUSSIAN })
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

    /// PHYSICS part B gives these for Table 1 of Pasaribu and Schipper (2005).
    #[test]
    fn table_1_read_as_surface_heights() {
        for (radius, sigma, density, alpha, ratio, offset) in
            [(2e-5, 4.8e-8, 6e10, 8.00, 0.942, 0.798), (1.6e-6, 2.6e-7, 9e10, 3.38, 0.857, 1.227)]
        {
            let surface = SurfaceHeights { radius, sigma, density };
            assert!((surface.alpha() - alpha).abs() < 5e-3);
            assert!((surface.asperity_sigma().unwrap() / sigma - ratio).abs() < 5e-4);
            assert!((surface.mean_asperity_height() / sigma - offset).abs() < 5e-4);
        }
    }

    #[test]
    fn the_least_product_is_that_of_alpha_1_5() {
        let at = |product| SurfaceHeights { radius: product, sigma: 1.0, density: 1.0 };
        assert!((at(MIN_PRODUCT).alpha() - 1.5).abs() < 1e-4);
        assert!(at(0.99 * MIN_PRODUCT).asperity_sigma().is_err());
        let of = |sigma| Population { radius: 1.0, sigma, density: 1.0, heights: Heights::GAUSSIAN };
        let least = SurfaceHeights::of_asperities(&of(1.0001 * MIN_PRODUCT_OF_ASPERITIES)).unwrap();
        assert!((least.alpha() - 1.5).abs() < 1e-3 && least.asperity_sigma().is_ok());
        assert!(SurfaceHeights::of_asperities(&of(0.99 * MIN_PRODUCT_OF_ASPERITIES)).is_err());
    }

    #[test]
    fn composites_add_spectral_moments() {
        let surface = SurfaceHeights { radius: 2e-5, sigma: 4.8e-8, density: 6e10 };
        let back = SurfaceHeights::of_asperities(&surface.population().unwrap()).unwrap();
        assert!((back.sigma / surface.sigma - 1.0).abs() < 1e-14);
        let [m0, m2, m4] = surface.spectral_moments();
        assert!((m0 * m4 / (m2 * m2) / surface.alpha() - 1.0).abs() < 1e-14);
        // Twice the same surface: alike but for its scale.
        let both = SurfaceHeights::composite([surface; 2]);
        let ratios = [both.sigma / surface.sigma, surface.radius / both.radius];
        assert!(ratios.iter().all(|ratio| (ratio / 2f64.sqrt() - 1.0).abs() < 1e-14), "{ratios:?}");
        assert!((both.density / surface.density - 1.0).abs() < 1e-14);
        // Of a rough long-waved and a fine short-waved one neither alpha nor density is a mean: m0 is that of the first, m4 of the second.
        let fine = SurfaceHeights { radius: 1e-7, sigma: 1e-9, density: 4e14 };
        let both = SurfaceHeights::composite([surface, fine]);
        assert!((both.sigma / surface.sigma - 1.0).abs() < 1e-3);
        assert!((both.radius / fine.radius - 1.0).abs() < 1e-3);
        assert!(both.alpha() > 100.0 * surface.alpha().max(fine.alpha()), "{}", both.alpha());
    }
}
