//! Spectra of random rough surfaces: how much of the height variance each wave carries.

use std::f64::consts::TAU;

use rayon::prelude::*;
use realfft::num_complex::Complex;

use super::fourier::{analyse, synthesise, weight};
use super::marginal::Distortion;
use crate::numeric::is_positive;
use crate::numeric::power::Power;

/// A spectrum of unit variance, by its shape and its lay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    shape: Shape,
    lay: Lay,
}

/// The shape of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Power spectral density constant up to the wave number of `roll_off`, falling as q^(-2 (1 + hurst)) to that of
    /// `cut_off`, zero beyond (Persson et al. 2005, section 2). Wavelengths in m.
    SelfAffine {
        /// Hurst exponent, 0 to 1.
        hurst: f64,
        /// Longest wavelength of the power law, m.
        roll_off: f64,
        /// Shortest wavelength, m.
        cut_off: f64,
    },
    /// Autocorrelation exp(-(r/l)^2) with the correlation length l, m.
    Gaussian(f64),
    /// Autocorrelation exp(-r/l) with the correlation length l, m.
    Exponential(f64),
}

/// The lay: lengths along it are `elongation` times those of the [`Shape`], which are across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lay {
    /// Lengths along the lay over those across it.
    pub elongation: f64,
    /// From the x axis to the lay, rad.
    pub angle: f64,
}

impl Default for Lay {
    fn default() -> Self {
        Self { elongation: 1.0, angle: 0.0 }
    }
}

/// Numbers that make no spectrum.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// A surface that is self-affine.
    #[error("found a Hurst exponent of {0}; allowed: 0 to 1")]
    Hurst(f64),
    /// Wavelengths in order.
    #[error(
        "found a roll-off at {roll_off:.3e} m and a cut-off at {cut_off:.3e} m; allowed: a roll-off wavelength that is at least the cut-off's"
    )]
    Order {
        /// The longest wavelength of the power law, m.
        roll_off: f64,
        /// The shortest wavelength, m.
        cut_off: f64,
    },
    /// Lengths are positive.
    #[error("found a length of {0} m; allowed: positive and finite")]
    Length(f64),
    /// A lay is longer one way than the other.
    #[error("found an elongation of {0}; allowed: 1e-3 to 1e3")]
    Elongation(f64),
    /// The grid shows the shortest wave.
    #[error("found a cut-off at {cut_off:.3e} m on pixels of {pixel:.3e} m; allowed: at least two pixels")]
    BelowPixel {
        /// The shortest wavelength along an axis, m.
        cut_off: f64,
        /// The pixel along it, m.
        pixel: f64,
    },
    /// The map shows the longest wave.
    #[error(
        "found a {what} of {length:.3e} m on a map of {size:.3e} m; allowed: at most {part} of the shorter side"
    )]
    TooLong {
        /// Roll-off or correlation length.
        what: &'static str,
        /// It, m.
        length: f64,
        /// The map's shorter side, m.
        size: f64,
        /// How much of the side is allowed.
        part: &'static str,
    },
}

impl Spectrum {
    /// A spectrum of a shape with a lay.
    ///
    /// # Errors
    /// Numbers outside the ranges of [`SpectrumError`].
    pub fn new(shape: Shape, lay: Lay) -> Result<Self, SpectrumError> {
        let lengths = match shape {
            Shape::SelfAffine { hurst, roll_off, cut_off } => {
                if !(0.0..=1.0).contains(&hurst) {
                    return Err(SpectrumError::Hurst(hurst));
                }
                [roll_off, cut_off]
            }
            Shape::Gaussian(length) | Shape::Exponential(length) => [length; 2],
        };
        if let Some(&length) = lengths.iter().find(|&&length| !is_positive(length)) {
            return Err(SpectrumError::Length(length));
        }
        if lengths[0] < lengths[1] {
            return Err(SpectrumError::Order { roll_off: lengths[0], cut_off: lengths[1] });
        }
        if !(1e-3..=1e3).contains(&lay.elongation) || !lay.angle.is_finite() {
            return Err(SpectrumError::Elongation(lay.elongation));
        }
        Ok(Self { shape, lay })
    }

    /// Its shape.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Its lay.
    pub fn lay(&self) -> Lay {
        self.lay
    }

    /// Whether a grid of `points` that are `pixel` (m) apart can show it.
    ///
    /// # Errors
    /// A cut-off below two pixels; a roll-off beyond the map or a correlation length beyond a quarter of it.
    pub fn check(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<(), SpectrumError> {
        let side = [0, 1].map(|axis| points[axis] as f64 * pixel[axis]);
        let size = side[0].min(side[1]);
        let longest = self.lay.elongation.max(1.0);
        match self.shape {
            Shape::SelfAffine { roll_off, cut_off, .. } => {
                let shortest = cut_off * self.lay.elongation.min(1.0);
                let coarsest = pixel[0].max(pixel[1]);
                if shortest < 2.0 * coarsest * (1.0 - 1e-12) {
                    return Err(SpectrumError::BelowPixel { cut_off: shortest, pixel: coarsest });
                }
                let length = roll_off * longest;
                if length > size {
                    return Err(SpectrumError::TooLong { what: "roll-off", length, size, part: "all" });
                }
            }
            Shape::Gaussian(length) | Shape::Exponential(length) => {
                let length = length * longest;
                if 4.0 * length > size {
                    let what = "correlation length";
                    return Err(SpectrumError::TooLong { what, length, size, part: "a quarter" });
                }
            }
        }
        Ok(())
    }

    /// Autocorrelation at a distance (m, along x and y) on an endless surface; `None` where it has no
    /// closed form.
    pub fn autocorrelation(&self, distance: [f64; 2]) -> Option<f64> {
        let r = self.lay.squared(distance, self.lay.elongation.recip()).sqrt();
        match self.shape {
            Shape::SelfAffine { .. } => None,
            Shape::Gaussian(length) => Some((-(r / length).powi(2)).exp()),
            Shape::Exponential(length) => Some((-r / length).exp()),
        }
    }

    /// The spectrum on a periodic grid of `points` that are `pixel` (m) apart.
    pub fn on_grid(&self, points: [usize; 2], pixel: [f64; 2]) -> GridSpectrum {
        let kind = match self.shape {
            Shape::SelfAffine { hurst, roll_off, cut_off } => Kind::PowerLaw {
                step: [0, 1].map(|axis| TAU / (points[axis] as f64 * pixel[axis])),
                lay: self.lay,
                roll_off: (TAU / roll_off).powi(2),
                // Waves on the edge are in, rounding or not.
                cut_off: (TAU / cut_off).powi(2) * (1.0 + 1e-12),
                power: Power::new(-0.5 * (1.0 + hurst)),
            },
            _ => Kind::Table(self.table(points, pixel)),
        };
        GridSpectrum { points, kind }
    }

    /// Amplitudes whose autocorrelation on the grid is the one asked for, aliases and all: the roots of the
    /// transform of the autocorrelation, wrapped around the map. Column by column.
    fn table(&self, points: [usize; 2], pixel: [f64; 2]) -> Vec<f64> {
        /// Images of the map that are further away than so many correlation lengths are below rounding.
        const FAR: f64 = 40.0;
        let size = [points[0] as f64 * pixel[0], points[1] as f64 * pixel[1]];
        let length = match self.shape {
            Shape::SelfAffine { roll_off, .. } => roll_off,
            Shape::Gaussian(length) | Shape::Exponential(length) => length,
        };
        let reach = FAR * length * self.lay.elongation.max(1.0);
        let images = |distance: f64, size: f64| {
            [0.0, -1.0, 1.0].into_iter().map(move |k| distance + k * size).filter(move |d| d.abs() < reach)
        };
        let mut wrapped = vec![0.0; points[0] * points[1]];
        wrapped.par_chunks_mut(points[1]).enumerate().for_each(|(i, row)| {
            let x = i as f64 * pixel[0];
            for (j, value) in row.iter_mut().enumerate() {
                let y = j as f64 * pixel[1];
                *value = images(x, size[0])
                    .flat_map(|x| images(y, size[1]).map(move |y| [x, y]))
                    .filter_map(|distance| self.autocorrelation(distance))
                    .sum();
            }
        });
        roots(wrapped, points)
    }
}

/// Amplitudes of the waves of a field with this autocorrelation, column by column. Its transform is real; where it
/// is negative no field has it.
fn roots(correlation: Vec<f64>, points: [usize; 2]) -> Vec<f64> {
    let column = |_, column: &[Complex<f64>]| -> Vec<f64> {
        column.iter().map(|wave| wave.re.max(0.0).sqrt()).collect()
    };
    analyse(correlation, points, column).concat()
}

impl Lay {
    /// Squared length of a vector whose part along the lay is multiplied by `factor`.
    fn squared(&self, [x, y]: [f64; 2], factor: f64) -> f64 {
        if self.elongation == 1.0 {
            return x * x + y * y;
        }
        let (sin, cos) = self.angle.sin_cos();
        let (along, across) = (factor * (x * cos + y * sin), y * cos - x * sin);
        along * along + across * across
    }

    /// Whether waves i and -i along x are alike.
    fn is_mirrored(&self) -> bool {
        self.elongation == 1.0 || self.angle == 0.0
    }
}

/// A spectrum on a periodic grid: standard deviations of its waves, up to a common factor.
#[derive(Debug, Clone)]
pub struct GridSpectrum {
    points: [usize; 2],
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    /// Squared wave numbers in rad^2/m^2; the power is that of the amplitude over the squared wave number.
    PowerLaw { step: [f64; 2], lay: Lay, roll_off: f64, cut_off: f64, power: Power },
    /// Column by column.
    Table(Vec<f64>),
}

impl GridSpectrum {
    /// Points along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The spectrum of the Gaussian field that a map of heights turns into a field of this one, as far as there is
    /// one: autocorrelations that no Gaussian field can have are brought to the nearest that it can (Grigoriu 1998).
    pub fn before(&self, map: &Distortion) -> Self {
        let points = self.points;
        let inverse = map.inverse();
        let mut correlation = synthesise(
            points,
            |j, waves| {
                let mut deviations = vec![0.0; waves.len()];
                self.column(j, &mut deviations);
                let mut total = 0.0;
                for (wave, deviation) in waves.iter_mut().zip(&deviations) {
                    *wave = Complex::new(deviation * deviation, 0.0);
                    total += wave.re;
                }
                weight(points, j) * total
            },
            |totals| totals.iter().sum::<f64>().recip(),
        );
        correlation.par_chunks_mut(points[1]).for_each(|row| {
            row.iter_mut().for_each(|rho| *rho = inverse.of(*rho));
        });
        Self { points, kind: Kind::Table(roots(correlation, points)) }
    }

    /// Writes the standard deviations of the waves with wave number `j` along y, by their wave number along x
    /// (0, 1, ..., -2, -1).
    pub fn column(&self, j: usize, waves: &mut [f64]) {
        match &self.kind {
            Kind::PowerLaw { step, lay, roll_off, cut_off, power } => {
                let scale = roll_off.recip();
                let y = step[1] * j as f64;
                let amplitude = |x: f64| {
                    let q = lay.squared([x, y], lay.elongation);
                    if q > *cut_off { 0.0 } else { power.of((q * scale).max(1.0)) }
                };
                let (count, half) = (waves.len(), waves.len() / 2);
                for (i, wave) in waves[..=half].iter_mut().enumerate() {
                    *wave = amplitude(step[0] * i as f64);
                }
                for mirror in 1..count - half {
                    waves[count - mirror] =
                        if lay.is_mirrored() { waves[mirror] } else { amplitude(-step[0] * mirror as f64) };
                }
            }
            Kind::Table(table) => {
                let count = waves.len();
                waves.copy_from_slice(&table[j * count..(j + 1) * count]);
            }
        }
        // The mean plane is at zero.
        if j == 0 {
            waves[0] = 0.0;
        }
    }
}
