//! Coarser grids, on which a solution begins.

/// Every second point along both axes.
pub fn coarser(heights: &[f64], [nx, ny]: [usize; 2]) -> Vec<f64> {
    let row = |i: usize| heights[i * ny..][..ny].iter().step_by(2).copied();
    (0..nx).step_by(2).flat_map(row).collect()
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
