//! Periodic Gaussian surfaces: the half spectrum is drawn, then transformed.

use asperity_fft::Complex;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::progress::{Progress, Silent};
use crate::topography::fourier::{synthesise, weight};
use crate::topography::spectrum::GridSpectrum;

/// Heights (m) of a periodic Gaussian surface of a spectrum. `sigma` (m) is the standard deviation of an infinite
/// surface; that of a map about its own mean is slightly smaller on average. Determined by the seed, for any number of
/// threads.
///
/// Each wave number along y has its own random stream, in which waves are drawn by increasing wave number along x: a
/// map of the same size on a finer grid has the same long waves.
pub fn gaussian(spectrum: &GridSpectrum, sigma: f64, seed: [u8; 32]) -> Vec<f64> {
    watched(spectrum, sigma, seed, &Silent)
}

/// [`gaussian`] with progress: one unit of work.
pub(super) fn watched(
    spectrum: &GridSpectrum,
    sigma: f64,
    seed: [u8; 32],
    progress: &dyn Progress,
) -> Vec<f64> {
    let points = spectrum.points();
    let draw = |j: usize, waves: &mut [Complex<f64>]| {
        let mut deviations = vec![0.0; waves.len()];
        spectrum.column(j, &mut deviations);
        let mut rng = ChaCha8Rng::from_seed(seed);
        rng.set_stream(j as u64);
        // Column 0, and the last of an even number, are real along y: waves -i follow from i.
        if weight(points, j) == 1.0 {
            draw_real(&deviations, &mut rng, waves);
        } else {
            draw_complex(&deviations, &mut rng, waves);
        }
        weight(points, j) * deviations.iter().map(|deviation| deviation * deviation).sum::<f64>()
    };
    let total = |variances: Vec<f64>| spectrum.mean_variance() + variances.iter().sum::<f64>();
    synthesise(points, draw, |variances| sigma / total(variances).sqrt(), progress)
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

/// Draws independent waves in the order i = 0, 1, -1, 2, -2, ...
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

/// Draws the waves of a real profile: wave -i is the conjugate of wave i.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::fourier::analyse;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    /// Also those that represent no other: at the end of even numbers of points.
    #[test]
    fn each_wave_has_its_variance_and_is_drawn_by_itself() {
        const SEEDS: u32 = 3000;
        let points = [8, 6];
        let shape = SpectrumShape::Gaussian(0.7);
        let spectrum =
            Spectrum::new(shape, Lay { elongation: 1.5, angle: 0.6 }).unwrap().on_grid(points, [1.0; 2]);
        let mut power = vec![vec![0.0; 8]; 4];
        let mut product = Complex::<f64>::default();
        for number in 0..SEEDS {
            let mut seed = [7; 32];
            seed[..4].copy_from_slice(&number.to_le_bytes());
            let waves = analyse(gaussian(&spectrum, 1.0, seed), points, |_, column| column.to_vec(), &Silent);
            for (sum, wave) in power.iter_mut().flatten().zip(waves.iter().flatten()) {
                *sum += wave.norm_sqr() / f64::from(SEEDS);
            }
            product += waves[1][1] * waves[2][1].conj() / f64::from(SEEDS);
        }
        let mut deviations = vec![0.0; 8];
        let mut total = spectrum.mean_variance();
        for j in 0..4 {
            spectrum.column(j, &mut deviations);
            total += weight(points, j) * deviations.iter().map(|d| d * d).sum::<f64>();
        }
        for (j, power) in power.iter().enumerate() {
            spectrum.column(j, &mut deviations);
            for (i, (power, deviation)) in power.iter().zip(&deviations).enumerate() {
                let exact = 48.0 * 48.0 * deviation * deviation / total;
                // Five standard errors of the square of a real wave.
                assert!(
                    (power - exact).abs() <= 5.0 * (2.0 / f64::from(SEEDS)).sqrt() * exact + 1e-20,
                    "{i} {j}"
                );
            }
        }
        assert!(product.norm() < 0.1 * (power[1][1] * power[2][1]).sqrt(), "{product}");
    }
}
