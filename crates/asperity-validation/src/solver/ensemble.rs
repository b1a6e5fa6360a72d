//! Contact area and gap of an ensemble of surfaces at several resolutions.

use std::f64::consts::PI;

use asperity::bem::{Boundary, Options, Solver};
use asperity::progress::{Progress, Silent};

use super::published::{ENSEMBLE, published};
use super::{Unsolved, unit_pair};

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleTask {
    /// Points along a side, ascending.
    pub points: Vec<usize>,
    /// Surfaces.
    pub realisations: usize,
    /// p/E*.
    pub pressures: Vec<f64>,
    /// Relative dual gap.
    pub error: f64,
}

/// A mean over surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

impl Mean {
    fn new(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let square = values.map(|value| (value - mean).powi(2)).sum::<f64>();
        Self { mean, error: (square / (count * (count - 1.0))).sqrt() }
    }
}

/// The ensemble at one pressure on one grid, or extrapolated from the two finest grids.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsemblePoint {
    /// Points along a side; `None` where extrapolated.
    pub points: Option<usize>,
    /// p/E*.
    pub pressure: f64,
    /// Points in contact over all.
    pub raw_area: Mean,
    /// The same, corrected for the border.
    pub area: Mean,
    /// Mean gap over the r.m.s. height of the surface; `None` where extrapolated.
    pub gap: Option<Mean>,
}

impl EnsemblePoint {
    fn new(points: Option<usize>, pressure: f64, samples: &[Sample]) -> Self {
        let mean = |k: usize| Mean::new(samples.iter().map(|sample| sample[k]));
        Self { points, pressure, raw_area: mean(0), area: mean(1), gap: points.map(|_| mean(2)) }
    }

    /// p/(E* g).
    pub fn reduced_pressure(&self) -> f64 {
        self.pressure / ENSEMBLE.gradient
    }

    /// Area over the reduced pressure: of the corrected area, of the raw one where extrapolated.
    pub fn kappa(&self) -> Mean {
        let Mean { mean, error } = if self.points.is_some() { self.area } else { self.raw_area };
        let kappa = |area: f64| area * ENSEMBLE.gradient / self.pressure;
        Mean { mean: kappa(mean), error: kappa(error) }
    }

    /// Raw over published area, minus 1.
    pub fn difference(&self) -> Option<Mean> {
        let published = published(self.pressure)?.area;
        let Mean { mean, error } = self.raw_area;
        Some(Mean { mean: mean / published - 1.0, error: error / published })
    }
}

/// The ensemble at all pressures.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleResults {
    /// Surfaces.
    pub realisations: usize,
    /// r.m.s. height of the surfaces, m.
    pub height: Mean,
    /// Grid by grid, pressure by pressure.
    pub points: Vec<EnsemblePoint>,
    /// Pressure by pressure: linearly in the pixel, with which the error of raw areas falls; empty of a single grid.
    pub extrapolated: Vec<EnsemblePoint>,
}

impl EnsembleResults {
    /// The points of each grid.
    pub fn grids(&self) -> impl DoubleEndedIterator<Item = &[EnsemblePoint]> {
        self.points.chunk_by(|a, b| a.points == b.points)
    }
}

/// Raw area, corrected area and mean gap over r.m.s. height of one surface.
type Sample = [f64; 3];

/// Area and gap of surfaces of the published ensemble. One unit of progress for each pressure of each map.
///
/// # Errors
/// See [`Unsolved`].
pub fn ensemble(
    task: &EnsembleTask,
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<EnsembleResults, Unsolved> {
    let pair = unit_pair()?;
    let options = Options { boundary: Boundary::Periodic, error: task.error, cap: None };
    let mut heights = Vec::new();
    // By grid, pressure and surface.
    let mut samples: Vec<Vec<Vec<Sample>>> = vec![vec![Vec::new(); task.pressures.len()]; task.points.len()];
    for realisation in 0..task.realisations {
        for (grid, &points) in task.points.iter().enumerate() {
            let map = ENSEMBLE.surface(points, seed(realisation))?;
            let height = rms(map.heights());
            if grid == 0 {
                heights.push(height);
            }
            let solver = Solver::new(&map, &pair, &options)?;
            for (samples, &pressure) in samples[grid].iter_mut().zip(&task.pressures) {
                let contact = solver.at_pressure(pressure, &Silent)?;
                samples.push([contact.raw_area_ratio(), contact.area_ratio(), contact.mean_gap() / height]);
                progress.advance(1.0);
            }
        }
    }
    let points = task.points.iter().zip(&samples).flat_map(|(&points, on_grid)| {
        let samples = task.pressures.iter().zip(on_grid);
        samples.map(move |(&pressure, samples)| EnsemblePoint::new(Some(points), pressure, samples))
    });
    Ok(EnsembleResults {
        realisations: task.realisations,
        height: Mean::new(heights.iter().copied()),
        points: points.collect(),
        extrapolated: extrapolated(task, &samples),
    })
}

fn rms(heights: &[f64]) -> f64 {
    (heights.iter().map(|z| z * z).sum::<f64>() / heights.len() as f64).sqrt()
}

/// Linearly in the pixel, surface by surface.
fn extrapolated(task: &EnsembleTask, samples: &[Vec<Vec<Sample>>]) -> Vec<EnsemblePoint> {
    let ([.., coarse, fine], [.., few, many]) = (samples, task.points.as_slice()) else { return Vec::new() };
    let share = (*many as f64 / *few as f64 - 1.0).recip();
    let limit = |(coarse, fine): (&Sample, &Sample)| -> Sample {
        std::array::from_fn(|k| fine[k] + share * (fine[k] - coarse[k]))
    };
    let point = |(&pressure, (coarse, fine)): (&f64, (&Vec<Sample>, &Vec<Sample>))| {
        let limits: Vec<Sample> = coarse.iter().zip(fine).map(limit).collect();
        EnsemblePoint::new(None, pressure, &limits)
    };
    task.pressures.iter().zip(coarse.iter().zip(fine)).map(point).collect()
}

/// Area over p/(E* g) of Bush, Gibson and Thomas (1975) at vanishing load: (2 pi)^1/2.
pub fn bush_gibson_thomas() -> f64 {
    (2.0 * PI).sqrt()
}

/// The same of Persson (2001): (8/pi)^1/2.
pub fn persson() -> f64 {
    (8.0 / PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::analytical;

    #[test]
    fn extrapolation_removes_an_error_that_falls_with_the_pixel() {
        let task =
            EnsembleTask { points: vec![100, 300], realisations: 2, pressures: vec![1.0], error: 1e-6 };
        let area = |limit: f64, points: f64| [limit * (1.0 + 20.0 / points), limit - 1.0 / points, 0.0];
        let samples = |points: f64| vec![vec![area(0.2, points), area(0.3, points)]];
        let [point] = &extrapolated(&task, &[samples(100.0), samples(300.0)])[..] else { panic!() };
        assert!((point.raw_area.mean - 0.25).abs() < 1e-15 && (point.raw_area.error - 0.05).abs() < 1e-15);
        assert!((point.area.mean - 0.25).abs() < 1e-15);
        let single = EnsembleTask { points: vec![100], ..task };
        assert!(extrapolated(&single, &[samples(100.0)]).is_empty());
    }

    #[test]
    fn light_loads_are_those_of_the_analytical_lines() {
        assert!((analytical::persson(1e-6, 1.0) / 1e-6 / persson() - 1.0).abs() < 1e-9);
        assert!(
            (analytical::bush_gibson_thomas(1e-6, 1.0) / 1e-6 / bush_gibson_thomas() - 1.0).abs() < 1e-15
        );
    }
}
