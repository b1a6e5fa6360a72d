//! Contact area and gap of an ensemble of surfaces at several resolutions.

use std::f64::consts::PI;

use asperity::bem::{Boundary, Options, Solver};
use asperity::progress::{Progress, Silent};

use super::{SelfAffine, Unsolved, unit_pair};

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
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        Self { mean, error: (square / (count * (count - 1.0))).sqrt() }
    }

    /// Times a number.
    pub fn times(self, factor: f64) -> Self {
        Self { mean: factor * self.mean, error: factor.abs() * self.error }
    }
}

/// The ensemble at one pressure on one grid.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsemblePoint {
    /// Points along a side.
    pub points: usize,
    /// p/E*.
    pub pressure: f64,
    /// Points in contact over all.
    pub raw_area: Mean,
    /// The same, corrected for the border.
    pub area: Mean,
    /// Mean gap over the r.m.s. height of the surface.
    pub gap: Mean,
}

/// The areas at one pressure, extrapolated to points without end from the two finest grids.
#[derive(Debug, Clone, PartialEq)]
pub struct Extrapolated {
    /// p/E*.
    pub pressure: f64,
    /// From the raw areas, whose error falls with the inverse of the points.
    pub raw_area: Mean,
    /// From the corrected areas, likewise.
    pub area: Mean,
}

/// The ensemble at all pressures.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleFindings {
    /// Surfaces.
    pub realisations: usize,
    /// r.m.s. gradient of each surface.
    pub gradient: f64,
    /// r.m.s. height of the surfaces, m.
    pub height: Mean,
    /// Grid by grid, pressure by pressure.
    pub points: Vec<EnsemblePoint>,
    /// Pressure by pressure; empty of a single grid.
    pub extrapolated: Vec<Extrapolated>,
}

/// Raw area, corrected area and mean gap over r.m.s. height.
type Found = [f64; 3];

/// Area and gap of random surfaces. One unit of progress for each pressure of each map.
///
/// # Errors
/// See [`Unsolved`].
pub fn ensemble(
    process: &SelfAffine,
    task: &EnsembleTask,
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<EnsembleFindings, Unsolved> {
    let pair = unit_pair()?;
    let options = Options { boundary: Boundary::Periodic, error: task.error, cap: None };
    let mut heights = Vec::new();
    // By grid, pressure and surface.
    let mut found: Vec<Vec<Vec<Found>>> = vec![vec![Vec::new(); task.pressures.len()]; task.points.len()];
    for realisation in 0..task.realisations {
        for (grid, &points) in task.points.iter().enumerate() {
            let map = process.surface(points, seed(realisation))?;
            let height = rms(map.heights());
            if grid == 0 {
                heights.push(height);
            }
            let solver = Solver::new(&map, &pair, &options)?;
            for (at, &pressure) in task.pressures.iter().enumerate() {
                let contact = solver.at_pressure(pressure, &Silent)?;
                let gap = contact.mean_gap() / height;
                found[grid][at].push([contact.raw_area_ratio(), contact.area_ratio(), gap]);
                progress.advance(1.0);
            }
        }
    }
    let mean =
        |values: &[Found], of: usize| Mean::of(&values.iter().map(|value| value[of]).collect::<Vec<_>>());
    let points = task.points.iter().zip(&found).flat_map(|(&points, of_grid)| {
        task.pressures.iter().zip(of_grid).map(move |(&pressure, values)| EnsemblePoint {
            points,
            pressure,
            raw_area: mean(values, 0),
            area: mean(values, 1),
            gap: mean(values, 2),
        })
    });
    Ok(EnsembleFindings {
        realisations: task.realisations,
        gradient: process.gradient,
        height: Mean::of(&heights),
        points: points.collect(),
        extrapolated: extrapolated(task, &found),
    })
}

fn rms(heights: &[f64]) -> f64 {
    (heights.iter().map(|z| z * z).sum::<f64>() / heights.len() as f64).sqrt()
}

/// Linearly in the pixel, surface by surface.
fn extrapolated(task: &EnsembleTask, found: &[Vec<Vec<Found>>]) -> Vec<Extrapolated> {
    let ([.., coarse, fine], [.., few, many]) = (found, task.points.as_slice()) else { return Vec::new() };
    let share = (*many as f64 / *few as f64 - 1.0).recip();
    let at_zero = |coarse: &[Found], fine: &[Found], of: usize| {
        let pairs = coarse.iter().zip(fine);
        Mean::of(&pairs.map(|(coarse, fine)| fine[of] + share * (fine[of] - coarse[of])).collect::<Vec<_>>())
    };
    let of_pressure = task.pressures.iter().zip(coarse.iter().zip(fine));
    of_pressure
        .map(|(&pressure, (coarse, fine))| Extrapolated {
            pressure,
            raw_area: at_zero(coarse, fine, 0),
            area: at_zero(coarse, fine, 1),
        })
        .collect()
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
        let of = |points: f64| vec![vec![area(0.2, points), area(0.3, points)]];
        let found = extrapolated(&task, &[of(100.0), of(300.0)]);
        assert!(
            (found[0].raw_area.mean - 0.25).abs() < 1e-15 && (found[0].raw_area.error - 0.05).abs() < 1e-15
        );
        assert!((found[0].area.mean - 0.25).abs() < 1e-15);
        let single = EnsembleTask { points: vec![100], ..task };
        assert!(extrapolated(&single, &[of(100.0)]).is_empty());
    }

    #[test]
    fn light_loads_are_those_of_the_analytical_lines() {
        assert!((analytical::persson(1e-6, 1.0) / 1e-6 / persson() - 1.0).abs() < 1e-9);
        assert!(
            (analytical::bush_gibson_thomas(1e-6, 1.0) / 1e-6 / bush_gibson_thomas() - 1.0).abs() < 1e-15
        );
    }
}
