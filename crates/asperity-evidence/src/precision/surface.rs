//! Cost of a random map and how far its summits are from those of an infinite surface on a fine grid.
//!
//! Surfaces are Gaussian with the autocorrelation exp(-(r/l)^2). Lengths are in units of l and heights in those of their deviation.

use std::time::Instant;

use asperity::Heights;
use asperity::numeric::Sum;
use asperity::topography::Drops;
use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::topography::summits::{Detail, Neighbours, Summits, find};
use asperity::topography::theory::{Expected, five_point};

use crate::program::Failed;

/// Points per correlation length of the fine grid; more change the results by at most 1e-4.
const FINE: f64 = 200.0;

/// Places of the statistics of summits: per area, 1/(mean curvature), and the standard deviation of the heights.
pub const DENSITY: usize = 0;
pub const RADIUS: usize = 1;
pub const SIGMA: usize = 2;

#[derive(Debug, Clone, Copy)]
pub struct Maps {
    /// Points per correlation length, ascending.
    pub per_length: &'static [f64],
    /// Sides of the maps in correlation lengths, ascending.
    pub lengths: &'static [f64],
    pub realisations: usize,
}

impl Maps {
    pub const ALL: Self = Self {
        per_length: &[1.0, 2.0, 4.0, 8.0, 16.0],
        lengths: &[16.0, 32.0, 64.0, 128.0],
        realisations: 8,
    };

    pub fn count(&self) -> usize {
        self.per_length.len() * self.lengths.len() * self.realisations
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Points per correlation length.
    pub per_length: f64,
    /// The side in correlation lengths.
    pub lengths: f64,
    pub points: usize,
    pub summits: f64,
    /// By statistic: expected value on this grid over that on a fine grid, minus 1.
    pub bias: [f64; 3],
    /// Likewise: root mean square of the value of a map over the expected one on this grid, minus 1.
    pub scatter: [f64; 3],
    /// Seconds for a map and its summits, median.
    pub seconds: f64,
}

impl SurfacePoint {
    /// Bias and scatter of a statistic together.
    pub fn error(&self, statistic: usize) -> f64 {
        self.bias[statistic].hypot(self.scatter[statistic])
    }
}

/// What theory expects of each statistic on a grid.
fn expected(per_length: f64) -> [f64; 3] {
    let pixel = per_length.recip();
    let drops = Drops::from_correlation(|i, j| (-(i * i + j * j) * pixel * pixel).exp());
    five_point(&drops, 1.0, [pixel; 2]).map_or(
        [f64::NAN; 3],
        |Expected { density, curvature, height_variance, .. }| {
            [density, curvature.recip(), height_variance.sqrt()]
        },
    )
}

/// Each statistic of a map.
fn measured(summits: &Summits, pixel: f64) -> [f64; 3] {
    let count = summits.heights.len() as f64;
    let mean = |values: &[f64]| values.iter().copied().collect::<Sum>().value() / count;
    let height = mean(&summits.heights);
    let squares: Vec<f64> = summits.heights.iter().map(|z| (z - height).powi(2)).collect();
    let density = count / (summits.tested as f64 * pixel * pixel);
    [density, mean(&summits.curvatures).recip(), mean(&squares).sqrt()]
}

/// Makes maps of every grid and size; `seed` decides a map by the places of its grid and its size and its number, `done` is called after
/// each.
pub fn maps(
    maps: &Maps,
    seed: impl Fn([usize; 2], usize) -> [u8; 32],
    done: impl Fn(),
) -> Result<Vec<SurfacePoint>, Failed> {
    let fine = expected(FINE);
    let sides = maps.lengths.iter().enumerate();
    let kinds = maps.per_length.iter().enumerate();
    let mut found = Vec::new();
    for ((i, &per_length), (j, &lengths)) in
        kinds.flat_map(|grid| sides.clone().map(move |side| (grid, side)))
    {
        let expected = expected(per_length);
        let points = (per_length * lengths).round() as usize;
        let generator = generator(points, per_length)?;
        let (mut seconds, mut squares, mut summits) = (Vec::new(), [0.0; 3], 0);
        for realisation in 0..maps.realisations {
            let seed = seed([i, j], realisation);
            let start = Instant::now();
            let (map, _) = generator.surface(Seeds { process: seed, plateau: seed })?;
            let summits_of_map = find(&map, Neighbours::Four, Detail::default());
            seconds.push(start.elapsed().as_secs_f64());
            let measured = measured(&summits_of_map, per_length.recip());
            for (square, (value, expected)) in squares.iter_mut().zip(measured.iter().zip(expected)) {
                *square += (value / expected - 1.0).powi(2);
            }
            summits += summits_of_map.heights.len();
            done();
        }
        seconds.sort_unstable_by(f64::total_cmp);
        let realisations = maps.realisations as f64;
        found.push(SurfacePoint {
            per_length,
            lengths,
            points,
            summits: summits as f64 / realisations,
            bias: [0, 1, 2].map(|k| expected[k] / fine[k] - 1.0),
            scatter: squares.map(|square: f64| (square / realisations).sqrt()),
            seconds: seconds[seconds.len() / 2],
        });
    }
    Ok(found)
}

fn generator(points: usize, per_length: f64) -> Result<SurfaceGenerator, SpectrumError> {
    let process = Process {
        spectrum: Spectrum::new(SpectrumShape::Gaussian(1.0), Lay::default())?,
        of: SpectrumOf::Heights,
        sigma: 1.0,
        heights: Heights::GAUSSIAN,
    };
    let generator =
        SurfaceGenerator { points: [points; 2], pixel: [per_length.recip(); 2], process, plateau: None };
    generator.check().map(|()| generator)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_errs_less_and_a_larger_map_scatters_less() {
        let small = Maps { per_length: &[2.0, 4.0, 8.0], lengths: &[12.0, 48.0], realisations: 12 };
        let seed = |[i, j]: [usize; 2], k: usize| {
            let mut seed = [3; 32];
            (seed[0], seed[1], seed[2]) = (i as u8, j as u8, k as u8);
            seed
        };
        let maps = maps(&small, seed, || ()).unwrap();
        assert_eq!(maps.len(), 6);
        for k in [DENSITY, RADIUS, SIGMA] {
            // A bias falls with the square of the pixel.
            assert!((maps[2].bias[k] / maps[4].bias[k] / 4.0 - 1.0).abs() < 0.15, "{k}");
            assert!(maps[4].scatter[k] > 2.0 * maps[5].scatter[k], "{k}");
        }
    }

    #[test]
    fn a_grid_that_does_not_show_the_correlation_is_refused() {
        let coarse = Maps { per_length: &[0.5], lengths: &[32.0], realisations: 1 };
        assert!(maps(&coarse, |_, _| [0; 32], || ()).unwrap_err().is::<SpectrumError>());
    }
}
