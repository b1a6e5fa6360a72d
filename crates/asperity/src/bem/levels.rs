//! Coarser grids, on which a solution begins.

use rayon::prelude::*;

use crate::memory::zeros;

/// Every second point along both axes.
pub fn coarser(heights: &[f64], [nx, ny]: [usize; 2]) -> Vec<f64> {
    let [mx, my] = coarser_points([nx, ny]);
    let mut coarse = zeros(mx * my);
    coarse.par_chunks_mut(my).zip(heights.par_chunks(2 * ny)).for_each(|(coarse, rows)| {
        coarse.iter_mut().zip(rows.iter().step_by(2)).for_each(|(to, z)| *to = *z);
    });
    coarse
}

/// Points of the coarser grid.
pub fn coarser_points(points: [usize; 2]) -> [usize; 2] {
    points.map(|count| count.div_ceil(2))
}

/// The pressures of a coarser grid in row `i` of one of `points`, linear between its points.
pub fn finer(pressures: &[f64], points: [usize; 2], wraps: bool, i: usize, row: &mut [f64]) {
    let [nx, ny] = points;
    let [mx, my] = coarser_points(points);
    // Between which two points of the coarser grid a point lies.
    let between = |k: usize, count: usize| {
        let next = if k / 2 + 1 < count {
            k / 2 + 1
        } else if wraps {
            0
        } else {
            k / 2
        };
        [k / 2, if k.is_multiple_of(2) { k / 2 } else { next }]
    };
    debug_assert!(i < nx && row.len() == ny);
    let [above, below] = between(i, mx).map(|i| &pressures[i * my..][..my]);
    for (j, p) in row.iter_mut().enumerate() {
        let [left, right] = between(j, my);
        *p = 0.25 * (above[left] + above[right] + below[left] + below[right]);
    }
}
