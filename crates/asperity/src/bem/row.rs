//! Transforms of one row of a map: of a periodic one into waves, of a mirrored one into cosines; responses of columns of waves.
//!
//! A mirrored row of n points repeats after 2 n; its cosine transform (DCT-II) is computed by a real transform of its own
//! length (Makhoul 1980): with v = (x0, x2, x4, ..., x5, x3, x1), V its Fourier transform and w = exp(-i pi/(2 n)),
//! V_k w^k = X_k - i X_(n-k). Half a spectrum of V therefore holds all cosines, as the real part of entry k and minus the
//! imaginary part of entry n - k.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::sync::Arc;

use asperity_fft::{Complex, Complex64, ComplexToReal, Fft, FftDirection, Number, RealToComplex};

/// The place of point `i` of a mirrored line of `count` points in the line that is transformed.
pub fn permuted(i: usize, count: usize) -> usize {
    if i.is_multiple_of(2) { i / 2 } else { count - 1 - i / 2 }
}

/// The point at a place of that line: the inverse of [`permuted`].
pub fn point_at(place: usize, count: usize) -> usize {
    if 2 * place < count { 2 * place } else { 2 * (count - place) - 1 }
}

/// w^k of a mirrored line of `count` points, for the first half of its waves.
pub fn twiddles<T: Number>(count: usize) -> Vec<Complex<T>> {
    let angle = |k: usize| -FRAC_PI_2 * k as f64 / count as f64;
    let nearest = |w: Complex64| Complex::new(T::of(w.re), T::of(w.im));
    (0..=count / 2).map(|k| nearest(Complex64::from_polar(1.0, angle(k)))).collect()
}

/// The transform of a row and its inverse in numbers of a type, not normalised. The waves of a row are packed in pairs: Re 0
/// and, for an even number of points, Re of the last; then Re k, Im k.
pub struct RowTransform<T: Number = f64> {
    length: usize,
    /// Of a mirrored row.
    twiddles: Option<Vec<Complex<T>>>,
    forward: Arc<dyn RealToComplex<T>>,
    backward: Arc<dyn ComplexToReal<T>>,
}

/// Scratch buffers of a thread.
pub struct RowScratch<T> {
    line: Vec<T>,
    waves: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

impl<T: Number> RowTransform<T> {
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
    pub fn scratch(&self) -> RowScratch<T> {
        let need = self.forward.get_scratch_len().max(self.backward.get_scratch_len());
        RowScratch {
            line: vec![T::default(); self.length],
            waves: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); need],
        }
    }

    /// Pairs of numbers in which the waves are packed.
    pub fn pairs(&self) -> usize {
        self.length.div_ceil(2)
    }

    /// The packed waves of `row`; what is missing at its end is zero.
    pub fn forward(&self, row: &[T], packed: &mut [T], scratch: &mut RowScratch<T>) {
        let RowScratch { line, waves, scratch } = scratch;
        if row.iter().all(|x| x.is_zero()) {
            packed.fill(T::default());
            return;
        }
        match &self.twiddles {
            None => {
                let (start, rest) = line.split_at_mut(row.len());
                start.copy_from_slice(row);
                rest.fill(T::default());
            }
            Some(_) => row.iter().enumerate().for_each(|(i, &x)| line[permuted(i, row.len())] = x),
        }
        // Cannot fail: the lengths are those of the plan.
        let _ = self.forward.process_with_scratch(line, waves, scratch);
        if let Some(twiddles) = &self.twiddles {
            waves.iter_mut().zip(twiddles).for_each(|(wave, w)| *wave = *wave * w);
        }
        for (pair, wave) in packed.as_chunks_mut::<2>().0.iter_mut().zip(&*waves) {
            *pair = [wave.re, wave.im];
        }
        packed[1] = if self.length.is_multiple_of(2) { waves[self.length / 2].re } else { T::default() };
    }

    /// `scale` times the numbers of `row`, times the length, from its packed waves.
    pub fn backward(&self, packed: &[T], scale: T, row: &mut [T], scratch: &mut RowScratch<T>) {
        let RowScratch { line, waves, scratch } = scratch;
        for (wave, &[re, im]) in waves.iter_mut().zip(packed.as_chunks::<2>().0) {
            *wave = Complex::new(re, im);
        }
        waves[0].im = T::default();
        if self.length.is_multiple_of(2) {
            waves[self.length / 2] = Complex::new(packed[1], T::default());
        }
        if let Some(twiddles) = &self.twiddles {
            waves.iter_mut().zip(twiddles).for_each(|(wave, w)| *wave = *wave * w.conj());
            if self.length.is_multiple_of(2) {
                // X_k - i X_(n-k) of k = n/2, times exp(i pi/4).
                waves[self.length / 2] = Complex::new(packed[1] / T::of(FRAC_1_SQRT_2), T::default());
            }
        }
        let _ = self.backward.process_with_scratch(waves, line, scratch);
        match &self.twiddles {
            None => row.iter_mut().zip(&*line).for_each(|(x, from)| *x = scale * *from),
            Some(_) => {
                let count = row.len();
                row.iter_mut().enumerate().for_each(|(i, x)| *x = scale * line[permuted(i, count)]);
            }
        }
    }
}

/// The response of a map to each of its waves, and the transforms along x that lead there and back, in numbers of a type.
pub struct Columns<T: Number> {
    /// Points of a column.
    points: usize,
    /// Numbers of its transform: its points, or twice as many where nothing repeats.
    length: usize,
    twiddles: Option<Vec<Complex<T>>>,
    forward: Arc<dyn Fft<T>>,
    backward: Arc<dyn Fft<T>>,
    /// The response to wave (i, j) at j * stride + i: of a mirrored map for all i and j, else for the first half of the
    /// waves along both axes, since it is even in both.
    response: Vec<T>,
    stride: usize,
    /// Points along y of the transform.
    width: usize,
}

impl<T: Number> Columns<T> {
    /// Columns of `points` points, transformed as `length` numbers, of a map of `width` numbers along y.
    pub fn new(points: usize, length: usize, width: usize, is_mirrored: bool, response: Vec<T>) -> Self {
        Self {
            points,
            length,
            twiddles: is_mirrored.then(|| twiddles(points)),
            forward: asperity_fft::complex(length, FftDirection::Forward),
            backward: asperity_fft::complex(length, FftDirection::Inverse),
            response,
            stride: if is_mirrored { points } else { length / 2 + 1 },
            width,
        }
    }

    /// Numbers of a column's transform.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Scratch numbers that a transform needs.
    pub fn scratch(&self) -> Vec<Complex<T>> {
        let need = self.forward.get_inplace_scratch_len().max(self.backward.get_inplace_scratch_len());
        vec![Complex::default(); need]
    }

    /// The place of point `i` in a column that is transformed.
    pub fn place(&self, i: usize) -> usize {
        if self.twiddles.is_some() { permuted(i, self.points) } else { i }
    }

    /// The point at a place.
    pub fn point_at(&self, place: usize) -> usize {
        if self.twiddles.is_some() { point_at(place, self.points) } else { place }
    }

    /// Replaces column `j` of waves along y by the response to it, times the numbers of the transform.
    pub fn respond(&self, j: usize, column: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        // What lies beyond the points carries no pressure.
        column[self.points..].fill(Complex::default());
        self.forward.process_with_scratch(column, scratch);
        match &self.twiddles {
            Some(twiddles) => self.multiply_cosines(j, column, twiddles),
            None => self.multiply_waves(j, column),
        }
        self.backward.process_with_scratch(column, scratch);
    }

    fn response(&self, j: usize) -> &[T] {
        &self.response[j * self.stride..][..self.stride]
    }

    fn multiply_waves(&self, j: usize, column: &mut [Complex<T>]) {
        let response = self.response(j);
        let (first, rest) = column.split_at_mut(self.stride);
        if j == 0 {
            // The real part is wave 0 along y, the imaginary part the last one: both real.
            let other = self.response(self.opposite(0));
            let half = T::of(0.5);
            let pair = |z: Complex<T>, mirror: Complex<T>, k: usize| {
                z * (half * (response[k] + other[k])) + mirror.conj() * (half * (response[k] - other[k]))
            };
            first[0] = pair(first[0], first[0], 0);
            for (k, b) in rest.iter_mut().rev().enumerate() {
                let a = &mut first[k + 1];
                (*a, *b) = (pair(*a, *b, k + 1), pair(*b, *a, k + 1));
            }
            if self.length.is_multiple_of(2) {
                let middle = first[self.stride - 1];
                first[self.stride - 1] = pair(middle, middle, self.stride - 1);
            }
            return;
        }
        first.iter_mut().zip(response).for_each(|(wave, r)| *wave = *wave * *r);
        rest.iter_mut().rev().zip(&response[1..]).for_each(|(wave, r)| *wave = *wave * *r);
    }

    /// The wave along y in the imaginary part of column `j`: of a mirrored map n - j, and of column 0 the last one.
    fn opposite(&self, j: usize) -> usize {
        if j > 0 {
            self.width - j
        } else if self.width.is_multiple_of(2) {
            self.width / 2
        } else {
            0
        }
    }

    /// The cosine transform is linear over complex numbers too: the real part of the column is the cosine j along y, the
    /// imaginary part minus the cosine n - j.
    fn multiply_cosines(&self, j: usize, column: &mut [Complex<T>], twiddles: &[Complex<T>]) {
        let (real, imaginary) = (self.response(j), self.response(self.opposite(j)));
        let product = |k: usize, wave: Complex<T>| Complex::new(wave.re * real[k], wave.im * imaginary[k]);
        column[0] = product(0, column[0]);
        let n = self.points;
        let turned = |z: Complex<T>| Complex::new(-z.im, z.re);
        let half = T::of(0.5);
        for k in 1..=n / 2 {
            let w = twiddles[k];
            let (a, b) = (column[k] * w, column[n - k] * w.conj());
            let wave = product(k, (a + b) * half);
            let other = turned(product(n - k, turned((a - b) * half)));
            column[k] = w.conj() * (wave - other);
            column[n - k] = w * (wave + other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cosines_are_those_of_the_definition() {
        for count in [3, 4, 5, 8, 30, 31] {
            let transform = RowTransform::<f64>::new(count, true);
            let row: Vec<f64> = (0..count).map(|i| (i as f64 * 1.7).sin() + 0.1 * i as f64).collect();
            let mut waves = vec![0.0; 2 * transform.pairs()];
            transform.forward(&row, &mut waves, &mut transform.scratch());
            for k in 0..count {
                let found = match k {
                    0 => waves[0],
                    _ if 2 * k == count => waves[1],
                    _ if 2 * k < count => waves[2 * k],
                    _ => -waves[2 * (count - k) + 1],
                };
                let angle = |i: usize| PI * k as f64 * (i as f64 + 0.5) / count as f64;
                let exact: f64 = row.iter().enumerate().map(|(i, x)| x * angle(i).cos()).sum();
                assert!((found - exact).abs() < 1e-13 * count as f64, "{count}: {k}: {found} for {exact}");
            }
        }
    }
}
