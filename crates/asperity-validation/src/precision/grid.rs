//! How far the summits of a random map are from those of an endless surface on a fine grid.
//!
//! Surfaces are Gaussian with the autocorrelation exp(-(r/l)^2). Lengths are in units of l and heights in
//! those of their deviation.

use std::time::Instant;

use asperity::compare::SlopeFit;
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

impl Statistic {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Density, Self::Radius, Self::Sigma];

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Radius => "radius",
            Self::Sigma => "sigma",
        }
    }
}

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct GridTask {
    /// Points a correlation length, ascending.
    pub per_length: Vec<f64>,
    /// Sides of the maps in correlation lengths, ascending.
    pub lengths: Vec<f64>,
    /// Maps of each kind.
    pub realisations: usize,
}

/// Maps of one grid and one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridPoint {
    /// Points a correlation length.
    pub per_length: f64,
    /// The side in correlation lengths.
    pub lengths: f64,
    /// Points along a side.
    pub points: usize,
    /// Summits found, in the mean.
    pub summits: f64,
    /// Of [`Statistic::ALL`]: expected value on this grid over that on a fine grid, minus 1.
    pub bias: [f64; 3],
    /// Of each: root mean square of what is found over what theory expects on this grid, less 1.
    pub scatter: [f64; 3],
    /// Seconds for a map and its summits, median.
    pub seconds: f64,
}

impl GridPoint {
    /// Points in all.
    pub fn all_points(&self) -> f64 {
        (self.points * self.points) as f64
    }

    /// Bias and scatter of a statistic together.
    pub fn error(&self, statistic: Statistic) -> f64 {
        self.bias[statistic as usize].hypot(self.scatter[statistic as usize])
    }
}

/// Maps of all grids and sizes.
#[derive(Debug, Clone, PartialEq)]
pub struct GridFindings {
    /// Grid by grid, size by size.
    pub points: Vec<GridPoint>,
}

/// What four times the points do, as twice the points a length or as twice the side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doubling {
    /// Times smaller bias of the radius, on a finer grid.
    pub bias: f64,
    /// Times smaller scatter of the density, on a larger map.
    pub scatter: f64,
    /// Times longer, of either.
    pub time: f64,
}

/// A map that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum GridError {
    /// A grid that does not show the correlation, or a map that does not hold it.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// A grid that makes no map.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// Points along a side.
pub fn side(per_length: f64, lengths: f64) -> usize {
    (per_length * lengths).round() as usize
}

/// What theory expects of [`Statistic::ALL`] on a grid.
fn expected(per_length: f64) -> Option<[f64; 3]> {
    let pixel = per_length.recip();
    let drops = Drops::of(|i, j| (-(i * i + j * j) * pixel * pixel).exp());
    let Expected { density, curvature, height_variance, .. } = five_point(&drops, 1.0, [pixel; 2])?;
    Some([density, curvature.recip(), height_variance.sqrt()])
}

/// What was found on a map.
fn found(summits: &Summits, pixel: f64) -> [f64; 3] {
    let count = summits.heights.len() as f64;
    let mean = |values: &[f64]| values.iter().copied().collect::<Sum>().value() / count;
    let height = mean(&summits.heights);
    let squares: Vec<f64> = summits.heights.iter().map(|z| (z - height).powi(2)).collect();
    [
        count / (summits.tested as f64 * pixel * pixel),
        mean(&summits.curvatures).recip(),
        mean(&squares).sqrt(),
    ]
}

/// Makes maps of every grid and size; `seed(per_length, lengths, realisation)` decides a map by places in the task,
/// `done` is called with the points of each.
///
/// # Errors
/// See [`GridError`].
pub fn maps_of(
    task: &GridTask,
    seed: impl Fn(usize, usize, usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<GridFindings, GridError> {
    let mut points = Vec::new();
    let fine = expected(FINE).unwrap_or([f64::NAN; 3]);
    for (i, &per_length) in task.per_length.iter().enumerate() {
        let on_grid = expected(per_length).unwrap_or([f64::NAN; 3]);
        for (j, &lengths) in task.lengths.iter().enumerate() {
            let count = side(per_length, lengths);
            let generator = generator(count, per_length)?;
            let (mut seconds, mut squares, mut summits) = (Vec::new(), [0.0; 3], 0);
            for realisation in 0..task.realisations {
                let seed = seed(i, j, realisation);
                let start = Instant::now();
                let (map, _) = generator.surface(Seeds { process: seed, plateau: seed })?;
                let found_summits = find(&map, Neighbours::Four, Detail::default());
                seconds.push(start.elapsed().as_secs_f64());
                let values = found(&found_summits, per_length.recip());
                for (square, (value, expected)) in squares.iter_mut().zip(values.iter().zip(on_grid)) {
                    *square += (value / expected - 1.0).powi(2);
                }
                summits += found_summits.heights.len();
                done(count * count);
            }
            seconds.sort_unstable_by(f64::total_cmp);
            let realisations = task.realisations as f64;
            points.push(GridPoint {
                per_length,
                lengths,
                points: count,
                summits: summits as f64 / realisations,
                bias: [0, 1, 2].map(|k| on_grid[k] / fine[k] - 1.0),
                scatter: squares.map(|square: f64| (square / realisations).sqrt()),
                seconds: seconds[seconds.len() / 2],
            });
        }
    }
    Ok(GridFindings { points })
}

fn generator(count: usize, per_length: f64) -> Result<SurfaceGenerator, SpectrumError> {
    let process = Process {
        spectrum: Spectrum::new(SpectrumShape::Gaussian(1.0), Lay::default())?,
        of: SpectrumOf::Heights,
        sigma: 1.0,
        heights: Heights::GAUSSIAN,
    };
    let generator =
        SurfaceGenerator { points: [count; 2], pixel: [per_length.recip(); 2], process, plateau: None };
    generator.check().map(|()| generator)
}

impl GridFindings {
    /// Of a statistic: exponent with which its bias decreases with the points per length, on the finer half of the grids.
    pub fn bias_slope(&self, statistic: Statistic) -> Option<f64> {
        let largest = self.points.iter().map(|point| point.lengths).fold(0.0, f64::max);
        let one_size: Vec<&GridPoint> = self.points.iter().filter(|point| point.lengths == largest).collect();
        let finer = one_size[(one_size.len() / 2).min(one_size.len().saturating_sub(3))..].iter();
        let bias = finer.map(|point| (point.per_length, point.bias[statistic as usize].abs()));
        SlopeFit::through(bias).map(|fit| fit.slope)
    }

    /// Of a statistic: exponent with which its scatter decreases with the number of summits, over all maps.
    pub fn scatter_slope(&self, statistic: Statistic) -> Option<f64> {
        let scatter = self.points.iter().map(|point| (point.summits, point.scatter[statistic as usize]));
        SlopeFit::through(scatter).map(|fit| fit.slope)
    }

    /// What twice the points a length, and twice the side, do.
    pub fn doubling(&self) -> Option<Doubling> {
        Some(Doubling {
            bias: 2f64.powf(-self.bias_slope(Statistic::Radius)?),
            // Twice the side has four times the summits.
            scatter: 4f64.powf(-self.scatter_slope(Statistic::Density)?),
            time: 4f64.powf(self.time_slope()?),
        })
    }

    /// The cheapest map whose radius is within `error` of that of an endless surface on a fine grid.
    pub fn cheapest(&self, error: f64) -> Option<&GridPoint> {
        let good = self.points.iter().filter(|point| point.error(Statistic::Radius) <= error);
        good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// By what power of the number of points the time grows, over maps of 10^4 points and more.
    pub fn time_slope(&self) -> Option<f64> {
        const LARGE: f64 = 1e4;
        let large = self.points.iter().filter(|point| point.all_points() >= LARGE);
        SlopeFit::through(large.map(|point| (point.all_points(), point.seconds))).map(|fit| fit.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_errs_less_and_a_larger_map_scatters_less() {
        let task = GridTask { per_length: vec![2.0, 4.0, 8.0], lengths: vec![12.0, 48.0], realisations: 12 };
        let seed = |i: usize, j: usize, k: usize| {
            let mut seed = [3; 32];
            (seed[0], seed[1], seed[2]) = (i as u8, j as u8, k as u8);
            seed
        };
        let found = maps_of(&task, seed, |_| ()).unwrap();
        assert_eq!(found.points.len(), 6);
        for statistic in Statistic::ALL {
            let k = statistic as usize;
            assert!(found.points[0].bias[k].abs() > 4.0 * found.points[4].bias[k].abs(), "{statistic:?}");
            assert!(found.points[4].scatter[k] > 2.0 * found.points[5].scatter[k], "{statistic:?}");
        }
        let slope = found.bias_slope(Statistic::Radius).unwrap();
        assert!((slope + 2.0).abs() < 0.3, "{slope}");
    }

    #[test]
    fn a_grid_that_does_not_show_the_correlation_is_refused() {
        let task = GridTask { per_length: vec![0.5], lengths: vec![32.0], realisations: 1 };
        assert!(matches!(maps_of(&task, |_, _, _| [0; 32], |_| ()), Err(GridError::Spectrum(_))));
    }
}
