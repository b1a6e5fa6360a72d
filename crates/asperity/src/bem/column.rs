//! Responses of columns of waves: transform along x, product with the response, and back.

use std::sync::Arc;

use asperity_fft::{Complex, Fft, FftDirection, Number};

use super::row::{permuted, point_at, twiddles};

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
