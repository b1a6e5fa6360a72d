//! An approximate inverse of the displacements: the part of 1/compliance that acts between neighbours. The nearest admissible pressures:
//! between 0 and the cap, with a given sum.

use std::array;
use std::f64::consts::PI;

use rayon::prelude::*;

use super::compliance::SurfaceResponse;
use super::descent::ROWS;

/// Wave numbers along each axis at which the compliance is sampled.
const SAMPLES: usize = 128;

/// The least part of its value in the middle that a stencil leaves of a uniform field: above 0, or it is no inverse of a
/// positive operator.
const LEAST: f64 = 0.02;

/// Weights of a point's neighbours along x, along y and at the corners, relative to its own.
#[derive(Debug, Clone, Copy)]
pub struct Stencil {
    /// The weight in the middle, Pa/m: the pressure of a point over its displacement.
    pub centre: f64,
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// At the corners.
    pub corner: f64,
}

impl Stencil {
    /// The 3 x 3 middle of the inverse of `pair`'s response on a grid of `pixel` (m), with a `film` that adds so much of each load to the
    /// field at its point.
    pub fn new(pixel: [f64; 2], pair: &impl SurfaceResponse, film: f64) -> Self {
        let angle = |k: usize| PI * (k as f64 + 0.5) / SAMPLES as f64;
        let angles: [[f64; 2]; SAMPLES] = array::from_fn(|k| [angle(k), angle(k).cos()]);
        let mut sums = [0.0; 4];
        for [x, cos_x] in angles {
            for [y, cos_y] in angles {
                let inverse = (pair.to_wave((x / pixel[0]).hypot(y / pixel[1])) + film).recip();
                for (sum, factor) in sums.iter_mut().zip([1.0, cos_x, cos_y, cos_x * cos_y]) {
                    *sum += inverse * factor;
                }
            }
        }
        let [x, y, corner] = [sums[1], sums[2], sums[3]].map(|sum| sum / sums[0]);
        let neighbours = -(2.0 * (x + y) + 4.0 * corner);
        let scale = if neighbours > 1.0 - LEAST { (1.0 - LEAST) / neighbours } else { 1.0 };
        let centre = sums[0] / (SAMPLES * SAMPLES) as f64;
        Self { centre, x: scale * x, y: scale * y, corner: scale * corner }
    }

    /// The rows that [`Self::apply_row`] needs of a grid with `ny` points a row, for any number of calls.
    pub fn rows(ny: usize) -> [Vec<f64>; 2] {
        [vec![0.0; ny + 2], vec![0.0; ny + 2]]
    }

    /// The inverse applied to a field on a grid of so many points that wraps or not: `each` sees every point of row `i` that has a
    /// value, with that of the inverse. `field` gives the points of a row that have one, and it; it is zero at all others.
    pub fn apply_row<Field: Iterator<Item = (usize, f64)>>(
        &self,
        rows: &mut [Vec<f64>; 2],
        ([nx, ny], wraps): ([usize; 2], bool),
        i: usize,
        field: impl Fn(usize) -> Field,
        mut each: impl FnMut(usize, f64),
    ) {
        let edge = |beyond: usize, opposite: usize| if wraps { opposite } else { beyond };
        let up = if i == 0 { edge(0, nx - 1) } else { i - 1 };
        let down = if i + 1 == nx { edge(i, 0) } else { i + 1 };
        if field(i).next().is_none() {
            return;
        }
        // The field of the row, and that of both beside it; a point more on each side.
        let [here, over] = rows;
        field(i).for_each(|(j, value)| here[j + 1] = value);
        for beside in [up, down] {
            field(beside).for_each(|(j, value)| over[j + 1] += value);
        }
        for row in [&mut *here, &mut *over] {
            (row[0], row[ny + 1]) = if wraps { (row[ny], row[1]) } else { (row[1], row[ny]) };
        }
        for (j, value) in field(i) {
            let beside = here[j] + here[j + 2];
            let corners = over[j] + over[j + 2];
            each(j, value + self.x * over[j + 1] + self.y * beside + self.corner * corners);
        }
        field(i).for_each(|(j, _)| here[j + 1] = 0.0);
        for beside in [up, down] {
            field(beside).for_each(|(j, _)| over[j + 1] = 0.0);
        }
    }
}

/// Relative error of the sum.
const LOAD_ERROR: f64 = 1e-14;

/// Newton steps and bisections of the search for the offset.
const STEPS: usize = 100;

/// How much longer each step is than the last until the offset is bracketed, where no point is free.
const WIDEN: f64 = 8.0;

/// Replaces pressures, by rows, by the nearest ones between 0 and `cap` that sum to `target`: all are moved by one
/// offset, then clamped. The sum is a piecewise linear, increasing function of the offset, whose root Newton's method
/// finds within a bracket.
pub fn project(rows: &mut [Vec<f64>], target: f64, cap: f64) {
    let sums = |offset: f64| -> (f64, usize) {
        let of_row = |row: &Vec<f64>| {
            row.iter().fold((0.0, 0), |(load, free), p| {
                let p = (p + offset).clamp(0.0, cap);
                (load + p, free + usize::from(p > 0.0 && p < cap))
            })
        };
        let rows: Vec<(f64, usize)> = rows.par_iter().with_min_len(ROWS).map(of_row).collect();
        rows.iter().fold((0.0, 0), |(load, free), row| (load + row.0, free + row.1))
    };
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut offset, mut reach) = (0.0, 0.0);
    for _ in 0..STEPS {
        let (load, free) = sums(offset);
        let missing = target - load;
        if missing.abs() <= LOAD_ERROR * target {
            break;
        }
        if missing > 0.0 {
            low = offset;
        } else {
            high = offset;
        }
        let newton = offset + missing / free as f64;
        let middle = 0.5 * (low + high);
        let next = if free > 0 && newton > low && newton < high {
            newton
        } else if middle.is_finite() {
            middle
        } else {
            // Where no point is free the slope is zero.
            reach = if reach == 0.0 { missing } else { WIDEN * reach };
            offset + reach
        };
        if next == offset || !next.is_finite() {
            break;
        }
        offset = next;
    }
    rows.par_iter_mut().with_min_len(ROWS).for_each(|row| {
        row.iter_mut().for_each(|p| *p = (*p + offset).clamp(0.0, cap));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pressures far apart beside a low cap: between two of them no point is free.
    #[test]
    fn the_load_is_kept_where_hardly_a_point_is_free() {
        for (spread, rounding) in [(1.0, 1e-9), (1e3, 1e-6)] {
            for (target, cap) in [(0.037, 1e-3), (0.0375, 1e-3), (1e-4, 1e-3), (50.0, f64::INFINITY)] {
                let row = |i: i32| (0..10).map(|j| spread * f64::from(10 * i + j - 150)).collect();
                let mut rows: Vec<Vec<f64>> = (0..10).map(row).collect();
                project(&mut rows, target, cap);
                let pressures = rows.concat();
                let load: f64 = pressures.iter().sum();
                assert!((load / target - 1.0).abs() < rounding, "{spread} {target} {cap}: {load}");
                assert!(pressures.is_sorted() && pressures.iter().all(|p| (0.0..=cap).contains(p)));
            }
        }
    }
}
