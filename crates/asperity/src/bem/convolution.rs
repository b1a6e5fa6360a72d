//! Displacements of a map from its pressures: a convolution by real transforms, with the caller's work in its passes over
//! the rows.

use rayon::prelude::*;

use super::Boundary;
use super::column::Columns;
use super::compliance::ElasticPair;
use super::influence;
use super::row::RowTransform;
use crate::memory::zeros;
use asperity_fft::Complex64;

/// Rows or columns transposed together: eight complex numbers are two cache lines.
const BLOCK: usize = 8;

/// Displacements from pressures on one grid.
pub struct Convolution {
    points: [usize; 2],
    rows: RowTransform,
    columns: Columns,
    /// Numbers along y of the transform: as many as points, or twice as many where nothing repeats.
    width: usize,
}

/// Buffers of a convolution, which others may use between two of them.
pub struct Buffers {
    /// Waves by columns, two numbers each.
    pub columns: Vec<f64>,
    /// Waves by rows, where they do not fit into the rows of the map.
    rows: Vec<f64>,
}

impl Convolution {
    /// The convolution on a grid of `points` at a distance of `pixel` (m).
    pub fn new(points: [usize; 2], pixel: [f64; 2], pair: &ElasticPair, boundary: Boundary) -> Self {
        let is_mirrored = boundary == Boundary::Mirrored;
        let factor = if boundary == Boundary::Finite { 2 } else { 1 };
        let [length, width] = points.map(|count| factor * count);
        let response = match boundary {
            Boundary::Finite => influence::response(points, pixel, pair),
            _ => waves(points, pixel, pair, is_mirrored),
        };
        Self {
            points,
            rows: RowTransform::new(width, is_mirrored),
            columns: Columns::new(points[0], length, width, is_mirrored, response),
            width,
        }
    }

    /// Its buffers.
    pub fn buffers(&self) -> Buffers {
        let [nx, ny] = self.points;
        let rows = if self.width == ny { Vec::new() } else { zeros(nx * self.width) };
        Buffers { columns: zeros(2 * nx * self.waves()), rows }
    }

    /// Waves along y.
    fn waves(&self) -> usize {
        self.width / 2 + 1
    }

    /// Displacements (m) to `out` from the pressures (Pa) that `fill` writes to row i, given as zeros. `each` sees every
    /// row of `out` when it is done; its results are in the order of the rows. Bit-identical for any number of threads.
    pub fn apply<T: Send>(
        &self,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        out: &mut [f64],
        buffers: &mut Buffers,
        each: impl Fn(usize, &mut [f64]) -> T + Sync,
    ) -> Vec<T> {
        let Self { points: [_, ny], width, .. } = *self;
        let fits = width == ny;
        let rows = if fits { &mut *out } else { &mut buffers.rows };
        rows.par_chunks_mut(width).enumerate().with_min_len(BLOCK).for_each_init(
            || self.rows.scratch(),
            |scratch, (i, row)| {
                row.fill(0.0);
                fill(i, &mut row[..ny]);
                self.rows.forward(row, scratch);
            },
        );
        self.respond(rows, &mut buffers.columns);
        let columns = &buffers.columns;
        let mut answers: Vec<Vec<T>> = Vec::new();
        let line = if fits { 0 } else { width };
        out.par_chunks_mut(BLOCK * ny)
            .enumerate()
            .map_init(
                || (vec![0.0; BLOCK * line], self.rows.scratch()),
                |(wide, scratch), (block, out)| {
                    let first = block * BLOCK;
                    let count = out.len() / ny;
                    let rows = if fits { &mut *out } else { &mut wide[..count * width] };
                    self.gather_rows(columns, first, rows);
                    rows.chunks_mut(width).for_each(|row| self.rows.backward(row, scratch));
                    if !fits {
                        let wide = wide.chunks(width);
                        out.chunks_mut(ny).zip(wide).for_each(|(out, wide)| out.copy_from_slice(&wide[..ny]));
                    }
                    out.chunks_mut(ny).enumerate().map(|(k, row)| each(first + k, row)).collect()
                },
            )
            .collect_into_vec(&mut answers);
        answers.into_iter().flatten().collect()
    }

    /// The response to the waves along y of all rows, by columns.
    fn respond(&self, rows: &[f64], columns: &mut [f64]) {
        let Self { points: [nx, _], width, .. } = *self;
        let length = self.columns.length();
        columns.par_chunks_mut(2 * BLOCK * nx).enumerate().for_each_init(
            || (vec![Complex64::default(); BLOCK * length], self.columns.scratch()),
            |(batch, scratch), (block, columns)| {
                let first = block * BLOCK;
                let count = columns.len() / (2 * nx);
                for (i, row) in rows.chunks(width).enumerate() {
                    let place = self.columns.place(i);
                    for k in 0..count {
                        batch[k * length + place] = wave(row, first + k);
                    }
                }
                for (k, column) in batch.chunks_mut(length).take(count).enumerate() {
                    self.columns.respond(first + k, column, scratch);
                }
                for (to, from) in columns.chunks_mut(2 * nx).zip(batch.chunks(length)) {
                    for (to, from) in to.as_chunks_mut::<2>().0.iter_mut().zip(from) {
                        *to = [from.re, from.im];
                    }
                }
            },
        );
    }

    /// Packs the waves of consecutive rows, the first being `first`.
    fn gather_rows(&self, columns: &[f64], first: usize, rows: &mut [f64]) {
        let Self { points: [nx, _], width, .. } = *self;
        let last = self.waves() - 1;
        for (j, column) in columns.chunks(2 * nx).enumerate() {
            for (k, row) in rows.chunks_mut(width).enumerate() {
                let i = self.columns.place(first + k);
                let [re, im] = [column[2 * i], column[2 * i + 1]];
                if j == 0 {
                    row[0] = re;
                } else if j == last && width % 2 == 0 {
                    row[width - 1] = re;
                } else {
                    row[2 * j - 1] = re;
                    row[2 * j] = im;
                }
            }
        }
    }
}

/// Wave j of packed waves.
fn wave(row: &[f64], j: usize) -> Complex64 {
    match j {
        0 => Complex64::new(row[0], 0.0),
        _ if 2 * j == row.len() => Complex64::new(row[2 * j - 1], 0.0),
        _ => Complex64::new(row[2 * j - 1], row[2 * j]),
    }
}

/// The compliance for the waves of a map that repeats, over the numbers of its transform; none for the mean, which is no
/// deformation.
fn waves(points: [usize; 2], pixel: [f64; 2], pair: &ElasticPair, is_mirrored: bool) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    let (turn, [nx, ny]) = if is_mirrored { (PI, points) } else { (TAU, points.map(|count| count / 2 + 1)) };
    let unit = |axis: usize| turn / (points[axis] as f64 * pixel[axis]);
    let norm = ((points[0] * points[1]) as f64).recip();
    let mut response = zeros(nx * ny);
    response.par_chunks_mut(nx).enumerate().for_each(|(j, column)| {
        for (i, r) in column.iter_mut().enumerate() {
            let q = (unit(0) * i as f64).hypot(unit(1) * j as f64);
            *r = if q == 0.0 { 0.0 } else { norm * pair.compliance(q) };
        }
    });
    response
}
