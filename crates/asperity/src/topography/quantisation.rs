//! Detection of height steps of the instrument. On a quantised map levelling turns steps into summits, whose radii are
//! artefacts.

use rayon::prelude::*;

use super::rows::{Rows, strips};
use super::summits::Summits;

/// Quantisation of the heights of a map and of the curvatures of its summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantisation {
    /// Step between neighbouring height levels, m; `None` if the heights are not quantised.
    pub step: Option<f64>,
    /// Number of distinct heights in the sample.
    pub levels: usize,
    /// Number of distinct summit curvatures, different by more than the rounding of the stored heights.
    pub distinct_curvatures: usize,
    /// Number of summits.
    pub summits: usize,
    /// Median drop from a summit to its lower neighbours, m.
    pub median_drop: f64,
}

impl Quantisation {
    /// Analyses the raw heights of `map` and the summits found on it after levelling and, if it `is_filtered`, filtering.
    pub fn new(map: &dyn Rows, summits: &Summits, is_filtered: bool) -> Self {
        let mut heights = sample(map);
        heights.par_sort_unstable_by(f64::total_cmp);
        let points = heights.len();
        let largest = heights.iter().fold(0.0f64, |a, z| a.max(z.abs()));
        // Rounding error of a stored height, with a margin for an offset subtracted before.
        let rounding = 4.0 * map.precision() * largest;
        let step = lattice(&distinct(&heights, rounding), points);

        let mut curvatures = summits.curvatures.clone();
        curvatures.par_sort_unstable_by(f64::total_cmp);
        let [dx, dy] = map.pixel();
        let noise = match step {
            // On a lattice curvatures are multiples of half a step over a squared pixel; a filter leaves no lattice.
            Some(step) if !is_filtered => 0.01 * step / (dx * dx).max(dy * dy),
            _ => 2.0 * rounding * (1.0 / (dx * dx) + 1.0 / (dy * dy)),
        };
        let mut drops = summits.drops.clone();
        drops.par_sort_unstable_by(f64::total_cmp);
        Self {
            step,
            levels: distinct(&heights, 0.0).len(),
            distinct_curvatures: distinct(&curvatures, noise).len(),
            summits: summits.curvatures.len(),
            median_drop: drops.get(drops.len() / 2).copied().unwrap_or_default(),
        }
    }
}

/// The present heights of all rows or, on a very large map, of evenly spaced rows.
fn sample(map: &dyn Rows) -> Vec<f64> {
    /// The approximate largest number of heights sampled.
    const ENOUGH: usize = 1 << 24;
    let [nx, ny] = map.points();
    let stride = (nx * ny).div_ceil(ENOUGH);
    let present = |row: &[f64]| row.iter().copied().filter(|z| !z.is_nan()).collect::<Vec<f64>>();
    let parts = strips(map, 0, |strip| {
        let sampled = (0..strip.count).filter(|k| (strip.first + k).is_multiple_of(stride));
        sampled.filter_map(|k| strip.row(k as isize).map(present)).flatten().collect::<Vec<f64>>()
    });
    parts.concat()
}

/// The first value of each cluster of sorted values. A cluster ends `tolerance` above its first value, so that clusters
/// do not chain.
fn distinct(sorted: &[f64], tolerance: f64) -> Vec<f64> {
    let mut firsts: Vec<f64> = Vec::new();
    for &value in sorted {
        if firsts.last().is_none_or(|&first| value > first + tolerance) {
            firsts.push(value);
        }
    }
    firsts
}

/// The step of the lattice of all levels; `None` if they form none.
fn lattice(levels: &[f64], points: usize) -> Option<f64> {
    /// RMS deviation of gaps from integer steps: 0 on a lattice, 0.289 for continuous heights.
    const ON_LATTICE: f64 = 0.1;
    /// With fewer gaps agreement may be by chance, unless each level has many points.
    const MANY_GAPS: usize = 20;
    const POINTS_PER_LEVEL: usize = 4;
    let gaps: Vec<f64> = levels.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if gaps.is_empty() || (gaps.len() < MANY_GAPS && points < POINTS_PER_LEVEL * levels.len()) {
        return None;
    }
    let mut step = gaps.iter().copied().fold(f64::INFINITY, f64::min);
    // The smallest gap is a noisy first guess; the whole range over the number of steps is not.
    for _ in 0..3 {
        let steps: f64 = gaps.iter().map(|gap| (gap / step).round()).sum();
        step = gaps.iter().sum::<f64>() / steps;
    }
    let residual = |gap: &f64| (gap / step - (gap / step).round()).powi(2);
    let spread = (gaps.iter().map(residual).sum::<f64>() / gaps.len() as f64).sqrt();
    (spread <= ON_LATTICE).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::HeightMap;
    use crate::topography::summits::five_point;
    use rand::{RngExt, SeedableRng};

    fn analyse(points: [usize; 2], step: Option<f64>, precision: f64) -> Quantisation {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let heights = (0..points[0] * points[1])
            .map(|_| {
                let z: f64 = rng.random_range(-1.0..1.0) + rng.random_range(-1.0..1.0);
                let z = step.map_or(z, |step| (z / step).round() * step) * 1e-7;
                if precision > 1e-10 { f64::from(z as f32) } else { z }
            })
            .collect();
        let map = HeightMap::new(points, [1e-6; 2], heights, precision).unwrap();
        Quantisation::new(&map, &five_point(&map), false)
    }

    #[test]
    fn continuous_maps_raise_no_alarm() {
        for points in [[5, 5], [8, 9], [30, 30], [300, 200]] {
            let found = analyse(points, None, f64::EPSILON);
            assert_eq!(found.step, None, "{points:?}");
        }
    }

    #[test]
    fn coarse_steps_are_found_in_either_precision() {
        for precision in [f64::EPSILON, f64::from(f32::EPSILON)] {
            for step in [0.8, 0.13] {
                let found = analyse([200, 150], Some(step), precision);
                assert!((found.step.unwrap() / (step * 1e-7) - 1.0).abs() < 1e-4, "{found:?}");
                assert_eq!(found.distinct_curvatures < 100, step == 0.8);
            }
        }
    }

    #[test]
    fn fine_steps_do_no_harm() {
        let found = analyse([200, 150], Some(1e-3), f64::EPSILON);
        assert!((found.step.unwrap() / 1e-10 - 1.0).abs() < 1e-6);
        assert!(found.distinct_curvatures > 1000, "{found:?}");
    }
}
