//! Displacements of a map from its pressures: a convolution by real transforms, with the caller's work in its passes over
//! the rows.

use std::array;

use rayon::prelude::*;

use super::compliance::SurfaceResponse;
use super::row::Columns;
use super::row::RowTransform;
use super::{Boundary, influence};
use crate::memory::{collected, zeros};
use crate::progress::Progress;
use asperity_fft::{Complex, Number};

/// Rows or columns transposed together: eight complex numbers are two cache lines.
const BLOCK: usize = 8;

/// Numbers of a row of a tile.
const TILE: usize = 2 * BLOCK;

/// Numbers between the columns of a batch beyond their length: columns of a power of two would share the places of the
/// cache.
const PADDING: usize = 8;

/// Displacements from pressures on one grid, to the rounding of double or of single precision.
pub struct Convolution {
    points: [usize; 2],
    double: Transforms<f64>,
    single: Transforms<f32>,
    /// The largest response, over which those in single precision are: m/Pa.
    unit: f64,
}

/// Pressures to displacements in numbers of a type.
///
/// Waves along y are kept in pairs of numbers, in tiles of eight rows and eight columns: both passes read and write pieces of
/// a kilobyte, and columns are transformed in their place. Rows are in the order of the transform along x.
struct Transforms<T: Number> {
    points: [usize; 2],
    rows: RowTransform<T>,
    columns: Columns<T>,
    /// Numbers of a row of waves: whole tiles.
    stride: usize,
}

impl Convolution {
    /// The convolution on a grid of `points` at a distance of `pixel` (m).
    pub fn new(points: [usize; 2], pixel: [f64; 2], pair: &impl SurfaceResponse, boundary: Boundary) -> Self {
        let is_mirrored = boundary == Boundary::Mirrored;
        let factor = if boundary == Boundary::Finite { 2 } else { 1 };
        let lengths = points.map(|count| factor * count);
        let response = match boundary {
            Boundary::Finite => influence::response(points, pixel, pair),
            _ => waves(points, pixel, pair, is_mirrored),
        };
        let largest = response.par_iter().map(|r| r.abs()).reduce(|| 0.0, f64::max);
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let in_units = collected(response.par_iter().map(|r| f32::of(r / unit)));
        Self {
            points,
            single: Transforms::new(points, lengths, is_mirrored, in_units),
            double: Transforms::new(points, lengths, is_mirrored, response),
            unit,
        }
    }

    /// The waves of [`Self::apply`], which are free between two of them: at least as many numbers as points.
    pub fn waves(&self) -> Vec<f64> {
        zeros(self.points[0] * self.double.stride)
    }

    /// The waves of [`Self::apply_in_single`], which are free between two of them: at least as many numbers as points.
    pub fn single_waves(&self) -> Vec<f32> {
        zeros(self.points[0] * self.single.stride)
    }

    /// Displacements (m) to `out` from the pressures (Pa) that `fill` writes to row i, given as zeros. `each` sees every
    /// row of `out` when it is done; its results are in the order of the rows. Bit-identical for any number of threads. To `progress` it
    /// shows that it goes on.
    pub fn apply<A: Send>(
        &self,
        progress: &dyn Progress,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        out: &mut [f64],
        waves: &mut [f64],
        each: impl Fn(usize, &mut [f64]) -> A + Sync,
    ) -> Vec<A> {
        self.double.respond(fill, waves, progress);
        let each = |i: usize, displacements: &[f64], out: &mut [f64]| {
            out.copy_from_slice(displacements);
            each(i, out)
        };
        self.double.displace(1.0, waves, out, each, progress)
    }

    /// The same in single precision and in half the time, within some 1e-7 of the largest displacement: `each` sees the displacements of
    /// every row with that of `out`.
    pub fn apply_in_single<O: Send, A: Send>(
        &self,
        progress: &dyn Progress,
        fill: impl Fn(usize, &mut [f32]) + Sync,
        out: &mut [O],
        waves: &mut [f32],
        each: impl Fn(usize, &[f32], &mut [O]) -> A + Sync,
    ) -> Vec<A> {
        self.single.respond(fill, waves, progress);
        self.single.displace(f32::of(self.unit), waves, out, each, progress)
    }
}

impl<T: Number> Transforms<T> {
    fn new(points: [usize; 2], [length, width]: [usize; 2], is_mirrored: bool, response: Vec<T>) -> Self {
        let rows = RowTransform::new(width, is_mirrored);
        let stride = (2 * rows.pairs()).next_multiple_of(TILE);
        Self { points, rows, columns: Columns::new(points[0], length, width, is_mirrored, response), stride }
    }

    /// The response to the pressures that `fill` writes to row i, as waves along y.
    fn respond(&self, fill: impl Fn(usize, &mut [T]) + Sync, waves: &mut [T], progress: &dyn Progress) {
        let Self { points: [_, ny], stride, .. } = *self;
        waves.par_chunks_mut(BLOCK * stride).enumerate().for_each_init(
            || (vec![T::default(); ny], vec![T::default(); stride], self.rows.scratch()),
            |(row, packed, scratch), (block, tiles)| {
                progress.advance(0.0);
                let count = tiles.len() / stride;
                for k in 0..count {
                    row.fill(T::default());
                    fill(self.columns.point_at(block * BLOCK + k), row);
                    self.rows.forward(row, packed, scratch);
                    // Of a known length, which a copy needs no call for.
                    let lines = tiles.as_chunks_mut::<TILE>().0.iter_mut().skip(k).step_by(count);
                    lines.zip(packed.as_chunks::<TILE>().0).for_each(|(line, waves)| *line = *waves);
                }
            },
        );
        self.multiply(waves, progress);
    }

    /// What `each` finds of `scale` times the displacements of those waves and of every row of `out`.
    fn displace<O: Send, A: Send>(
        &self,
        scale: T,
        waves: &[T],
        out: &mut [O],
        each: impl Fn(usize, &[T], &mut [O]) -> A + Sync,
        progress: &dyn Progress,
    ) -> Vec<A> {
        let Self { points: [nx, ny], stride, .. } = *self;
        let mut answers: Vec<Vec<A>> = Vec::new();
        out.par_chunks_mut(BLOCK * ny)
            .enumerate()
            .map_init(
                || (vec![T::default(); ny], vec![T::default(); stride], self.rows.scratch()),
                |(row, packed, scratch), (block, out)| {
                    progress.advance(0.0);
                    let rows = out.chunks_mut(ny).enumerate();
                    rows.map(|(k, out)| {
                        let i = block * BLOCK + k;
                        let place = self.columns.place(i);
                        let first = place / BLOCK * BLOCK;
                        let count = BLOCK.min(nx - first);
                        let tiles = waves[first * stride..][..count * stride].as_chunks::<TILE>().0;
                        let lines = tiles.iter().skip(place - first).step_by(count);
                        packed
                            .as_chunks_mut::<TILE>()
                            .0
                            .iter_mut()
                            .zip(lines)
                            .for_each(|(waves, line)| *waves = *line);
                        self.rows.backward(packed, scale, row, scratch);
                        each(i, row, out)
                    })
                    .collect()
                },
            )
            .collect_into_vec(&mut answers);
        answers.into_iter().flatten().collect()
    }

    /// Replaces the waves along y of all rows by the response to them.
    fn multiply(&self, waves: &mut [T], progress: &dyn Progress) {
        let Self { points: [nx, _], stride, .. } = *self;
        let length = self.columns.length();
        let pairs = self.rows.pairs();
        // The tiles of each block of columns.
        let mut columns: Vec<Vec<&mut [T]>> = Vec::new();
        columns.resize_with(stride / TILE, || Vec::with_capacity(nx.div_ceil(BLOCK)));
        for tiles in waves.chunks_mut(BLOCK * stride) {
            let side = TILE * (tiles.len() / stride);
            columns.iter_mut().zip(tiles.chunks_mut(side)).for_each(|(column, tile)| column.push(tile));
        }
        columns.par_iter_mut().enumerate().for_each_init(
            || (vec![Complex::default(); BLOCK * (length + PADDING)], self.columns.scratch()),
            |(batch, scratch), (block, tiles)| {
                progress.advance(0.0);
                let first = block * BLOCK;
                let mut columns = batch.chunks_mut(length + PADDING);
                let mut columns: [_; BLOCK] = array::from_fn(|_| columns.next().unwrap_or_default());
                // A piece of one column after the other: stores to all of them in turn would each check their place.
                for (b, tile) in tiles.iter().enumerate() {
                    let lines = tile.as_chunks::<TILE>().0;
                    for (k, column) in columns.iter_mut().enumerate() {
                        let piece = column[b * BLOCK..][..lines.len()].iter_mut();
                        piece
                            .zip(lines)
                            .for_each(|(to, line)| *to = Complex::new(line[2 * k], line[2 * k + 1]));
                    }
                }
                for (k, column) in columns.iter_mut().take(pairs - first).enumerate() {
                    self.columns.respond(first + k, &mut column[..length], scratch);
                }
                for (b, tile) in tiles.iter_mut().enumerate() {
                    let lines = tile.as_chunks_mut::<TILE>().0;
                    for (k, column) in columns.iter().enumerate() {
                        let piece = column[b * BLOCK..][..lines.len()].iter();
                        piece.zip(&mut *lines).for_each(|(wave, line)| {
                            (line[2 * k], line[2 * k + 1]) = (wave.re, wave.im);
                        });
                    }
                }
            },
        );
    }
}

/// The compliance for the waves of a map that repeats, over the numbers of its transform; none for the mean, which is no
/// deformation.
fn waves(points: [usize; 2], pixel: [f64; 2], pair: &impl SurfaceResponse, is_mirrored: bool) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    let (turn, [nx, ny]) = if is_mirrored { (PI, points) } else { (TAU, points.map(|count| count / 2 + 1)) };
    let unit = |axis: usize| turn / (points[axis] as f64 * pixel[axis]);
    let norm = ((points[0] * points[1]) as f64).recip();
    let mut response: Vec<f64> = zeros(nx * ny);
    response.par_chunks_mut(nx).enumerate().for_each(|(j, column)| {
        for (i, r) in column.iter_mut().enumerate() {
            let q = (unit(0) * i as f64).hypot(unit(1) * j as f64);
            *r = if q == 0.0 { 0.0 } else { norm * pair.to_wave(q) };
        }
    });
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bem::ElasticPair;
    use crate::material::Material;
    use crate::progress::Silent;

    #[test]
    fn single_precision_is_double_to_its_rounding() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let pair = ElasticPair::new(&steel, &steel, None);
        for boundary in [Boundary::Periodic, Boundary::Mirrored, Boundary::Finite] {
            for points in [[64, 48], [30, 31]] {
                let [nx, ny] = points;
                let pressure =
                    |k: usize| if (k * 7919) % 11 < 2 { 1e9 * ((k * 31) % 17) as f32 } else { 0.0 };
                let convolution = Convolution::new(points, [1e-6, 2e-6], &pair, boundary);
                let (mut double, mut single) = (vec![0.0; nx * ny], vec![0.0; nx * ny]);
                let rows = convolution.apply(
                    &Silent,
                    |i, row| (0..ny).for_each(|j| row[j] = f64::from(pressure(i * ny + j))),
                    &mut double,
                    &mut convolution.waves(),
                    |i, _| i,
                );
                let same_rows = convolution.apply_in_single(
                    &Silent,
                    |i, row| (0..ny).for_each(|j| row[j] = pressure(i * ny + j)),
                    &mut single,
                    &mut convolution.single_waves(),
                    |i, found, row| {
                        row.iter_mut().zip(found).for_each(|(to, &u)| *to = f64::from(u));
                        i
                    },
                );
                assert!(rows.iter().copied().eq(0..nx) && rows == same_rows);
                let largest = double.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()));
                assert!(largest > 0.0);
                let error = double.iter().zip(&single).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(
                    error < 1e-6 * largest && error > 0.0,
                    "{boundary:?} {points:?}: {}",
                    error / largest
                );
            }
        }
    }
}
