//! Spectra of random rough surfaces: the distribution of the height variance over wave vectors.

use std::f64::consts::TAU;

use asperity_fft::Complex;

use super::fourier::{analyse, columns, synthesise, weight};
use super::height_transform::Distortion;
use crate::memory::zeros;
use crate::numeric::is_positive;
use crate::numeric::parallel::{self, for_each_row};
use crate::numeric::power::Power;
use crate::progress::{Progress, Share, Silent};

/// The smallest number of correlation lengths along each side of a map: about a hundred independent patches.
const LENGTHS_ACROSS: f64 = 10.0;

/// A spectrum of unit variance, given by shape and lay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    shape: SpectrumShape,
    lay: Lay,
}

/// The shape of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpectrumShape {
    /// Power spectral density constant up to the wave number of `roll_off`, proportional to q^(-2 (1 + hurst)) up to
    /// that of `cut_off`, zero beyond (Persson et al. 2005, section 2). Wavelengths in m.
    SelfAffine {
        /// Hurst exponent, 0 to 1.
        hurst: f64,
        /// Longest wavelength of the power law, m.
        roll_off: f64,
        /// Shortest wavelength, m.
        cut_off: f64,
    },
    /// Weighted sum of the amplitudes of two self-affine spectra that are equal along the power law.
    Between {
        /// Hurst exponent, 0 to 1.
        hurst: f64,
        /// Longest wavelengths of both power laws, m, the shorter first.
        roll_offs: [f64; 2],
        /// Weight of the second, 0 to 1.
        weight: f64,
        /// Shortest wavelength, m.
        cut_off: f64,
    },
    /// Autocorrelation exp(-(r/l)^2) with the correlation length l, m.
    Gaussian(f64),
    /// Autocorrelation exp(-r/l) with the correlation length l, m.
    Exponential(f64),
}

/// The lay: lengths along it are `elongation` times those of the [`SpectrumShape`], which apply across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lay {
    /// Lengths along the lay over those across it.
    pub elongation: f64,
    /// Angle from the x axis to the lay, rad.
    pub angle: f64,
}

impl Default for Lay {
    fn default() -> Self {
        Self { elongation: 1.0, angle: 0.0 }
    }
}

/// Invalid parameters of a spectrum, or a grid that does not resolve it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum SpectrumError {
    /// A Hurst exponent outside 0 to 1.
    #[error("found a Hurst exponent of {0}; allowed: 0 to 1")]
    Hurst(f64),
    /// The roll-off wavelength is shorter than the cut-off.
    #[error(
        "found a roll-off at {roll_off:.3e} m and a cut-off at {cut_off:.3e} m; allowed: a roll-off wavelength that is at least the cut-off's"
    )]
    Order { roll_off: f64, cut_off: f64 },
    /// Roll-offs in descending order, or a weight outside 0 to 1.
    #[error(
        "found roll-offs at {:.3e} m and {:.3e} m and a weight of {weight}; allowed: the shorter first, a weight of 0 to 1",
        roll_offs[0], roll_offs[1]
    )]
    Between { roll_offs: [f64; 2], weight: f64 },
    /// A length that is not positive and finite.
    #[error("found a length of {0} m; allowed: positive and finite")]
    Length(f64),
    /// An elongation outside 1e-3 to 1e3.
    #[error("found an elongation of {0}; allowed: 1e-3 to 1e3")]
    Elongation(f64),
    /// The grid does not resolve the shortest wave.
    #[error("found a cut-off at {cut_off:.3e} m on pixels of {pixel:.3e} m; allowed: at least two pixels")]
    BelowPixel { cut_off: f64, pixel: f64 },
    /// The grid does not resolve the correlation length.
    #[error(
        "found a correlation length of {length:.3e} m on pixels of {pixel:.3e} m; allowed: at least a pixel"
    )]
    Unresolved { length: f64, pixel: f64 },
    /// The map is too small for the longest wave.
    #[error(
        "found a {what} of {length:.3e} m along a side of {size:.3e} m; allowed: at most {part} of the side"
    )]
    TooLong { what: &'static str, length: f64, size: f64, part: &'static str },
}

impl Spectrum {
    /// A spectrum of a shape with a lay.
    ///
    /// # Errors
    /// Parameters outside the ranges of [`SpectrumError`].
    pub fn new(shape: SpectrumShape, lay: Lay) -> Result<Self, SpectrumError> {
        if let SpectrumShape::SelfAffine { hurst, .. } | SpectrumShape::Between { hurst, .. } = shape
            && !(0.0..=1.0).contains(&hurst)
        {
            return Err(SpectrumError::Hurst(hurst));
        }
        if let SpectrumShape::Between { roll_offs, weight, .. } = shape
            && !(roll_offs[0] <= roll_offs[1] && (0.0..=1.0).contains(&weight))
        {
            return Err(SpectrumError::Between { roll_offs, weight });
        }
        let lengths = match shape {
            SpectrumShape::SelfAffine { roll_off, cut_off, .. }
            | SpectrumShape::Between { roll_offs: [roll_off, _], cut_off, .. } => [roll_off, cut_off],
            SpectrumShape::Gaussian(length) | SpectrumShape::Exponential(length) => [length; 2],
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

    /// The shape across the lay.
    pub fn shape(&self) -> SpectrumShape {
        self.shape
    }

    /// The lay.
    pub fn lay(&self) -> Lay {
        self.lay
    }

    /// Checks whether a grid of `points` at a distance of `pixel` (m) resolves the spectrum, along each axis with the
    /// lengths that the lay gives there.
    ///
    /// # Errors
    /// Waves below two pixels; a roll-off beyond the map, or a correlation length beyond a tenth of it.
    pub fn check(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<(), SpectrumError> {
        /// Allowance for rounding.
        const ROUNDING: f64 = 1.0 + 1e-9;
        for axis in 0..2 {
            let (size, pixel) = (points[axis] as f64 * pixel[axis], pixel[axis]);
            let extent = self.lay.extent(axis);
            match self.shape {
                SpectrumShape::SelfAffine { roll_off, cut_off, .. }
                | SpectrumShape::Between { roll_offs: [_, roll_off], cut_off, .. } => {
                    let cut_off = cut_off / self.lay.shortening(axis);
                    if cut_off * ROUNDING < 2.0 * pixel {
                        return Err(SpectrumError::BelowPixel { cut_off, pixel });
                    }
                    let length = roll_off * extent;
                    if length > size * ROUNDING {
                        return Err(SpectrumError::TooLong { what: "roll-off", length, size, part: "all" });
                    }
                }
                SpectrumShape::Gaussian(length) | SpectrumShape::Exponential(length) => {
                    let length = length * extent;
                    if length * ROUNDING < pixel {
                        return Err(SpectrumError::Unresolved { length, pixel });
                    }
                    if LENGTHS_ACROSS * length > size * ROUNDING {
                        let what = "correlation length";
                        return Err(SpectrumError::TooLong { what, length, size, part: "a tenth" });
                    }
                }
            }
        }
        Ok(())
    }

    /// The shortest wave, m: the cut-off, or the correlation length of a Gaussian autocorrelation, below which waves hold less
    /// than a thousandth of the mean square gradient; `None` of an exponential autocorrelation, whose waves have no shortest.
    pub fn shortest_wave(&self) -> Option<f64> {
        let across = match self.shape {
            SpectrumShape::SelfAffine { cut_off, .. } | SpectrumShape::Between { cut_off, .. } => cut_off,
            SpectrumShape::Gaussian(length) => length,
            SpectrumShape::Exponential(_) => return None,
        };
        Some(across * self.lay.elongation.min(1.0))
    }

    /// Autocorrelation at a distance (m, along x and y) of an infinite surface; `None` if it has no closed form.
    pub fn autocorrelation(&self, distance: [f64; 2]) -> Option<f64> {
        let r = self.lay.squared(distance, self.lay.elongation.recip()).sqrt();
        match self.shape {
            SpectrumShape::SelfAffine { .. } | SpectrumShape::Between { .. } => None,
            SpectrumShape::Gaussian(length) => Some((-(r / length).powi(2)).exp()),
            SpectrumShape::Exponential(length) => Some((-r / length).exp()),
        }
    }

    /// The spectrum on a periodic grid of `points` at a distance of `pixel` (m).
    pub fn on_grid(&self, points: [usize; 2], pixel: [f64; 2]) -> GridSpectrum {
        let power_law = |hurst: f64, roll_off: f64, cut_off: f64, shorter| Kind::PowerLaw {
            step: [0, 1].map(|axis| TAU / (points[axis] as f64 * pixel[axis])),
            lay: self.lay,
            roll_off: (TAU / roll_off).powi(2),
            // Waves at the limit are included regardless of rounding.
            cut_off: (TAU / cut_off).powi(2) * (1.0 + 1e-12),
            power: Power::new(-0.5 * (1.0 + hurst)),
            shorter,
        };
        let kind = match self.shape {
            SpectrumShape::SelfAffine { hurst, roll_off, cut_off } => {
                power_law(hurst, roll_off, cut_off, None)
            }
            SpectrumShape::Between { hurst, roll_offs: [shorter, longer], weight, cut_off } => {
                power_law(hurst, longer, cut_off, Some(((longer / shorter).powi(2), 1.0 - weight)))
            }
            _ => Kind::Table(self.table(points, pixel)),
        };
        GridSpectrum { points, kind }
    }

    /// The distance across the lay (m) at which the autocorrelation is below 1e-14.
    fn reach(&self) -> f64 {
        match self.shape {
            SpectrumShape::SelfAffine { roll_off, .. }
            | SpectrumShape::Between { roll_offs: [_, roll_off], .. } => roll_off,
            SpectrumShape::Gaussian(length) => 5.7 * length,
            SpectrumShape::Exponential(length) => 32.3 * length,
        }
    }

    /// Amplitudes whose autocorrelation on the grid is the prescribed one, aliases included: the roots of the
    /// transform of the autocorrelation, wrapped around the map. Column by column.
    fn table(&self, points: [usize; 2], pixel: [f64; 2]) -> Vec<f64> {
        let size = [points[0] as f64 * pixel[0], points[1] as f64 * pixel[1]];
        let reach = self.reach();
        // The nearest image of each lag first, so that sums at opposite lags are equal.
        let images = [0, 1].map(|axis| {
            let reach = reach * self.lay.extent(axis);
            let most = (reach / size[axis]).ceil() as i32;
            let nearest = |k: usize| {
                let distance = k as f64 * pixel[axis];
                if 2 * k > points[axis] { distance - size[axis] } else { distance }
            };
            let all = |k: usize| {
                let images = (-most..=most).map(|image| nearest(k) + f64::from(image) * size[axis]);
                images.filter(|distance| distance.abs() <= reach).collect::<Vec<f64>>()
            };
            (0..points[axis]).map(all).collect::<Vec<_>>()
        });
        let mut wrapped = zeros(points[0] * points[1]);
        for_each_row(&mut wrapped, points[1], &|ix, row| {
            let along_x = &images[0][ix];
            for (value, along_y) in row.iter_mut().zip(&images[1]) {
                let all = along_x.iter().flat_map(|&x| along_y.iter().map(move |&y| [x, y]));
                *value = all.filter_map(|distance| self.autocorrelation(distance)).sum();
            }
        });
        roots(wrapped, points, &Silent)
    }
}

/// Amplitudes of the waves of a field with this autocorrelation, column by column. Its transform is real; negative
/// values, which no field has, are set to 0.
fn roots(correlation: Vec<f64>, points: [usize; 2], progress: &dyn Progress) -> Vec<f64> {
    let column = |_, column: &[Complex<f64>]| -> Vec<f64> {
        column.iter().map(|wave| wave.re.max(0.0).sqrt()).collect()
    };
    analyse(correlation, points, column, progress).concat()
}

impl Lay {
    /// Squared length of a vector whose component along the lay is multiplied by `factor`.
    fn squared(&self, [x, y]: [f64; 2], factor: f64) -> f64 {
        if self.elongation == 1.0 {
            return x * x + y * y;
        }
        let (sin, cos) = self.angle.sin_cos();
        let (along, across) = (factor * (x * cos + y * sin), y * cos - x * sin);
        along * along + across * across
    }

    /// The longest wave vector whose squared length is `cut_off` across the lay.
    fn reach(&self, cut_off: f64) -> f64 {
        cut_off.sqrt() / self.elongation.min(1.0)
    }

    /// Components of the directions along the lay and across it on an axis.
    fn components(&self, axis: usize) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        if axis == 0 { [cos, sin] } else { [sin, cos] }
    }

    /// The extent along an axis of a unit length across the lay.
    fn extent(&self, axis: usize) -> f64 {
        let [along, across] = self.components(axis);
        (self.elongation * along).hypot(across)
    }

    /// The factor by which waves may be shorter along an axis than across the lay.
    fn shortening(&self, axis: usize) -> f64 {
        let [along, across] = self.components(axis);
        (along / self.elongation).hypot(across)
    }

    /// Whether waves i and -i along x have equal deviations.
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
    /// Squared wave numbers in rad^2/m^2; `power` gives the amplitude from the squared wave number over that of the roll-off, as
    /// that of a shorter roll-off over it is in `shorter`, with the weight of its amplitudes.
    PowerLaw {
        step: [f64; 2],
        lay: Lay,
        roll_off: f64,
        cut_off: f64,
        power: Power,
        shorter: Option<(f64, f64)>,
    },
    /// Column by column.
    Table(Vec<f64>),
}

impl GridSpectrum {
    /// Of a field with this autocorrelation on a grid of `points`, by lag around the border.
    pub(super) fn from_autocorrelation(points: [usize; 2], correlation: Vec<f64>) -> Self {
        Self { points, kind: Kind::Table(roots(correlation, points, &Silent)) }
    }

    /// Points along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The spectrum of the Gaussian field that a transform of heights turns into a field of this spectrum.
    /// Autocorrelations impossible for a Gaussian field are replaced by the nearest possible ones (Grigoriu 1998). To `progress` it shows
    /// that it goes on.
    pub fn before(&self, map: &Distortion, progress: &dyn Progress) -> Self {
        let goes_on = &Share { progress, units: 0.0 };
        let points = self.points;
        let inverse = map.inverse();
        let mut correlation = synthesise(
            points,
            |j, waves| {
                let mut deviations = vec![0.0; waves.len()];
                self.column(j, &mut deviations);
                let mut total = 0.0;
                if j == 0 {
                    deviations[0] = self.mean_variance().sqrt();
                }
                for (wave, deviation) in waves.iter_mut().zip(&deviations) {
                    *wave = Complex::new(deviation * deviation, 0.0);
                    total += wave.re;
                }
                weight(points, j) * total
            },
            |totals| totals.iter().sum::<f64>().recip(),
            goes_on,
        );
        for_each_row(&mut correlation, points[1], &|_, row| {
            goes_on.advance(0.0);
            row.iter_mut().for_each(|rho| *rho = inverse.of(*rho));
        });
        Self { points, kind: Kind::Table(roots(correlation, points, goes_on)) }
    }

    /// The variance of the wave of zero wave number, up to the factor common to all waves. A map of zero mean lacks it:
    /// its variance is smaller than that of an infinite surface, while differences between neighbours are the same.
    pub fn mean_variance(&self) -> f64 {
        match &self.kind {
            Kind::PowerLaw { .. } => 0.0,
            Kind::Table(table) => table[0] * table[0],
        }
    }

    /// The sum of the variances of all waves, up to the factor common to all.
    pub fn variance(&self) -> f64 {
        let columns = parallel::map(self.columns(), |j| {
            let mut deviations = vec![0.0; self.points[0]];
            self.column(j, &mut deviations);
            let (eights, rest) = deviations.as_chunks::<8>();
            let mut sums = [0.0; 8];
            for part in eights.iter().map(|eight| &eight[..]).chain([rest]) {
                sums.iter_mut().zip(part).for_each(|(sum, deviation)| *sum += deviation * deviation);
            }
            weight(self.points, j) * sums.iter().sum::<f64>()
        });
        self.mean_variance() + columns.iter().sum::<f64>()
    }

    /// Wave numbers along y beyond which there are no waves.
    fn columns(&self) -> usize {
        let all = columns(self.points);
        match &self.kind {
            Kind::PowerLaw { step, lay, cut_off, .. } => {
                all.min((lay.reach(*cut_off) / step[1]) as usize + 1)
            }
            Kind::Table(_) => all,
        }
    }

    /// Writes the standard deviations of the waves with wave number `j` along y, by their wave number along x
    /// (0, 1, ..., -2, -1); of the mean wave zero.
    pub fn column(&self, j: usize, waves: &mut [f64]) {
        match &self.kind {
            Kind::PowerLaw { step, lay, roll_off, cut_off, power, shorter } => {
                let scale = roll_off.recip();
                let y = step[1] * j as f64;
                let amplitude = |x: f64| {
                    let q = lay.squared([x, y], lay.elongation);
                    if q > *cut_off {
                        return 0.0;
                    }
                    let amplitude = power.of((q * scale).max(1.0));
                    match shorter {
                        None => amplitude,
                        Some((from, weight)) => {
                            weight * power.of((q * scale).max(*from)) + (1.0 - weight) * amplitude
                        }
                    }
                };
                let (count, half) = (waves.len(), waves.len() / 2);
                if j >= self.columns() {
                    waves.fill(0.0);
                    return;
                }
                let reach = lay.reach(*cut_off);
                let last = ((reach / step[0]) as usize + 1).min(half);
                if let Some(beyond) = waves.get_mut(last + 1..count - last) {
                    beyond.fill(0.0);
                }
                for (i, wave) in waves[..=last].iter_mut().enumerate() {
                    *wave = amplitude(step[0] * i as f64);
                }
                for mirror in 1..=last.min(count - half - 1) {
                    waves[count - mirror] =
                        if lay.is_mirrored() { waves[mirror] } else { amplitude(-step[0] * mirror as f64) };
                }
            }
            Kind::Table(table) => {
                let count = waves.len();
                waves.copy_from_slice(&table[j * count..(j + 1) * count]);
            }
        }
        if j == 0 {
            waves[0] = 0.0;
        }
    }
}

#[cfg(test)]
mod tests;
