//! Linear systems whose matrix is a smooth even convolution on an interval, at a cost of n log n a product.

use std::sync::Arc;

use asperity_fft::{Complex64, ComplexToReal, RealToComplex};

use crate::numeric::quadrature::{NODES, Panel, Variable, panels};

/// The largest number of iterations (products with the matrix).
const PRODUCTS: usize = 20_000;

/// Tolerance of the residual relative to the right-hand side.
const RESIDUAL: f64 = 1e-15;

/// The operator (shift + k *) on [-a, a], (k * g)(y) = int k(|y - y'|) g(y') dy', by Nystrom's method on equal
/// Gauss-Legendre panels. Blocks depend on the distance of their panels only (a block Toeplitz matrix), so that
/// products are computed by fast Fourier transforms. Unknowns are scaled by the square root of their weight, which
/// makes the matrix symmetric.
pub struct Convolution {
    panel: Panel,
    width: f64,
    count: usize,
    shift: f64,
    /// The transform of block entry (i, j) over the distance of the panels, at `(i * NODES + j) *
    /// frequencies`.
    symbol: Vec<Complex64>,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

impl Convolution {
    /// The operator with `count` panels, for a positive definite shift + k.
    pub fn new(shift: f64, kernel: impl Fn(f64) -> f64, a: f64, count: usize) -> Self {
        let width = 2.0 * a / count as f64;
        let panel = panels(0.0, width, Variable::Linear, 1).next().expect("one panel was asked for");
        // Distances from -(count - 1) to count - 1 fit without overlap.
        let length = (2 * count).next_power_of_two();
        let (forward, backward) =
            (asperity_fft::real_to_complex(length), asperity_fft::complex_to_real(length));
        let mut symbol = Vec::with_capacity(NODES * NODES * (length / 2 + 1));
        let mut transform = forward.make_output_vec();
        for i in 0..NODES {
            for j in 0..NODES {
                let weight = (panel.weights[i] * panel.weights[j]).sqrt() / length as f64;
                let offset = panel.points[i] - panel.points[j];
                let mut entries = forward.make_input_vec();
                for d in 0..count {
                    entries[d] = weight * kernel((width * d as f64 + offset).abs());
                    if d > 0 {
                        entries[length - d] = weight * kernel((width * d as f64 - offset).abs());
                    }
                }
                forward.process(&mut entries, &mut transform).expect("lengths are the plan's own");
                symbol.extend_from_slice(&transform);
            }
        }
        Self { panel, width, count, shift, symbol, forward, backward }
    }

    /// Abscissa and weight of every node, from -a to a.
    pub fn nodes(&self) -> impl Iterator<Item = (f64, f64)> {
        let half = 0.5 * self.count as f64;
        (0..self.count).flat_map(move |k| {
            let start = (k as f64 - half) * self.width;
            (0..NODES).map(move |i| (start + self.panel.points[i], self.panel.weights[i]))
        })
    }

    /// The derivative at a of a function that is 0 there, from its values at the nodes of the last panel.
    pub fn slope_at_end(&self, values: &[f64]) -> f64 {
        let (points, values) = (&self.panel.points, &values[values.len() - NODES..]);
        let rest = |j: usize| self.width - points[j];
        let lagrange = |j: usize| -> f64 {
            (0..NODES).filter(|&k| k != j).map(|k| rest(k) / (points[j] - points[k])).product()
        };
        (0..NODES).map(|j| -values[j] * lagrange(j) / rest(j)).sum()
    }

    /// g at the nodes with (shift + k *) g = f; `None` if the iteration does not converge.
    ///
    /// Conjugate gradients (Hestenes and Stiefel 1952): the number of iterations grows as the square root of the
    /// condition number, which is at most that of shift + the transform of k.
    pub fn solve(&self, f: impl Fn(f64) -> f64) -> Option<Vec<f64>> {
        let mut residual: Vec<f64> = self.nodes().map(|(y, weight)| f(y) * weight.sqrt()).collect();
        let mut direction = residual.clone();
        let mut solution = vec![0.0; residual.len()];
        let mut square = dot(&residual, &residual);
        let enough = square * (RESIDUAL * RESIDUAL);
        for _ in 0..PRODUCTS {
            let product = self.times(&direction);
            let step = square / dot(&direction, &product);
            for k in 0..solution.len() {
                solution[k] += step * direction[k];
                residual[k] -= step * product[k];
            }
            let next = dot(&residual, &residual);
            if next <= enough {
                return Some(self.nodes().zip(solution).map(|((_, weight), s)| s / weight.sqrt()).collect());
            }
            for k in 0..direction.len() {
                direction[k] = residual[k] + next / square * direction[k];
            }
            square = next;
        }
        None
    }

    fn times(&self, x: &[f64]) -> Vec<f64> {
        let frequencies = self.forward.complex_len();
        let mut transforms = vec![Complex64::default(); NODES * frequencies];
        let mut scratch = self.forward.make_scratch_vec();
        let mut values = self.forward.make_input_vec();
        for (j, transform) in transforms.chunks_exact_mut(frequencies).enumerate() {
            values.fill(0.0);
            for k in 0..self.count {
                values[k] = x[k * NODES + j];
            }
            self.forward
                .process_with_scratch(&mut values, transform, &mut scratch)
                .expect("the plan's lengths");
        }
        let mut product: Vec<f64> = x.iter().map(|x| self.shift * x).collect();
        let mut scratch = self.backward.make_scratch_vec();
        let mut sum = vec![Complex64::default(); frequencies];
        for (i, row) in self.symbol.chunks_exact(NODES * frequencies).enumerate() {
            sum.fill(Complex64::default());
            for (entry, transform) in row.chunks_exact(frequencies).zip(transforms.chunks_exact(frequencies))
            {
                for ((sum, entry), transform) in sum.iter_mut().zip(entry).zip(transform) {
                    *sum += entry * transform;
                }
            }
            // Real by symmetry but for rounding, which the transform does not accept.
            sum[0].im = 0.0;
            sum[frequencies - 1].im = 0.0;
            self.backward
                .process_with_scratch(&mut sum, &mut values, &mut scratch)
                .expect("the plan's lengths");
            for k in 0..self.count {
                product[k * NODES + i] += values[k];
            }
        }
        product
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
