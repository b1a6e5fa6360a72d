//! Weighted sums by Fourier transforms, whose cost does not depend on the nesting index: for long ones.

use std::sync::atomic::{AtomicBool, Ordering};

use asperity_fft::{Complex, FftDirection};

use super::direct::totals;
use crate::memory::zeros;
use crate::numeric::parallel::for_each_row;
use crate::topography::fourier::{change_waves, with_small_factors};
use crate::topography::rows::{Boundary, Rows, count_missing};

/// Writes the Gaussian mean of a map to `means`; `weights` along x and y are those at 0, 1, 2, ... pixels. Missing
/// points are ignored and stay missing.
pub fn means(map: &dyn Rows, weights: &[Vec<f64>; 2], means: &mut [f64]) {
    let [_, ny] = map.points();
    let is_periodic = map.boundary() == Boundary::Periodic;
    // Zero padding of an open map over the range of the weights, against wrap-around.
    let padded = [0, 1].map(|axis| match is_periodic {
        true => map.points()[axis],
        false => with_small_factors(map.points()[axis] + weights[axis].len()),
    });
    let has_missing = AtomicBool::new(false);
    let sums = sums(map, weights, padded, |z| z, &|| has_missing.store(true, Ordering::Relaxed));
    if !has_missing.into_inner() {
        let totals = [0, 1].map(|axis| totals(&weights[axis], map.points()[axis], is_periodic));
        for_each_row(means, ny, &|ix, means| {
            for ((mean, sum), along_y) in means.iter_mut().zip(&sums[ix * padded[1]..]).zip(&totals[1]) {
                *mean = sum / (totals[0][ix] * along_y);
            }
        });
        return;
    }
    // Heights and a mask of present points are smoothed alike; their quotient is the mean.
    let presence = self::sums(map, weights, padded, |_| 1.0, &|| ());
    for_each_row(means, ny, &|ix, means| {
        map.read(ix, means);
        let quotients = sums[ix * padded[1]..].iter().zip(&presence[ix * padded[1]..]);
        for (mean, (sum, weight)) in means.iter_mut().zip(quotients).filter(|(z, _)| !z.is_nan()) {
            *mean = sum / weight;
        }
    });
}

/// Weighted sums of `of(height)` over the neighbourhood of each point. `missing` is called if points are missing.
fn sums(
    map: &dyn Rows,
    weights: &[Vec<f64>; 2],
    padded: [usize; 2],
    of: impl Fn(f64) -> f64 + Sync,
    missing: &(dyn Fn() + Sync),
) -> Vec<f64> {
    let [nx, ny] = map.points();
    let mut field = zeros(padded[0] * padded[1]);
    for_each_row(&mut field[..nx * padded[1]], padded[1], &|ix, row| {
        let row = &mut row[..ny];
        map.read(ix, row);
        if count_missing(row) > 0 {
            missing();
        }
        row.iter_mut().for_each(|value| *value = if value.is_nan() { 0.0 } else { of(*value) });
    });
    let [along_x, along_y] = [0, 1].map(|axis| wrapped(&weights[axis], padded[axis]));
    let scale = ((padded[0] * padded[1]) as f64).recip();
    let change = |j: usize, waves: &mut [Complex<f64>]| {
        waves.iter_mut().zip(&along_x).for_each(|(wave, x)| *wave *= x * along_y[j]);
    };
    change_waves(&mut field, padded, scale, &change, map.progress());
    field
}

/// The transform of symmetric weights on a periodic axis of `count` points.
fn wrapped(weights: &[f64], count: usize) -> Vec<f64> {
    let mut both = vec![Complex::default(); count];
    for (k, &weight) in weights.iter().enumerate() {
        both[k % count].re += weight;
        if k > 0 {
            both[(count - k % count) % count].re += weight;
        }
    }
    asperity_fft::complex(count, FftDirection::Forward).process(&mut both);
    both.into_iter().map(|wave| wave.re).collect()
}
