//! Periodic self-affine surfaces scaled to a given r.m.s. gradient.

use std::f64::consts::TAU;

use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::{HeightMap, Heights};
use asperity_fft::{Complex64, FftDirection};

use crate::Failed;

/// A self-affine Gaussian process on a square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    pub side: f64,
    pub hurst: f64,
    /// Longest waves of the power law, m.
    pub roll_off: f64,
    /// Shortest waves, m.
    pub cut_off: f64,
    /// Root mean square of the gradient of each surface.
    pub gradient: f64,
    /// Lengths along x over those along y.
    pub elongation: f64,
}

impl SelfAffine {
    /// The surface of `seed`, of zero mean: amplitudes and phases of its waves are random. On another number of points it is
    /// the same surface.
    pub fn surface(&self, points: usize, seed: [u8; 32]) -> Result<HeightMap, Failed> {
        let Self { side, hurst, roll_off, cut_off, gradient, elongation } = *self;
        let shape = SpectrumShape::SelfAffine { hurst, roll_off, cut_off };
        let process = Process {
            spectrum: Spectrum::new(shape, Lay { elongation, ..Lay::default() })?,
            of: SpectrumOf::Heights,
            sigma: 1.0,
            heights: Heights::GAUSSIAN,
        };
        let pixel = [side / points as f64; 2];
        let generator = SurfaceGenerator { points: [points; 2], pixel, process, plateau: None };
        generator.check()?;
        let (map, _) = generator.surface(Seeds { process: seed, plateau: seed })?;
        let factor = gradient / rms_gradient(&map);
        let heights = map.heights().iter().map(|z| factor * z).collect();
        Ok(HeightMap::new(map.points(), map.pixel(), heights, 0.0)?.periodic())
    }
}

/// Root mean square of the gradient of a periodic map, by its waves: that of the surface, not of its differences.
fn rms_gradient(map: &HeightMap) -> f64 {
    let ([nx, ny], [dx, dy]) = (map.points(), map.pixel());
    let x = (0..ny).map(|j| square_of_slopes((0..nx).map(|i| map.heights()[i * ny + j]), dx));
    let y = (0..nx).map(|i| square_of_slopes((0..ny).map(|j| map.heights()[i * ny + j]), dy));
    let mean = |sum: f64, lines: usize, count: usize| sum / (lines as f64 * (count as f64).powi(2));
    (mean(x.sum(), ny, nx) + mean(y.sum(), nx, ny)).sqrt()
}

/// The squares of the slopes of the waves of a line that repeats, added up.
fn square_of_slopes(heights: impl Iterator<Item = f64>, pixel: f64) -> f64 {
    let mut waves: Vec<Complex64> = heights.map(|z| Complex64::new(z, 0.0)).collect();
    let count = waves.len();
    asperity_fft::complex(count, FftDirection::Forward).process(&mut waves);
    let unit = TAU / (count as f64 * pixel);
    let slope = |(k, wave): (usize, &Complex64)| (unit * k.min(count - k) as f64).powi(2) * wave.norm_sqr();
    waves.iter().enumerate().map(slope).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_of_waves() {
        let points = [24, 15];
        let wave = |k: usize| {
            let [x, y] = [(k / 15) as f64 / 24.0, (k % 15) as f64 / 15.0];
            3.0 * (TAU * 2.0 * x).cos() + (TAU * (x + 4.0 * y)).sin()
        };
        let map =
            HeightMap::new(points, [2.0 / 24.0, 0.5 / 15.0], (0..360).map(wave).collect(), 0.0).unwrap();
        let q = [TAU / 2.0, TAU / 0.5];
        let exact = (0.5 * ((6.0 * q[0]).powi(2) + q[0].powi(2) + (4.0 * q[1]).powi(2))).sqrt();
        assert!((rms_gradient(&map) / exact - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_surface_is_the_same_on_more_points() {
        let process = SelfAffine {
            side: 2.0,
            hurst: 0.8,
            roll_off: 2.0,
            cut_off: 0.25,
            gradient: 0.3,
            elongation: 1.0,
        };
        let [coarse, fine] = [32, 64].map(|points| process.surface(points, [5; 32]).unwrap());
        for k in 0..32 * 32 {
            let same = fine.heights()[2 * (k / 32) * 64 + 2 * (k % 32)];
            assert!((coarse.heights()[k] - same).abs() < 1e-14);
        }
        assert!((rms_gradient(&fine) - 0.3).abs() < 1e-15);
        assert!(process.surface(8, [5; 32]).is_err());
    }
}
