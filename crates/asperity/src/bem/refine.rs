//! The same waves on a finer grid, by which a solution's error of discretisation is estimated.

use rayon::prelude::*;

use super::Boundary;
use super::missing::filled;
use super::row::RowTransform;
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
