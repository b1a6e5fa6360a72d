//! In-place Fourier transforms of maps.
//!
//! Between the two passes of a transform a row holds its half spectrum along y in as many numbers as it has points: Re
//! 0, then Re k, Im k, and for an even number of points Re of the last at the end. Columns are transposed and
//! transformed along x in batches that fit in the cache.

use asperity_fft::{Complex, Fft, FftDirection};
use rayon::prelude::*;

use crate::memory::zeros;
use crate::numeric::parallel::Results;
use crate::progress::Progress;

/// Numbers in one batch of columns: 4 MiB.
const BATCH: usize = 1 << 18;

/// The part of a transform's time that its columns take.
const COLUMNS: f64 = 0.7;

/// Rows or columns transposed together: eight complex numbers are two cache lines.
const ROWS: usize = 8;

/// Number of wave numbers along y of a map of real heights: 0 to half of its points.
pub const fn columns(points: [usize; 2]) -> usize {
    points[1] / 2 + 1
}

/// The weight of column `j` in a sum over all waves: 2 if it also represents -j.
pub const fn weight(points: [usize; 2], j: usize) -> f64 {
    if j == 0 || 2 * j == points[1] { 1.0 } else { 2.0 }
}

fn batch_width(points: [usize; 2]) -> usize {
    (BATCH / points[0]).clamp(ROWS, columns(points).max(ROWS))
}

/// Synthesises a map from its waves, one unit of work. `fill` is called with each wave number j along y and writes the amplitudes of all
/// wave numbers along x (0, 1, ..., -2, -1). From its return values, in the order of j, `scale` computes the factor of
/// all heights.
///
/// The amplitudes are those of exp(2 pi i (i x/nx + j y/ny)); those of column 0, and of the last one if ny is even,
/// must be those of a real wave. Bit-identical for any number of threads.
pub fn synthesise<T: Send + Sync>(
    points: [usize; 2],
    fill: impl Fn(usize, &mut [Complex<f64>]) -> T + Sync,
    scale: impl FnOnce(Vec<T>) -> f64,
    progress: &dyn Progress,
) -> Vec<f64> {
    let results = Results::new(columns(points));
    let mut map = waves_along_x(points, &|j, column| results.set(j, fill(j, column)), progress);
    heights_along_y(&mut map, points[1], scale(results.into_vec()), progress);
    map
}

/// The first pass: along x, from the amplitudes that `fill` writes.
fn waves_along_x(
    points: [usize; 2],
    fill: &(dyn Fn(usize, &mut [Complex<f64>]) + Sync),
    progress: &dyn Progress,
) -> Vec<f64> {
    let [nx, ny] = points;
    let mut map = zeros(nx * ny);
    let transform = asperity_fft::complex(nx, FftDirection::Inverse);
    for_each_batch(points, &mut |first, batch| {
        transform_columns(batch, &*transform, &|k, column| fill(first + k, column), &|_, _| ());
        progress.advance(COLUMNS * (batch.len() / nx) as f64 / columns(points) as f64);
        if !is_empty(batch) {
            scatter(batch, first, &mut map, points);
        }
    });
    map
}

/// Whether there are no waves, as beyond a cut-off.
fn is_empty(waves: &[Complex<f64>]) -> bool {
    waves.iter().all(|wave| *wave == Complex::default())
}

/// Calls `task` with batches of columns of waves and the wave number along y of the first column of each.
fn for_each_batch(points: [usize; 2], task: &mut dyn FnMut(usize, &mut [Complex<f64>])) {
    let width = batch_width(points);
    let mut batch = vec![Complex::default(); width * points[0]];
    for first in (0..columns(points)).step_by(width) {
        let count = width.min(columns(points) - first);
        task(first, &mut batch[..count * points[0]]);
    }
}

/// Something done with the column `k` of a batch.
type OfColumn<'a> = &'a (dyn Fn(usize, &mut [Complex<f64>]) + Sync);

/// Transforms columns of waves, each between `before` and `after`.
fn transform_columns(
    batch: &mut [Complex<f64>],
    transform: &dyn Fft<f64>,
    before: OfColumn,
    after: OfColumn,
) {
    batch.par_chunks_mut(transform.len()).enumerate().for_each_init(
        || vec![Complex::default(); transform.get_inplace_scratch_len()],
        |scratch, (k, column)| {
            before(k, column);
            if !is_empty(column) {
                transform.process_with_scratch(column, scratch);
            }
            after(k, column);
        },
    );
}

/// Copies columns, the first being `first`, from the rows of a map.
fn gather(map: &[f64], points: [usize; 2], first: usize, batch: &mut [Complex<f64>]) {
    let [nx, ny] = points;
    batch.par_chunks_mut(ROWS * nx).enumerate().for_each(|(block, columns)| {
        for (i, row) in map.chunks(ny).enumerate() {
            for (k, column) in columns.chunks_mut(nx).enumerate() {
                column[i] = get(row, first + block * ROWS + k);
            }
        }
    });
}

/// Copies columns, the first being `first`, to the rows of a map.
fn scatter(batch: &[Complex<f64>], first: usize, map: &mut [f64], points: [usize; 2]) {
    let [nx, ny] = points;
    map.par_chunks_mut(ROWS * ny).enumerate().for_each(|(block, rows)| {
        for (k, column) in batch.chunks(nx).enumerate() {
            let column = &column[block * ROWS..];
            for (row, wave) in rows.chunks_mut(ny).zip(column) {
                put(row, first + k, *wave);
            }
        }
    });
}

/// The second pass: along y, times `scale`.
fn heights_along_y(map: &mut [f64], ny: usize, scale: f64, progress: &dyn Progress) {
    let part = (1.0 - COLUMNS) * ny as f64 / map.len() as f64;
    let along_y = asperity_fft::complex_to_real(ny);
    map.par_chunks_mut(ny).for_each_init(
        || (along_y.make_input_vec(), along_y.make_scratch_vec()),
        |(half, scratch), row| {
            progress.advance(part);
            for (j, wave) in half.iter_mut().enumerate() {
                *wave = scale * get(row, j);
            }
            // Cannot fail: the lengths are those of the plan, and the ends are real.
            let _ = along_y.process_with_scratch(half, row, scratch);
        },
    );
}

/// Analyses a map into waves, one unit of work: `each` is called with each wave number j along y and the sums of z exp(-2 pi i (i x/nx +
/// j y/ny)) for all wave numbers i along x. The results are in the order of j.
pub fn analyse<T: Send + Sync>(
    map: Vec<f64>,
    points: [usize; 2],
    each: impl Fn(usize, &[Complex<f64>]) -> T + Sync,
    progress: &dyn Progress,
) -> Vec<T> {
    let results = Results::new(columns(points));
    for_each_column(map, points, &|j, waves| results.set(j, each(j, waves)), progress);
    results.into_vec()
}

fn for_each_column(
    mut map: Vec<f64>,
    points: [usize; 2],
    each: &(dyn Fn(usize, &[Complex<f64>]) + Sync),
    progress: &dyn Progress,
) {
    waves_along_y(&mut map, points[1], progress);
    let transform = asperity_fft::complex(points[0], FftDirection::Forward);
    for_each_batch(points, &mut |first, batch| {
        gather(&map, points, first, batch);
        let each = |k: usize, column: &mut [Complex<f64>]| each(first + k, column);
        transform_columns(batch, &*transform, &|_, _| (), &each);
        progress.advance(COLUMNS * (batch.len() / points[0]) as f64 / columns(points) as f64);
    });
}

/// Changes the waves of a map: `change` is called as in [`analyse`] and writes other amplitudes, of which the map is
/// synthesised, times `scale`: two units of work. Bit-identical for any number of threads.
pub fn change_waves(
    map: &mut [f64],
    points: [usize; 2],
    scale: f64,
    change: &(dyn Fn(usize, &mut [Complex<f64>]) + Sync),
    progress: &dyn Progress,
) {
    waves_along_y(map, points[1], progress);
    let [forward, back] =
        [FftDirection::Forward, FftDirection::Inverse].map(|way| asperity_fft::complex(points[0], way));
    for_each_batch(points, &mut |first, batch| {
        gather(map, points, first, batch);
        let change = |k: usize, column: &mut [Complex<f64>]| change(first + k, column);
        transform_columns(batch, &*forward, &|_, _| (), &change);
        transform_columns(batch, &*back, &|_, _| (), &|_, _| ());
        progress.advance(2.0 * COLUMNS * (batch.len() / points[0]) as f64 / columns(points) as f64);
        scatter(batch, first, map, points);
    });
    heights_along_y(map, points[1], scale, progress);
}

/// The first pass of an analysis: along y.
fn waves_along_y(map: &mut [f64], ny: usize, progress: &dyn Progress) {
    let part = (1.0 - COLUMNS) * ny as f64 / map.len() as f64;
    let along_y = asperity_fft::real_to_complex(ny);
    map.par_chunks_mut(ny).for_each_init(
        || (along_y.make_output_vec(), along_y.make_scratch_vec()),
        |(half, scratch), row| {
            progress.advance(part);
            // Rows of padding have no waves.
            if row.iter().all(|z| *z == 0.0) {
                return;
            }
            // Cannot fail: the lengths are those of the plan.
            let _ = along_y.process_with_scratch(row, half, scratch);
            for (j, wave) in half.iter().enumerate() {
                put(row, j, *wave);
            }
        },
    );
}

/// The smallest multiple of 8 of at least `count` without a prime factor above 7, of which transforms are fastest.
pub fn with_small_factors(count: usize) -> usize {
    let is_fast = |&length: &usize| {
        let rest = [2, 3, 5, 7].into_iter().fold(length, |mut rest, factor| {
            while rest % factor == 0 {
                rest /= factor;
            }
            rest
        });
        rest == 1
    };
    let first = count.next_multiple_of(8);
    (first..).step_by(8).find(is_fast).unwrap_or(first)
}

/// Wave j of a row.
fn get(row: &[f64], j: usize) -> Complex<f64> {
    match j {
        0 => Complex::new(row[0], 0.0),
        _ if 2 * j == row.len() => Complex::new(row[2 * j - 1], 0.0),
        _ => Complex::new(row[2 * j - 1], row[2 * j]),
    }
}

/// Stores wave j of a row.
fn put(row: &mut [f64], j: usize, wave: Complex<f64>) {
    match j {
        0 => row[0] = wave.re,
        _ if 2 * j == row.len() => row[2 * j - 1] = wave.re,
        _ => {
            row[2 * j - 1] = wave.re;
            row[2 * j] = wave.im;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use rand::{RngExt, SeedableRng};
    use std::f64::consts::TAU;

    fn random(points: [usize; 2]) -> Vec<f64> {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        (0..points[0] * points[1]).map(|_| rng.random_range(-1.0..1.0)).collect()
    }

    #[test]
    fn waves_are_those_of_the_definition_and_lead_back() {
        for points in [[3, 3], [4, 4], [5, 8], [8, 5], [17, 30], [64, 48]] {
            let [nx, ny] = points;
            let map = random(points);
            let waves = analyse(map.clone(), points, |_, column| column.to_vec(), &Silent);
            for (i, j) in [(0, 0), (1, 0), (0, 1), (nx - 1, 1), (nx / 2, ny / 2)] {
                let sum: Complex<f64> = (0..nx * ny)
                    .map(|k| {
                        let turns = (i * (k / ny)) as f64 / nx as f64 + (j * (k % ny)) as f64 / ny as f64;
                        Complex::from_polar(1.0, -TAU * turns) * map[k]
                    })
                    .sum();
                assert!((waves[j][i] - sum).norm() < 1e-11, "{points:?}: {i} {j}");
            }
            let back = synthesise(
                points,
                |j, column| column.copy_from_slice(&waves[j]),
                |_| 1.0 / (nx * ny) as f64,
                &Silent,
            );
            assert!(map.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-14), "{points:?}");
        }
    }
}
