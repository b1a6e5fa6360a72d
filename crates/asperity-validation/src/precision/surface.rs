//! Cost of a random map and how far its summits are from those of an infinite surface on a fine grid.
//!
//! Surfaces are Gaussian with the autocorrelation exp(-(r/l)^2). Lengths are in units of l and heights in those of their deviation.

use std::time::Instant;

use asperity::numeric::Sum;
use asperity::topography::Drops;
use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::topography::summits::{Detail, Neighbours, Summits, find};
use asperity::topography::theory::{Expected, five_point};
use asperity::{Heights, MapError};

/// Points per correlation length of the fine grid; more change the results by at most 1e-4.
const FINE: f64 = 200.0;

/// A statistic of summits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// Summits per area.
    Density,
    /// 1/(mean curvature).
    Radius,
    /// Standard deviation of the heights.
    Sigma,
}

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceTask {
    /// Points per correlation length, ascending.
    pub per_length: Vec<f64>,
    /// Sides of the maps in correlation lengths, ascending.
    pub lengths: Vec<f64>,
    /// Maps of each kind.
    pub realisations: usize,
}

impl SurfaceTask {
    /// Points per length and side of each kind of map, with their places in the task.
    pub fn kinds(&self) -> impl Iterator<Item = ([usize; 2], [f64; 2])> {
        let of_grid = |(i, &per_length): (usize, &f64)| {
            let lengths: Vec<_> = self.lengths.iter().enumerate().collect();
            lengths.into_iter().map(move |(j, &lengths)| ([i, j], [per_length, lengths]))
        };
        self.per_length.iter().enumerate().flat_map(of_grid)
    }
}

/// Maps of one grid and one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Points per correlation length.
    pub per_length: f64,
    /// The side in correlation lengths.
    pub lengths: f64,
    /// Points along a side.
    pub points: usize,
    /// Mean number of summits.
    pub summits: f64,
    /// By [`Statistic`]: expected value on this grid over that on a fine grid, minus 1.
    pub bias: [f64; 3],
    /// Likewise: root mean square of the value of a map over the expected one on this grid, minus 1.
    pub scatter: [f64; 3],
    /// Seconds for a map and its summits, median.
    pub seconds: f64,
}

impl SurfacePoint {
    /// Bias and scatter of a statistic together.
    pub fn error(&self, statistic: Statistic) -> f64 {
        self.bias[statistic as usize].hypot(self.scatter[statistic as usize])
    }
}

/// A map that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum SurfaceError {
    /// A grid that does not show the correlation, or a map that does not hold it.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// A grid that makes no map.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// Points along a side.
pub fn side([per_length, lengths]: [f64; 2]) -> usize {
    (per_length * lengths).round() as usize
}

/// What theory expects of each [`Statistic`] on a grid.
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

/// Each [`Statistic`] of a map.
fn measured(summits: &Summits, pixel: f64) -> [f64; 3] {
    let count = summits.heights.len() as f64;
    let mean = |values: &[f64]| values.iter().copied().collect::<Sum>().value() / count;
    let height = mean(&summits.heights);
    let squares: Vec<f64> = summits.heights.iter().map(|z| (z - height).powi(2)).collect();
    let density = count / (summits.tested as f64 * pixel * pixel);
    [density, mean(&summits.curvatures).recip(), mean(&squares).sqrt()]
}

/// Makes maps of every grid and size; `seed` decides a map by the places of its grid and its size in the task and its number, `done` is
/// called after each.
///
/// # Errors
/// See [`SurfaceError`].
pub fn maps(
    task: &SurfaceTask,
    seed: impl Fn([usize; 2], usize) -> [u8; 32],
    done: impl Fn(),
) -> Result<Vec<SurfacePoint>, SurfaceError> {
    let fine = expected(FINE);
    let mut maps = Vec::new();
    for (places, [per_length, lengths]) in task.kinds() {
        let expected = expected(per_length);
        let points = side([per_length, lengths]);
        let generator = generator(points, per_length)?;
        let (mut seconds, mut squares, mut summits) = (Vec::new(), [0.0; 3], 0);
        for realisation in 0..task.realisations {
            let seed = seed(places, realisation);
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
        let realisations = task.realisations as f64;
        maps.push(SurfacePoint {
            per_length,
            lengths,
            points,
            summits: summits as f64 / realisations,
            bias: [0, 1, 2].map(|k| expected[k] / fine[k] - 1.0),
            scatter: squares.map(|square: f64| (square / realisations).sqrt()),
            seconds: seconds[seconds.len() / 2],
        });
    }
    Ok(maps)
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
        let task =
            SurfaceTask { per_length: vec![2.0, 4.0, 8.0], lengths: vec![12.0, 48.0], realisations: 12 };
        let seed = |[i, j]: [usize; 2], k: usize| {
            let mut seed = [3; 32];
            (seed[0], seed[1], seed[2]) = (i as u8, j as u8, k as u8);
            seed
        };
        let maps = maps(&task, seed, || ()).unwrap();
        assert_eq!(maps.len(), 6);
        for statistic in [Statistic::Density, Statistic::Radius, Statistic::Sigma] {
            let k = statistic as usize;
            // A bias falls with the square of the pixel.
            assert!((maps[2].bias[k] / maps[4].bias[k] / 4.0 - 1.0).abs() < 0.15, "{statistic:?}");
            assert!(maps[4].scatter[k] > 2.0 * maps[5].scatter[k], "{statistic:?}");
        }
    }

    #[test]
    fn a_grid_that_does_not_show_the_correlation_is_refused() {
        let task = SurfaceTask { per_length: vec![0.5], lengths: vec![32.0], realisations: 1 };
        assert!(matches!(maps(&task, |_, _| [0; 32], || ()), Err(SurfaceError::Spectrum(_))));
    }
}
