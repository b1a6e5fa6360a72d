//! Transforms of one row of a map: of a periodic one into waves, of a mirrored one into cosines.
//!
//! A mirrored row of n points repeats after 2 n; its cosine transform (DCT-II) is computed by a real transform of its own
//! length (Makhoul 1980): with v = (x0, x2, x4, ..., x5, x3, x1), V its Fourier transform and w = exp(-i pi/(2 n)),
//! V_k w^k = X_k - i X_(n-k). Half a spectrum of V therefore holds all cosines, as the real part of entry k and minus the
//! imaginary part of entry n - k.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::sync::Arc;

use asperity_fft::{Complex64, ComplexToReal, RealToComplex};

/// The place of point `i` of a mirrored line of `count` points in the line that is transformed.
pub fn permuted(i: usize, count: usize) -> usize {
    if i % 2 == 0 { i / 2 } else { count - 1 - i / 2 }
}

/// w^k of a mirrored line of `count` points, for the first half of its waves.
pub fn twiddles(count: usize) -> Vec<Complex64> {
    let angle = |k: usize| -FRAC_PI_2 * k as f64 / count as f64;
    (0..=count / 2).map(|k| Complex64::from_polar(1.0, angle(k))).collect()
}

/// The transform of a row and its inverse, not normalised. The waves of a row of n numbers are packed in n numbers: Re 0,
/// then Re k, Im k, and for an even n Re of the last at the end.
pub struct RowTransform {
    length: usize,
    /// Of a mirrored row.
    twiddles: Option<Vec<Complex64>>,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

/// Scratch buffers of a thread.
pub struct RowScratch {
    line: Vec<f64>,
    waves: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl RowTransform {
    /// The transform of rows of `length` numbers, periodic or mirrored.
    pub fn new(length: usize, is_mirrored: bool) -> Self {
        Self {
            length,
            twiddles: is_mirrored.then(|| twiddles(length)),
            forward: asperity_fft::real_to_complex(length),
            backward: asperity_fft::complex_to_real(length),
        }
    }

    /// Buffers for any number of transforms, one after the other.
    pub fn scratch(&self) -> RowScratch {
        let need = self.forward.get_scratch_len().max(self.backward.get_scratch_len());
        RowScratch {
            line: vec![0.0; self.length],
            waves: self.forward.make_output_vec(),
            scratch: vec![Complex64::default(); need],
        }
    }

    /// Replaces the numbers of `row` by its packed waves.
    pub fn forward(&self, row: &mut [f64], RowScratch { line, waves, scratch }: &mut RowScratch) {
        match &self.twiddles {
            None => line.copy_from_slice(row),
            Some(_) => row.iter().enumerate().for_each(|(i, &x)| line[permuted(i, row.len())] = x),
        }
        // Cannot fail: the lengths are those of the plan.
        let _ = self.forward.process_with_scratch(line, waves, scratch);
        if let Some(twiddles) = &self.twiddles {
            waves.iter_mut().zip(twiddles).for_each(|(wave, w)| *wave *= w);
        }
        row[0] = waves[0].re;
        let (pairs, last) = row[1..].as_chunks_mut::<2>();
        for (pair, wave) in pairs.iter_mut().zip(&waves[1..]) {
            *pair = [wave.re, wave.im];
        }
        if let [last] = last {
            *last = waves[waves.len() - 1].re;
        }
    }

    /// The numbers whose waves are packed in `row`, times the length.
    pub fn backward(&self, row: &mut [f64], RowScratch { line, waves, scratch }: &mut RowScratch) {
        waves[0] = Complex64::new(row[0], 0.0);
        let (pairs, last) = row[1..].as_chunks::<2>();
        for (wave, &[re, im]) in waves[1..].iter_mut().zip(pairs) {
            *wave = Complex64::new(re, im);
        }
        let end = waves.len() - 1;
        if let [last] = *last {
            waves[end] = Complex64::new(last, 0.0);
        }
        let Some(twiddles) = &self.twiddles else {
            let _ = self.backward.process_with_scratch(waves, row, scratch);
            return;
        };
        waves.iter_mut().zip(twiddles).for_each(|(wave, w)| *wave *= w.conj());
        if let [last] = *last {
            // X_k - i X_(n-k) of k = n/2, times exp(i pi/4).
            waves[end] = Complex64::new(last / FRAC_1_SQRT_2, 0.0);
        }
        let _ = self.backward.process_with_scratch(waves, line, scratch);
        let count = row.len();
        row.iter_mut().enumerate().for_each(|(i, x)| *x = line[permuted(i, count)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cosines_are_those_of_the_definition_and_come_back() {
        for count in [3, 4, 5, 8, 30, 31] {
            let transform = RowTransform::new(count, true);
            let mut scratch = transform.scratch();
            let row: Vec<f64> = (0..count).map(|i| (i as f64 * 1.7).sin() + 0.1 * i as f64).collect();
            let mut waves = row.clone();
            transform.forward(&mut waves, &mut scratch);
            let cosine = |k: usize| -> f64 {
                let angle = |i: usize| PI * k as f64 * (i as f64 + 0.5) / count as f64;
                row.iter().enumerate().map(|(i, x)| x * angle(i).cos()).sum()
            };
            for k in 0..count {
                // Re k at 2 k - 1, Im k at 2 k.
                let found = match k {
                    0 => waves[0],
                    _ if 2 * k == count => waves[count - 1],
                    _ if 2 * k < count => waves[2 * k - 1],
                    _ => -waves[2 * (count - k)],
                };
                let exact = cosine(k);
                assert!((found - exact).abs() < 1e-13 * count as f64, "{count}: {k}: {found} for {exact}");
            }
            transform.backward(&mut waves, &mut scratch);
            for (back, x) in waves.iter().zip(&row) {
                assert!((back / count as f64 - x).abs() < 1e-14 * count as f64);
            }
        }
    }

    #[test]
    fn periodic_rows_come_back() {
        for count in [3, 4, 9, 16] {
            let transform = RowTransform::new(count, false);
            let mut scratch = transform.scratch();
            let row: Vec<f64> = (0..count).map(|i| (i as f64 * 2.3).cos()).collect();
            let mut waves = row.clone();
            transform.forward(&mut waves, &mut scratch);
            assert!((waves[0] - row.iter().sum::<f64>()).abs() < 1e-13);
            transform.backward(&mut waves, &mut scratch);
            assert!(waves.iter().zip(&row).all(|(back, x)| (back / count as f64 - x).abs() < 1e-14));
        }
    }
}
