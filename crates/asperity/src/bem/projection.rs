//! The nearest admissible pressures: between 0 and the cap, with a given sum.

use rayon::prelude::*;

use super::active::{Points, members};
use super::descent::ROWS;
use crate::memory::zeros;
use crate::numeric::sum::CHUNK;

/// Relative error of the sum.
const LOAD_ERROR: f64 = 1e-14;

/// Newton steps and bisections of the search for the offset.
const STEPS: usize = 100;

/// How much longer each step is than the last until the offset is bracketed, where no point is free.
const WIDEN: f64 = 8.0;

/// Replaces the pressures of `points` by the nearest ones between 0 and `cap` that sum to `target`: all are moved by one
/// offset, then clamped. The sum is a piecewise linear, increasing function of the offset, whose root Newton's method
/// finds within a bracket.
pub fn project(pressures: &mut [f64], ny: usize, points: &Points, target: f64, cap: f64) {
    let active = listed(pressures, ny, points);
    let sums = |offset: f64| -> (f64, usize) {
        let pieces: Vec<(f64, usize)> = active
            .par_chunks(CHUNK)
            .map(|pressures| {
                pressures.iter().fold((0.0, 0), |(load, free), p| {
                    let p = (p + offset).clamp(0.0, cap);
                    (load + p, free + usize::from(p > 0.0 && p < cap))
                })
            })
            .collect();
        pieces.iter().fold((0.0, 0), |(load, free), piece| (load + piece.0, free + piece.1))
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
    pressures.par_chunks_mut(ny).zip(points.rows()).for_each(|(row, words)| {
        members(words).for_each(|j| row[j] = (row[j] + offset).clamp(0.0, cap));
    });
}

/// The pressures of `points` without those between: a search goes over them several times.
fn listed(pressures: &[f64], ny: usize, points: &Points) -> Vec<f64> {
    let rows = || pressures.chunks(ny).enumerate().map(|(i, row)| (row, points.row(i)));
    let counts = rows().map(|(_, words)| words.iter().map(|word| word.count_ones() as usize).sum());
    let counts: Vec<usize> = counts.collect();
    let mut list = zeros(counts.iter().sum());
    let mut rest = &mut list[..];
    let mut places = Vec::with_capacity(counts.len());
    for (row, count) in rows().zip(counts) {
        let (place, after) = rest.split_at_mut(count);
        places.push((place, row));
        rest = after;
    }
    places.into_par_iter().with_min_len(ROWS).for_each(|(place, (row, words))| {
        place.iter_mut().zip(members(words)).for_each(|(to, j)| *to = row[j]);
    });
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pressures far apart beside a low cap: between two of them no point is free.
    #[test]
    fn the_load_is_kept_where_hardly_a_point_is_free() {
        for (spread, rounding) in [(1.0, 1e-9), (1e3, 1e-6)] {
            for (target, cap) in [(0.037, 1e-3), (0.0375, 1e-3), (1e-4, 1e-3), (50.0, f64::INFINITY)] {
                let mut pressures: Vec<f64> = (0..100).map(|k| spread * f64::from(k - 150)).collect();
                project(&mut pressures, 10, &Points::selected([10, 10], |_| true), target, cap);
                let load: f64 = pressures.iter().sum();
                assert!((load / target - 1.0).abs() < rounding, "{spread} {target} {cap}: {load}");
                assert!(pressures.is_sorted() && pressures.iter().all(|p| (0.0..=cap).contains(p)));
            }
        }
    }
}
