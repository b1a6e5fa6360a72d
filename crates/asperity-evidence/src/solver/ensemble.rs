//! Contact areas of a published ensemble of self-affine surfaces.
//!
//! Published areas are from `Data/Area_GFMD_Zhou.mat` and `Fig_2_program.m` of the repository that the authors put beside their paper
//! (Xu, Zhu, Xiao, Zhou 2024), github.com/xylcsi/PerssonModelFudgeFactor: calculations by Green's function molecular dynamics. Grid,
//! domain and number of surfaces are not stated there.

use std::f64::consts::TAU;

use asperity::bem::{Boundary, Options, Solver};
use asperity::progress::{Progress, Silent};

use super::known::{Benchmark, BenchmarkQuantity, Case, Problem};
use super::{SelfAffine, unit_pair};
use crate::Failed;

/// p/E*, and the part of the nominal area that is in contact.
pub const PUBLISHED: [[f64; 2]; 8] = [
    [1e-4, 0.000_860_929_4],
    [1e-3, 0.008_272_076],
    [5e-3, 0.039_934_80],
    [0.01, 0.077_926_64],
    [0.025, 0.185_244_2],
    [0.065, 0.432_594_8],
    [0.147, 0.771_872_0],
    [0.3, 0.979_394_2],
];

/// Wave numbers, rad/m: the smallest, which is that of the roll-off, and the largest.
const WAVE_NUMBERS: [f64; 2] = [1e4, 1e6];

/// The ensemble on the smallest square that holds its longest wave.
const ENSEMBLE: SelfAffine = SelfAffine {
    side: TAU / WAVE_NUMBERS[0],
    hurst: 0.8,
    roll_off: TAU / WAVE_NUMBERS[0],
    cut_off: TAU / WAVE_NUMBERS[1],
    gradient: 0.2766,
    elongation: 1.0,
};

/// How far extrapolated areas may be from the published ones, two files of whose authors differ by as much, and by how many standard
/// errors more.
const WITHIN: f64 = 0.05;
const ERRORS: f64 = 2.0;

/// Relative dual gap.
const DUAL_GAP: f64 = 1e-6;

/// Areas of surfaces of the published ensemble on grids of ascending `points` along a side, and extrapolated from the two finest, surface
/// by surface: linearly in the pixel, with which the error of counted areas falls. One unit of progress for each pressure of each map.
pub fn ensemble(
    points: &[usize],
    realisations: usize,
    published: &[[f64; 2]],
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<Vec<Benchmark>, Failed> {
    let pair = unit_pair()?;
    let options = Options { boundary: Boundary::Periodic, error: DUAL_GAP, cap: None };
    // Counted and corrected areas by grid, pressure and surface.
    let mut areas = vec![vec![Vec::<[f64; 2]>::new(); published.len()]; points.len()];
    for realisation in 0..realisations {
        for (areas, &points) in areas.iter_mut().zip(points) {
            let map = ENSEMBLE.surface(points, seed(realisation))?;
            let solver = Solver::new(&map, &pair, &options)?;
            for (areas, [pressure, _]) in areas.iter_mut().zip(published) {
                let contact = solver.at_pressure(*pressure, &Silent)?;
                areas.push([contact.raw_area_ratio(), contact.area_ratio()]);
                progress.advance(1.0);
            }
        }
    }
    let mut benchmarks = Vec::new();
    let mut add = |points, quantity, k: usize, area: f64, error: Option<f64>| {
        let [pressure, published] = published[k];
        let case = Case { problem: Problem::Ensemble, name: format!("p = {pressure} E*"), points };
        let allowed = error.map(|error| WITHIN + ERRORS * error / published);
        benchmarks.push(case.benchmark(quantity, Some([published, area]), area / published - 1.0, allowed));
    };
    for (&points, areas) in points.iter().zip(&areas) {
        for (k, areas) in areas.iter().enumerate() {
            for (which, quantity) in [(0, BenchmarkQuantity::RawArea), (1, BenchmarkQuantity::Area)] {
                let [area, _] = mean_and_error(areas.iter().map(|area| area[which]));
                add(points, quantity, k, area, None);
            }
        }
    }
    let ([.., coarse, fine], [.., few, many]) = (&areas[..], points) else { return Ok(benchmarks) };
    let share = (*many as f64 / *few as f64 - 1.0).recip();
    for (k, (coarse, fine)) in coarse.iter().zip(fine).enumerate() {
        let limit = |(coarse, fine): (&[f64; 2], &[f64; 2])| fine[0] + share * (fine[0] - coarse[0]);
        let [limit, error] = mean_and_error(coarse.iter().zip(fine).map(limit));
        add(*many, BenchmarkQuantity::LimitArea, k, limit, Some(error));
    }
    Ok(benchmarks)
}

/// A mean over surfaces and its standard error.
fn mean_and_error(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let square = values.map(|value| (value - mean).powi(2)).sum::<f64>();
    [mean, (square / (count * (count - 1.0))).sqrt()]
}
