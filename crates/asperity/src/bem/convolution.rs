//! Displacements of a map from its pressures: a convolution by real transforms, with the caller's work in its passes over
//! the rows.

use rayon::prelude::*;

use super::Boundary;
use super::column::Columns;
use super::compliance::SurfaceResponse;
use super::influence;
use super::row::RowTransform;
use crate::memory::zeros;
use crate::progress::Progress;
use asperity_fft::Complex64;

/// Rows or columns transposed together: eight complex numbers are two cache lines.
const BLOCK: usize = 8;

/// Numbers between the columns of a batch beyond their length: columns of a power of two would share the places of the
/// cache.
const PADDING: usize = 8;

/// Displacements from pressures on one grid.
///
/// Waves along y are kept in pairs of numbers, by blocks of eight rows and of eight columns: both passes read and write
/// them in pieces of a kilobyte.
pub struct Convolution {
    points: [usize; 2],
    rows: RowTransform,
    columns: Columns,
    /// Numbers of a row of waves.
    stride: usize,
}

/// Buffers of a convolution, which others may use between two of them.
pub struct Buffers {
    /// Waves by blocks of columns, two numbers each: at least as many as points.
    pub columns: Vec<f64>,
    /// Waves by blocks of rows, where they do not fit into the rows of the map.
    rows: Vec<f64>,
}

impl Convolution {
    /// The convolution on a grid of `points` at a distance of `pixel` (m).
    pub fn new(points: [usize; 2], pixel: [f64; 2], pair: &impl SurfaceResponse, boundary: Boundary) -> Self {
        let is_mirrored = boundary == Boundary::Mirrored;
        let factor = if boundary == Boundary::Finite { 2 } else { 1 };
        let [length, width] = points.map(|count| factor * count);
        let response = match boundary {
            Boundary::Finite => influence::response(points, pixel, pair),
            _ => waves(points, pixel, pair, is_mirrored),
        };
        let rows = RowTransform::new(width, is_mirrored);
        let stride = 2 * rows.pairs();
        Self { points, rows, columns: Columns::new(points[0], length, width, is_mirrored, response), stride }
    }

    /// Its buffers.
    pub fn buffers(&self) -> Buffers {
        let [nx, ny] = self.points;
        let rows = if self.stride == ny { Vec::new() } else { zeros(nx * self.stride) };
        Buffers { columns: zeros(nx * self.stride), rows }
    }

    /// Displacements (m) to `out` from the pressures (Pa) that `fill` writes to row i, given as zeros. `each` sees every
    /// row of `out` when it is done; its results are in the order of the rows. Bit-identical for any number of threads. To `progress` it
    /// shows that it goes on.
    pub fn apply<T: Send>(
        &self,
        progress: &dyn Progress,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        out: &mut [f64],
        buffers: &mut Buffers,
        each: impl Fn(usize, &mut [f64]) -> T + Sync,
    ) -> Vec<T> {
        let Self { points: [_, ny], stride, .. } = *self;
        let rows = if stride == ny { &mut *out } else { &mut buffers.rows };
        rows.par_chunks_mut(BLOCK * stride).enumerate().for_each_init(
            || (vec![0.0; ny], vec![0.0; stride], self.rows.scratch()),
            |(row, packed, scratch), (block, tiles)| {
                progress.advance(0.0);
                let count = tiles.len() / stride;
                for k in 0..count {
                    row.fill(0.0);
                    fill(block * BLOCK + k, row);
                    self.rows.forward(row, packed, scratch);
                    for (tile, waves) in tiles.chunks_mut(2 * BLOCK * count).zip(packed.chunks(2 * BLOCK)) {
                        tile[k * waves.len()..][..waves.len()].copy_from_slice(waves);
                    }
                }
            },
        );
        self.respond(rows, &mut buffers.columns, progress);
        let columns = &buffers.columns;
        let mut answers: Vec<Vec<T>> = Vec::new();
        out.par_chunks_mut(BLOCK * ny)
            .enumerate()
            .map_init(
                || (vec![0.0; BLOCK * stride], self.rows.scratch()),
                |(packed, scratch), (block, out)| {
                    progress.advance(0.0);
                    let first = block * BLOCK;
                    self.gather(columns, first, &mut packed[..out.len() / ny * stride]);
                    let rows = out.chunks_mut(ny).zip(packed.chunks(stride));
                    rows.enumerate()
                        .map(|(k, (row, packed))| {
                            self.rows.backward(packed, row, scratch);
                            each(first + k, row)
                        })
                        .collect()
                },
            )
            .collect_into_vec(&mut answers);
        answers.into_iter().flatten().collect()
    }

    /// The response to the waves along y of all rows, by blocks of columns.
    fn respond(&self, rows: &[f64], columns: &mut [f64], progress: &dyn Progress) {
        let Self { points: [nx, _], stride, .. } = *self;
        let length = self.columns.length();
        columns.par_chunks_mut(2 * BLOCK * nx).enumerate().for_each_init(
            || (vec![Complex64::default(); BLOCK * (length + PADDING)], self.columns.scratch()),
            |(batch, scratch), (block, columns)| {
                progress.advance(0.0);
                let first = block * BLOCK;
                let count = columns.len() / (2 * nx);
                for (b, tiles) in rows.chunks(BLOCK * stride).enumerate() {
                    let tile = &tiles[2 * first * (tiles.len() / stride)..];
                    for (k, waves) in tile.chunks(2 * count).take(tiles.len() / stride).enumerate() {
                        let place = self.columns.place(b * BLOCK + k);
                        let batch = batch[place..].iter_mut().step_by(length + PADDING);
                        for (to, &[re, im]) in batch.zip(waves.as_chunks::<2>().0) {
                            *to = Complex64::new(re, im);
                        }
                    }
                }
                for (k, column) in batch.chunks_mut(length + PADDING).take(count).enumerate() {
                    self.columns.respond(first + k, &mut column[..length], scratch);
                }
                for (i, waves) in columns.chunks_mut(2 * count).enumerate() {
                    let batch = batch[self.columns.place(i)..].iter().step_by(length + PADDING);
                    for (to, from) in waves.as_chunks_mut::<2>().0.iter_mut().zip(batch) {
                        *to = [from.re, from.im];
                    }
                }
            },
        );
    }

    /// The packed waves of consecutive rows, the first being `first`.
    fn gather(&self, columns: &[f64], first: usize, packed: &mut [f64]) {
        let Self { points: [nx, _], stride, .. } = *self;
        for (block, columns) in columns.chunks(2 * BLOCK * nx).enumerate() {
            let count = columns.len() / nx;
            let rows = columns[first * count..].chunks(count);
            for (packed, waves) in packed.chunks_mut(stride).zip(rows) {
                packed[2 * BLOCK * block..][..count].copy_from_slice(waves);
            }
        }
    }
}

/// The compliance for the waves of a map that repeats, over the numbers of its transform; none for the mean, which is no
/// deformation.
fn waves(points: [usize; 2], pixel: [f64; 2], pair: &impl SurfaceResponse, is_mirrored: bool) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    let (turn, [nx, ny]) = if is_mirrored { (PI, points) } else { (TAU, points.map(|count| count / 2 + 1)) };
    let unit = |axis: usize| turn / (points[axis] as f64 * pixel[axis]);
    let norm = ((points[0] * points[1]) as f64).recip();
    let mut response = zeros(nx * ny);
    response.par_chunks_mut(nx).enumerate().for_each(|(j, column)| {
        for (i, r) in column.iter_mut().enumerate() {
            let q = (unit(0) * i as f64).hypot(unit(1) * j as f64);
            *r = if q == 0.0 { 0.0 } else { norm * pair.to_wave(q) };
        }
    });
    response
}
