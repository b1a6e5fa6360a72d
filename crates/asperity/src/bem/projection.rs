//! The nearest admissible pressures: between 0 and the cap, with a given sum.

use rayon::prelude::*;

use super::active::{Points, members};

/// Relative error of the sum.
const LOAD_ERROR: f64 = 1e-14;

/// Newton steps and bisections of the search for the offset.
const STEPS: usize = 100;

/// Replaces the pressures of `points` by the nearest ones between 0 and `cap` that sum to `target`: all are moved by one
/// offset, then clamped. The sum is a piecewise linear, increasing function of the offset, whose root Newton's method
/// finds within a bracket.
pub fn project(pressures: &mut [f64], ny: usize, points: &Points, target: f64, cap: f64) {
    let sums = |pressures: &[f64], offset: f64| -> (f64, usize) {
        let rows: Vec<(f64, usize)> = pressures
            .par_chunks(ny)
            .zip(points.rows())
            .map(|(row, words)| {
                let (mut load, mut free) = (0.0, 0);
                for j in members(words) {
                    let p = (row[j] + offset).clamp(0.0, cap);
                    load += p;
                    free += usize::from(p > 0.0 && p < cap);
                }
                (load, free)
            })
            .collect();
        rows.iter().fold((0.0, 0), |(load, free), row| (load + row.0, free + row.1))
    };
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut offset = 0.0;
    for _ in 0..STEPS {
        let (load, free) = sums(pressures, offset);
        let missing = target - load;
        if missing.abs() <= LOAD_ERROR * target {
            break;
        }
        if missing > 0.0 {
            low = offset;
        } else {
            high = offset;
        }
        // Where no point is free the slope is zero: a whole pressure's worth of one point is a step that leaves the range.
        let newton = offset + missing / free.max(1) as f64;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == offset || !next.is_finite() {
            break;
        }
        offset = next;
    }
    pressures.par_chunks_mut(ny).zip(points.rows()).for_each(|(row, words)| {
        members(words).for_each(|j| row[j] = (row[j] + offset).clamp(0.0, cap));
    });
}
