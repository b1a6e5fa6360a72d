//! Contact area and gap of a published ensemble of self-affine surfaces at several resolutions.
//!
//! Published areas are from `Data/Area_GFMD_Zhou.mat` and `Fig_2_program.m` of the repository that the authors put beside their paper
//! (Xu, Zhu, Xiao, Zhou 2024), github.com/xylcsi/PerssonModelFudgeFactor: calculations by Green's function molecular dynamics. Grid,
//! domain and number of surfaces are not stated there.

use std::f64::consts::TAU;

use asperity::bem::{Boundary, Options, Solver};
use asperity::progress::{Progress, Silent};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{SelfAffine, rms, unit_pair};
use crate::program::Failed;

/// Real contact area of the ensemble at one pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedArea {
    /// p/E*.
    pub pressure: f64,
    pub area: f64,
    /// Its standard deviation over the surfaces.
    pub deviation: f64,
}

const fn row(pressure: f64, area: f64, deviation: f64) -> PublishedArea {
    PublishedArea { pressure, area, deviation }
}

pub const PUBLISHED: [PublishedArea; 17] = [
    row(1e-4, 0.000_860_929_4, 4.3e-5),
    row(1e-3, 0.008_272_076, 1.0e-4),
    row(5e-3, 0.039_934_80, 2.9e-4),
    row(0.01, 0.077_926_64, 4.7e-4),
    row(0.015, 0.114_685_4, 5.5e-4),
    row(0.025, 0.185_244_2, 7.4e-4),
    row(0.04, 0.284_594_8, 7.0e-4),
    row(0.065, 0.432_594_8, 6.0e-4),
    row(0.086, 0.540_295_8, 5.7e-4),
    row(0.113, 0.657_142_2, 4.8e-4),
    row(0.147, 0.771_872_0, 3.2e-4),
    row(0.191, 0.873_915_2, 3.1e-4),
    row(0.24, 0.940_583_2, 2.6e-4),
    row(0.3, 0.979_394_2, 1.7e-4),
    row(0.37, 0.995_132_2, 1.0e-4),
    row(0.43, 0.998_825_4, 5.0e-5),
    row(0.5, 0.999_814_8, 2.0e-5),
];

/// Wave numbers of the ensemble, rad/m: the smallest, which is that of the roll-off, and the largest.
const WAVE_NUMBERS: [f64; 2] = [1e4, 1e6];

/// The ensemble on the smallest square that holds its longest wave.
pub const ENSEMBLE: SelfAffine = SelfAffine {
    side: TAU / WAVE_NUMBERS[0],
    hurst: 0.8,
    roll_off: TAU / WAVE_NUMBERS[0],
    cut_off: TAU / WAVE_NUMBERS[1],
    gradient: 0.2766,
    elongation: 1.0,
};

/// The published area at a pressure, if there is one.
pub fn published(pressure: f64) -> Option<&'static PublishedArea> {
    PUBLISHED.iter().find(|row| (row.pressure / pressure - 1.0).abs() < 1e-9)
}

#[derive(Debug, Clone, Copy)]
pub struct Ensemble {
    /// Points along a side, ascending.
    pub points: &'static [usize],
    pub realisations: usize,
    /// p/E*.
    pub pressures: &'static [f64],
    /// Relative dual gap.
    pub error: f64,
}

/// A mean over surfaces with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    pub mean: f64,
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

    /// Raw over published area, minus 1.
    pub fn difference(&self) -> Option<Mean> {
        let published = published(self.pressure)?.area;
        let Mean { mean, error } = self.raw_area;
        Some(Mean { mean: mean / published - 1.0, error: error / published })
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleResults {
    /// Grid by grid, pressure by pressure.
    pub points: Vec<EnsemblePoint>,
    /// Pressure by pressure: linearly in the pixel, with which the error of raw areas falls; empty of a single grid.
    pub extrapolated: Vec<EnsemblePoint>,
}

impl EnsembleResults {
    pub fn grids(&self) -> impl DoubleEndedIterator<Item = &[EnsemblePoint]> {
        self.points.chunk_by(|a, b| a.points == b.points)
    }
}

/// Raw area, corrected area and mean gap over r.m.s. height of one surface.
type Sample = [f64; 3];

/// Area and gap of surfaces of the published ensemble. One unit of progress for each pressure of each map.
pub fn ensemble(
    of: &Ensemble,
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<EnsembleResults, Failed> {
    let pair = unit_pair()?;
    let options = Options { boundary: Boundary::Periodic, error: of.error, cap: None };
    // By grid, pressure and surface.
    let mut samples: Vec<Vec<Vec<Sample>>> = vec![vec![Vec::new(); of.pressures.len()]; of.points.len()];
    for realisation in 0..of.realisations {
        for (grid, &points) in of.points.iter().enumerate() {
            let map = ENSEMBLE.surface(points, seed(realisation))?;
            let height = rms(map.heights());
            let solver = Solver::new(&map, &pair, &options)?;
            for (samples, &pressure) in samples[grid].iter_mut().zip(of.pressures) {
                let contact = solver.at_pressure(pressure, &Silent)?;
                samples.push([contact.raw_area_ratio(), contact.area_ratio(), contact.mean_gap() / height]);
                progress.advance(1.0);
            }
        }
    }
    let points = of.points.iter().zip(&samples).flat_map(|(&points, on_grid)| {
        let samples = of.pressures.iter().zip(on_grid);
        samples.map(move |(&pressure, samples)| EnsemblePoint::new(Some(points), pressure, samples))
    });
    Ok(EnsembleResults { points: points.collect(), extrapolated: extrapolated(of, &samples) })
}

/// Linearly in the pixel, surface by surface.
fn extrapolated(of: &Ensemble, samples: &[Vec<Vec<Sample>>]) -> Vec<EnsemblePoint> {
    let ([.., coarse, fine], [.., few, many]) = (samples, of.points) else { return Vec::new() };
    let share = (*many as f64 / *few as f64 - 1.0).recip();
    let limit = |(coarse, fine): (&Sample, &Sample)| -> Sample {
        std::array::from_fn(|k| fine[k] + share * (fine[k] - coarse[k]))
    };
    let point = |(&pressure, (coarse, fine)): (&f64, (&Vec<Sample>, &Vec<Sample>))| {
        let limits: Vec<Sample> = coarse.iter().zip(fine).map(limit).collect();
        EnsemblePoint::new(None, pressure, &limits)
    };
    of.pressures.iter().zip(coarse.iter().zip(fine)).map(point).collect()
}

fn points_per_wave(points: Option<usize>) -> Option<f64> {
    points.map(|points| points as f64 * ENSEMBLE.cut_off / ENSEMBLE.side)
}

impl Row for &EnsemblePoint {
    const FILE: &'static str = "ensemble.csv";
    const ROWS: &'static str = "One row for each grid and pressure of the published ensemble, and for each pressure where areas are extrapolated.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            grid_points["count", label("points")] = row.points, "Points along a side of the map; empty where the areas are extrapolated linearly in the pixel from the two finest grids.";
            points_per_shortest_wave["1"] = points_per_wave(row.points), "Points per shortest wave of the surface.";
            pressure_over_modulus["1", label("p/E*"), input] = row.pressure, "Mean pressure over E*.";
            raw_area_mean["1", label("raw area")] = row.raw_area.mean, "Points in contact over all points, mean over the surfaces.";
            raw_area_standard_error["1", label("± s.e."), scale(1e-3)] = row.raw_area.error, "Its standard error.";
            area_mean["1", label("corrected area")] = row.area.mean, "Area ratio corrected for the border of the contact, mean over the surfaces.";
            area_standard_error["1", label("± s.e."), scale(1e-3)] = row.area.error, "Its standard error.";
            gap_over_rms_height["1", label("gap/r.m.s. height")] = row.gap.map(|gap| gap.mean), "Mean gap over the r.m.s. height of the surface, mean over the surfaces.";
            gap_standard_error["1", label("± s.e."), scale(1e-3)] = row.gap.map(|gap| gap.error), "Its standard error.";
            published_area["1"] = published(row.pressure).map(|published| published.area), "Published area ratio (Xu, Zhu, Xiao and Zhou 2024); empty at other pressures.";
            published_deviation["1"] = published(row.pressure).map(|published| published.deviation), "Published standard deviation over the surfaces.";
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extrapolation_removes_an_error_that_falls_with_the_pixel() {
        let two = Ensemble { points: &[100, 300], realisations: 2, pressures: &[1.0], error: 1e-6 };
        let area = |limit: f64, points: f64| [limit * (1.0 + 20.0 / points), limit - 1.0 / points, 0.0];
        let samples = |points: f64| vec![vec![area(0.2, points), area(0.3, points)]];
        let [point] = &extrapolated(&two, &[samples(100.0), samples(300.0)])[..] else { panic!() };
        assert!((point.raw_area.mean - 0.25).abs() < 1e-15 && (point.raw_area.error - 0.05).abs() < 1e-15);
        assert!((point.area.mean - 0.25).abs() < 1e-15);
        let single = Ensemble { points: &[100], ..two };
        assert!(extrapolated(&single, &[samples(100.0)]).is_empty());
    }
}
