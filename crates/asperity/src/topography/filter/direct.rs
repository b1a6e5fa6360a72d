//! Weighted sums by direct summation over the neighbourhood, along x and then along y, strip by strip: for short
//! nesting indices.

use pulp::{Arch, Simd, WithSimd};

use crate::topography::rows::{Boundary, IsWhole, Rows, fill_strips};

/// Neighbouring sums computed together: they stay in registers.
const TILE: usize = 32;

/// Rows of a strip, at least. Longer weights have longer strips, so that rows of halos are a bounded part of the work.
const ROWS: usize = 32;

/// Writes the Gaussian mean of a map to `means`; `weights` along x and y are those at 0, 1, 2, ... pixels. Missing
/// points are ignored and stay missing.
pub fn means(map: &dyn Rows, weights: &[Vec<f64>; 2], means: &mut [f64]) {
    let [nx, ny] = map.points();
    let is_periodic = map.boundary() == Boundary::Periodic;
    let totals = [0, 1].map(|axis| totals(&weights[axis], map.points()[axis], is_periodic));
    let halo = weights[0].len() - 1;
    let arch = Arch::new();
    fill_strips(map, halo, ROWS.max(halo).min(nx), means, &|strip, means| {
        let rows: Vec<Option<&[f64]>> =
            (-(halo as isize)..(strip.count + halo) as isize).map(|k| strip.row(k)).collect();
        let is_whole = rows.iter().flatten().all(|row| arch.dispatch(IsWhole(row)));
        let mut along_y = AlongY::new(&weights[1], ny, is_periodic);
        let mut sums = vec![0.0; means.len()];
        along_x(arch, &rows, &weights[0], &mut sums, |z| z);
        for (row, means) in sums.chunks(ny).zip(means.chunks_mut(ny)) {
            along_y.sum(arch, row, means);
        }
        if is_whole {
            for (k, means) in means.chunks_mut(ny).enumerate() {
                let total = totals[0][strip.first + k];
                means.iter_mut().zip(&totals[1]).for_each(|(mean, along_y)| *mean /= total * along_y);
            }
        } else {
            along_x(arch, &rows, &weights[0], &mut sums, |_| 1.0);
            let mut presence = vec![0.0; ny];
            for (k, (row, means)) in sums.chunks(ny).zip(means.chunks_mut(ny)).enumerate() {
                along_y.sum(arch, row, &mut presence);
                let heights = strip.row(k as isize).unwrap_or_default();
                for ((mean, weight), z) in means.iter_mut().zip(&presence).zip(heights) {
                    *mean = if z.is_nan() { *z } else { *mean / weight };
                }
            }
        }
    });
}

/// Sums of the weights within reach of each point of an axis.
pub fn totals(weights: &[f64], count: usize, is_periodic: bool) -> Vec<f64> {
    let both = |k: usize| if k == 0 { weights[0] } else { 2.0 * weights[k] };
    if is_periodic {
        return vec![(0..weights.len()).map(both).sum(); count];
    }
    let side = |length: usize| weights[1..].iter().take(length).sum::<f64>();
    (0..count).map(|place| weights[0] + side(place) + side(count - 1 - place)).collect()
}

/// Weighted sums of `of(height)` along x, for the rows within the halo of `rows`.
fn along_x(
    arch: Arch,
    rows: &[Option<&[f64]>],
    weights: &[f64],
    sums: &mut [f64],
    of: impl Fn(f64) -> f64 + Copy,
) {
    let count = rows.len() - 2 * (weights.len() - 1);
    let ny = sums.len() / count;
    // A tile of columns in one piece: rows of a large map are far apart, often by a power of two.
    let mut tile = vec![0.0; rows.len() * TILE];
    for first in (0..ny).step_by(TILE) {
        let width = TILE.min(ny - first);
        for (copy, row) in tile.chunks_mut(TILE).zip(rows) {
            let Some(row) = row else { continue };
            for (copy, &z) in copy.iter_mut().zip(&row[first..first + width]) {
                *copy = if z.is_nan() { 0.0 } else { of(z) };
            }
        }
        arch.dispatch(Sums {
            values: &tile,
            stride: TILE,
            step: TILE,
            weights,
            count,
            take: |k, found: &[f64; TILE]| {
                sums[k * ny + first..][..width].copy_from_slice(&found[..width]);
            },
        });
    }
}

/// Weighted sums along y of rows of `ny` points.
struct AlongY<'a> {
    weights: &'a [f64],
    ny: usize,
    is_periodic: bool,
    /// A row with as many values before and after it as the weights reach, and up to a multiple of a tile.
    row: Vec<f64>,
}

impl<'a> AlongY<'a> {
    fn new(weights: &'a [f64], ny: usize, is_periodic: bool) -> Self {
        let row = vec![0.0; ny.next_multiple_of(TILE) + 2 * (weights.len() - 1)];
        Self { weights, ny, is_periodic, row }
    }

    fn sum(&mut self, arch: Arch, values: &[f64], sums: &mut [f64]) {
        let (ny, halo) = (self.ny, self.weights.len() - 1);
        self.row[halo..halo + ny].copy_from_slice(values);
        if self.is_periodic {
            for k in 0..halo {
                self.row[halo + ny + k] = values[k % ny];
                self.row[halo - 1 - k] = values[ny - 1 - k % ny];
            }
        }
        let count = ny.div_ceil(TILE);
        arch.dispatch(Sums {
            values: &self.row,
            stride: 1,
            step: TILE,
            weights: self.weights,
            count,
            take: |k, found: &[f64; TILE]| {
                let place = k * TILE;
                let width = TILE.min(ny - place);
                sums[place..place + width].copy_from_slice(&found[..width]);
            },
        });
    }
}

/// Sums over neighbours at a distance of `stride` values, for `count` tiles at a distance of `step` values; `take`
/// receives each. Written to be vectorised by the compiler.
struct Sums<'a, F> {
    values: &'a [f64],
    stride: usize,
    step: usize,
    weights: &'a [f64],
    count: usize,
    take: F,
}

impl<F: FnMut(usize, &[f64; TILE])> WithSimd for Sums<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { values, stride, step, weights, count, mut take } = self;
        let tile = |place: usize| values[place..].first_chunk::<TILE>().unwrap_or(&[0.0; TILE]);
        for index in 0..count {
            let centre = index * step + (weights.len() - 1) * stride;
            let mut sums = *tile(centre);
            for (k, weight) in weights.iter().enumerate().skip(1) {
                let (before, after) = (tile(centre - k * stride), tile(centre + k * stride));
                for i in 0..TILE {
                    sums[i] += weight * (before[i] + after[i]);
                }
            }
            take(index, &sums);
        }
    }
}
