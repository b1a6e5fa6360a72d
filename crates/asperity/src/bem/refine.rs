//! Other grids: the same waves on a finer one, coarser ones on which a solution begins, and the error that a grid makes.

use rayon::prelude::*;

use super::active::filled;
use super::row::RowTransform;
use super::{Boundary, Contact};
use crate::memory::zeros;
use crate::topography::HeightMap;

/// `map` on a grid `factor` times as fine along both axes: the same Fourier series of a periodic map, the same cosines of
/// another. Missing points are interpolated first. A factor of 0 counts as 1.
pub fn refined(map: &HeightMap, boundary: Boundary, factor: usize) -> HeightMap {
    let [nx, ny] = map.points();
    let is_mirrored = !boundary.wraps();
    let heights = filled(map.heights(), [nx, ny]);
    if factor < 2 {
        return map.regridded(1, heights);
    }
    let along_y = finer_rows(&heights, ny, factor, is_mirrored);
    let along_x = finer_rows(&transposed(&along_y, factor * ny), nx, factor, is_mirrored);
    map.regridded(factor, transposed(&along_x, factor * nx))
}

/// Rows of `count` numbers, each interpolated to `factor` times as many.
fn finer_rows(rows: &[f64], count: usize, factor: usize, is_mirrored: bool) -> Vec<f64> {
    let length = factor * count;
    let [coarse, fine] = [count, length].map(|length| RowTransform::<f64>::new(length, is_mirrored));
    let mut finer = zeros(factor * rows.len());
    finer.par_chunks_mut(length).zip(rows.par_chunks(count)).for_each_init(
        || {
            let packed = [&coarse, &fine].map(|transform| vec![0.0; 2 * transform.pairs()]);
            (packed, coarse.scratch(), fine.scratch())
        },
        |([packed, wide], coarse_scratch, fine_scratch), (finer, row)| {
            coarse.forward(row, packed, coarse_scratch);
            packed.iter_mut().for_each(|wave| *wave /= count as f64);
            wide.fill(0.0);
            wide[0] = packed[0];
            for k in 1..count.div_ceil(2) {
                wide[2 * k] = packed[2 * k];
                let opposite = packed[2 * k + 1];
                if is_mirrored {
                    wide[2 * (count - k)] = -opposite;
                } else {
                    wide[2 * k + 1] = opposite;
                }
            }
            if count.is_multiple_of(2) {
                // The shortest wave of a periodic row stands for both of its directions.
                wide[count] = if is_mirrored { packed[1] } else { 0.5 * packed[1] };
            }
            fine.backward(wide, 1.0, finer, fine_scratch);
        },
    );
    finer
}

/// Columns as rows, of rows of `count` numbers.
fn transposed(rows: &[f64], count: usize) -> Vec<f64> {
    let length = rows.len() / count;
    let mut columns = zeros(rows.len());
    columns.par_chunks_mut(length).enumerate().for_each(|(j, column)| {
        column.iter_mut().enumerate().for_each(|(i, value)| *value = rows[i * count + j]);
    });
    columns
}

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

/// How far a contact is from that of the same waves on a finer grid, estimated from the outline of the contact.
///
/// The border lies somewhere between a point in contact and its neighbour, and only there a grid errs in first order. M sides of pixels
/// along the axis that has more of them, per point in contact, say how narrow the contacts are: 2/M points on average. The
/// errors follow a part that all sides share and one that averages over the P places of the border that are independent.
/// docs/theory.md, section 9, says on which surfaces the factors were measured.
///
/// Largest errors by the grid: each is exceeded by at most a twentieth of the contacts on such surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridError {
    /// Of the logarithm of the corrected area.
    pub area: f64,
    /// Of the logarithm of the load at a mean gap; times load over stiffness it is that of the mean gap at a load.
    pub load: f64,
    /// Of the logarithm of the stiffness.
    pub stiffness: f64,
}

impl GridError {
    /// Of `contact`, without any where it has no border.
    pub fn new(contact: &Contact) -> Self {
        let [x, y] = contact.outline().map(|sides| sides as f64);
        let most = x.max(y);
        if most == 0.0 {
            return Self { area: 0.0, load: 0.0, stiffness: 0.0 };
        }
        let (raw, all) = (contact.raw_area_ratio(), contact.pressures().len() as f64);
        let narrowness = most / (raw * all);
        let elongation = 1.0 - x.min(y) / most;
        // Sides and points in a row along the shorter side of a pixel are not independent.
        let [dx, dy] = contact.pixel;
        let (shorter, longer) = (dx.min(dy), dx.max(dy));
        let of_border = narrowness / ((x * dy + y * dx) / longer).sqrt();
        // Points at the cap stay at it; few others are left that respond, and each of them counts.
        let capped = contact.capped_area_ratio() / raw;
        let free = (raw - contact.capped_area_ratio()) * all * shorter / longer;
        let of_free = if capped > 0.0 { capped / free.max(1.0).sqrt() } else { 0.0 };
        // The correction is that of an elastic half-space, whose pressure falls to zero.
        let unsure = if contact.is_layered { 1.0 } else { capped };
        let correction = raw / contact.area_ratio() - 1.0;
        let part = 0.15 + 0.6 * elongation.powi(4) + 0.5 * unsure;
        Self {
            area: part * correction + of_border + 0.02 * narrowness.powi(4),
            load: 0.018 * narrowness.powi(4) + 0.2 * (narrowness * of_border + of_free),
            stiffness: 0.03 * correction + 0.9 * of_border + 0.005 * narrowness.powi(4) + 1.5 * of_free,
        }
    }
}
