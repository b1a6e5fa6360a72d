//! The nearest admissible pressures: between 0 and the cap, with a given sum.

use rayon::prelude::*;

use super::descent::ROWS;

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
