//! Roughness whose amplitude varies from place to place.

use asperity::topography::generate::gaussian;
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};

/// An amplitude exp(c f - c^2) of the heights: f is a Gaussian field of unit variance with the autocorrelation exp(-(r/l)^2). The
/// mean square of the heights stays as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patches {
    /// Standard deviation c of the logarithm of the amplitude.
    pub modulation: f64,
    /// Correlation length l, m.
    pub length: f64,
    spectrum: Spectrum,
}

impl Patches {
    /// With the correlation `length` l, m.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn new(modulation: f64, length: f64) -> Result<Self, SpectrumError> {
        let spectrum = Spectrum::new(SpectrumShape::Gaussian(length), Lay::default())?;
        Ok(Self { modulation, length, spectrum })
    }

    /// Checks whether a grid holds the patches.
    ///
    /// # Errors
    /// A length of which a side holds fewer than ten.
    pub fn check(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<(), SpectrumError> {
        self.spectrum.check(points, pixel)
    }

    /// Multiplies `heights` by the amplitude that `seed` gives.
    pub fn modulate(&self, heights: &mut [f64], points: [usize; 2], pixel: [f64; 2], seed: [u8; 32]) {
        let field = gaussian(&self.spectrum.on_grid(points, pixel), 1.0, seed);
        let c = self.modulation;
        heights.iter_mut().zip(field).for_each(|(z, f)| *z *= (c * f - c * c).exp());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_keep_the_mean_square_and_have_the_scatter_asked_for() {
        let patches = Patches::new(0.4, 5.0).unwrap();
        let points = [256; 2];
        let mut amplitudes = vec![1.0; 256 * 256];
        patches.modulate(&mut amplitudes, points, [1.0; 2], [3; 32]);
        let count = amplitudes.len() as f64;
        let square = amplitudes.iter().map(|a| a * a).sum::<f64>() / count;
        let logs: Vec<f64> = amplitudes.iter().map(|a: &f64| a.ln()).collect();
        let mean = logs.iter().sum::<f64>() / count;
        let scatter = (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / count).sqrt();
        assert!((square - 1.0).abs() < 0.1 && (scatter - 0.4).abs() < 0.03, "{square} {scatter}");
        assert!(patches.check(points, [1.0; 2]).is_ok());
        assert!(Patches::new(0.4, 50.0).unwrap().check(points, [1.0; 2]).is_err());
    }
}
