//! Periodic Gaussian surfaces: the half spectrum is drawn, then transformed.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use realfft::num_complex::Complex;

use crate::surface::fourier::{synthesise, weight};
use crate::surface::spectrum::GridSpectrum;

/// Heights (m) of a Gaussian surface whose standard deviation is `sigma` (m) on an endless surface of the spectrum;
/// that of a map, about its own mean, scatters about a little less. The seed decides them all, on any number of threads.
///
/// Each wave number along y has a random stream of its own, and in it waves are drawn by growing wave
/// number along x: a map of the same size on a finer grid has the same long waves.
pub fn gaussian(spectrum: &GridSpectrum, sigma: f64, seed: [u8; 32]) -> Vec<f64> {
    let points = spectrum.points();
    let draw = |j: usize, waves: &mut [Complex<f64>]| {
        let mut deviations = vec![0.0; waves.len()];
        spectrum.column(j, &mut deviations);
        let mut rng = ChaCha8Rng::from_seed(seed);
        rng.set_stream(j as u64);
        // Column 0 and the last of an even number are waves along x alone: those of -i follow from i.
        if weight(points, j) == 1.0 {
            draw_real(&deviations, &mut rng, waves);
        } else {
            draw_complex(&deviations, &mut rng, waves);
        }
        weight(points, j) * deviations.iter().map(|deviation| deviation * deviation).sum::<f64>()
    };
    let total = |variances: Vec<f64>| spectrum.mean_variance() + variances.iter().sum::<f64>();
    synthesise(points, draw, |variances| sigma / total(variances).sqrt())
}

fn normal(rng: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(rng)
}

/// A wave of unit mean square.
fn wave(deviation: f64, rng: &mut ChaCha8Rng) -> Complex<f64> {
    if deviation == 0.0 {
        return Complex::default();
    }
    let part = deviation * std::f64::consts::FRAC_1_SQRT_2;
    Complex::new(part * normal(rng), part * normal(rng))
}

/// Waves that are independent of each other: i = 0, 1, -1, 2, -2, ...
fn draw_complex(deviations: &[f64], rng: &mut ChaCha8Rng, waves: &mut [Complex<f64>]) {
    let count = waves.len();
    waves[0] = wave(deviations[0], rng);
    for i in 1..=count / 2 {
        waves[i] = wave(deviations[i], rng);
        if i != count - i {
            waves[count - i] = wave(deviations[count - i], rng);
        }
    }
}

/// Waves of a real profile: that of -i is the conjugate of that of i.
fn draw_real(deviations: &[f64], rng: &mut ChaCha8Rng, waves: &mut [Complex<f64>]) {
    let count = waves.len();
    waves[0] = Complex::new(deviations[0] * normal(rng), 0.0);
    for i in 1..=count / 2 {
        if i == count - i {
            waves[i] = Complex::new(deviations[i] * normal(rng), 0.0);
        } else {
            waves[i] = wave(deviations[i], rng);
            waves[count - i] = waves[i].conj();
        }
    }
}
