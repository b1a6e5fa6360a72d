//! The random process of the surfaces of a grid.

use std::fmt;
use std::ops::Range;

use asperity::Heights;
use asperity::topography::generate::{Process, SpectrumOf, SurfaceGenerator, Target, TargetGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::topography::summits::Neighbours;
use asperity_contact_framework::input::bare::SigmaRange;
use asperity_contact_framework::input::quantity::{Length, Pure, Quantity};
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

use super::{Axis, CausesSpec, PointPlan};
use crate::surface::{TargetSpec, Way};

const POINTS: [u64; 2] = [64, 4096];
/// Values along an axis of the grid, and loads.
const MOST: usize = 32;

/// What all surfaces of a grid have in common.
pub(super) struct GridProcess<'a> {
    points: usize,
    hurst: f64,
    cut_off_pixels: f64,
    scale: Scale<'a>,
}

/// What sets the scales of heights and lengths.
enum Scale<'a> {
    /// Standard deviation (m) and gradient of the surface, and the bandwidths.
    Surface { sigma: f64, gradient: f64, wavelengths: &'a Spanned<Vec<Quantity<Pure>>> },
    /// The summits; the bandwidth follows. The kurtoses.
    Summits { target: &'a Spanned<TargetSpec>, kurtosis: &'a Spanned<Vec<Quantity<Pure>>> },
}

impl<'a> GridProcess<'a> {
    pub(super) fn new(file: &SpecFile, table: &'a Spanned<CausesSpec>) -> Result<Self, InputError> {
        let raw = table.get_ref();
        let value = |length: &Spanned<Quantity<Length, SigmaRange>>| length.get_ref().value();
        let scale = match (&raw.summits, &raw.sigma, &raw.gradient, &raw.wavelengths, &raw.kurtosis) {
            (None, Some(sigma), Some(gradient), Some(wavelengths), None) => {
                Scale::Surface { sigma: value(sigma), gradient: gradient.get_ref().value(), wavelengths }
            }
            (Some(target), None, None, None, Some(kurtosis)) => Scale::Summits { target, kurtosis },
            _ => {
                return Err(file.source.error_at(
                    table.span(),
                    "found another set of keys; allowed: sigma, gradient and wavelengths, or summits and kurtosis",
                ));
            }
        };
        Ok(Self {
            points: file.whole_within(&raw.points, POINTS, "points")? as usize,
            hurst: raw.hurst.get_ref().value(),
            cut_off_pixels: raw.cut_off_pixels.get_ref().value(),
            scale,
        })
    }

    pub(super) fn axis(&self) -> Axis {
        match self.scale {
            Scale::Surface { .. } => Axis::Bandwidth,
            Scale::Summits { .. } => Axis::Kurtosis,
        }
    }

    pub(super) fn gradient(&self) -> Option<f64> {
        match self.scale {
            Scale::Surface { gradient, .. } => Some(gradient),
            Scale::Summits { .. } => None,
        }
    }

    /// Position of what sets the scale in the spec.
    pub(super) fn key(&self) -> Range<usize> {
        match self.scale {
            Scale::Surface { wavelengths, .. } => wavelengths.span(),
            Scale::Summits { target, .. } => target.span(),
        }
    }

    /// The points of the grid, without surfaces.
    pub(super) fn points(&self, file: &SpecFile, raw: &CausesSpec) -> Result<Vec<PointPlan>, InputError> {
        let skewnesses = ascending(file, &raw.skewness, Quantity::value, 2)?;
        let rows = match self.scale {
            Scale::Surface { wavelengths, .. } => {
                let rows = ascending(file, wavelengths, Quantity::value, 2)?;
                self.check_wavelengths(file, wavelengths.span(), &rows)?;
                rows
            }
            Scale::Summits { target, kurtosis } => {
                // What no heights mend is refused; moments that cannot be had leave a point empty.
                self.way(Heights::GAUSSIAN, None)
                    .map_err(|message| file.source.error_at(target.span(), message))?;
                ascending(file, kurtosis, Quantity::value, 2)?
            }
        };
        let point = |row: f64, skewness: f64| {
            let (kurtosis, wavelengths) = match self.axis() {
                // Of a gamma distribution.
                Axis::Bandwidth => (3.0 + 1.5 * skewness * skewness, Some(row)),
                Axis::Kurtosis => (row, None),
            };
            PointPlan { skewness, kurtosis, wavelengths, without_surface: None }
        };
        let each = rows.iter().flat_map(|&row| skewnesses.iter().map(move |&skewness| (row, skewness)));
        Ok(each.map(|(row, skewness)| point(row, skewness)).collect())
    }

    /// Refuses spectra that the grid of points does not hold.
    fn check_wavelengths(&self, file: &SpecFile, key: Range<usize>, rows: &[f64]) -> Result<(), InputError> {
        for &wavelengths in rows {
            if wavelengths * self.cut_off_pixels > self.points as f64 {
                let message = format!(
                    "found {wavelengths} times the shortest wavelength of {} pixels; allowed: at most the side of a surface, {} pixels",
                    self.cut_off_pixels, self.points
                );
                return Err(file.source.error_at(key, message));
            }
            let Scale::Surface { sigma, gradient, .. } = self.scale else { continue };
            let checked = self.generator(sigma, gradient, wavelengths, Heights::GAUSSIAN);
            checked.map_err(|error| file.source.error_at(key.clone(), error))?;
        }
        Ok(())
    }

    /// How surfaces of these heights are made.
    pub(super) fn way(&self, heights: Heights, wavelengths: Option<f64>) -> Result<Way, String> {
        match (&self.scale, wavelengths) {
            (Scale::Surface { sigma, gradient, .. }, Some(wavelengths)) => {
                let generator = self.generator(*sigma, *gradient, wavelengths, heights);
                generator.map(Way::SurfaceGenerator).map_err(|error| error.to_string())
            }
            (Scale::Summits { target, .. }, _) => {
                let target = target.get_ref();
                let generator = TargetGenerator {
                    points: [self.points; 2],
                    hurst: self.hurst,
                    cut_off: self.cut_off_pixels,
                    lay: Lay::default(),
                    heights,
                    neighbours: Neighbours::Four,
                };
                generator.check().map_err(|error| error.to_string())?;
                Ok(Way::Target {
                    generator,
                    target: Target {
                        radius: target.radius.value(),
                        sigma: target.sigma.value(),
                        sigma_of: target.heights,
                        density: target.density.value(),
                    },
                })
            }
            (Scale::Surface { .. }, None) => Err("no bandwidth".to_owned()),
        }
    }

    /// A self-affine surface; its pixel is the one at which it has the gradient.
    fn generator(
        &self,
        sigma: f64,
        slope: f64,
        wavelengths: f64,
        heights: Heights,
    ) -> Result<SurfaceGenerator, SpectrumError> {
        let pixel = sigma * gradient(self.hurst, wavelengths, self.cut_off_pixels) / slope;
        let cut_off = self.cut_off_pixels * pixel;
        let shape = SpectrumShape::SelfAffine { hurst: self.hurst, roll_off: wavelengths * cut_off, cut_off };
        let spectrum = Spectrum::new(shape, Lay::default())?;
        let process = Process { spectrum, of: SpectrumOf::Heights, sigma, heights };
        let points = [self.points; 2];
        let generator = SurfaceGenerator { points, pixel: [pixel; 2], process, plateau: None };
        generator.check().map(|()| generator)
    }
}

impl fmt::Display for GridProcess<'_> {
    /// "2048 points along each side, Hurst exponent 0.8, ...", for a page.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { points, hurst, cut_off_pixels, scale } = self;
        write!(
            f,
            "{points} points along each side, self-affine with the Hurst exponent {hurst} and a shortest wavelength of {cut_off_pixels} pixels"
        )?;
        match scale {
            Scale::Surface { sigma, gradient, .. } => {
                write!(f, ", σ = {sigma:e} m, root mean square gradient {gradient}")
            }
            Scale::Summits { target, .. } => {
                let target = target.get_ref();
                let (radius, sigma) = (target.radius.value(), target.sigma.value());
                write!(
                    f,
                    ", summits of mean radius {radius:e} m, σ = {sigma:e} m and density {:e} /m²",
                    target.density.value()
                )
            }
        }
    }
}

/// Root mean square gradient of a self-affine surface of unit variance with the shortest wavelength given and the longest one
/// `wavelengths` times as long: from the spectrum of Persson et al. (2005, section 2), constant up to the roll-off.
fn gradient(hurst: f64, wavelengths: f64, cut_off: f64) -> f64 {
    // Of x^(power - 1) from 1 to the ratio.
    let integral = |power: f64| {
        let exponent = power * wavelengths.ln();
        if exponent.abs() < 1e-9 { wavelengths.ln() } else { exponent.exp_m1() / power }
    };
    let variance = 0.5 + integral(-2.0 * hurst);
    let square = 0.25 + integral(2.0 - 2.0 * hurst);
    let roll_off = std::f64::consts::TAU / (wavelengths * cut_off);
    roll_off * (square / variance).sqrt()
}

/// Values of an axis or loads, which must ascend.
pub(super) fn ascending<T>(
    file: &SpecFile,
    found: &Spanned<Vec<T>>,
    value: impl Fn(&T) -> f64,
    least: usize,
) -> Result<Vec<f64>, InputError> {
    let values: Vec<f64> = found.get_ref().iter().map(value).collect();
    if (least..=MOST).contains(&values.len()) && values.windows(2).all(|pair| pair[0] < pair[1]) {
        return Ok(values);
    }
    let message = format!("found {values:?}; allowed: {least} to {MOST} ascending values");
    Err(file.source.error_at(found.span(), message))
}

#[cfg(test)]
mod tests {
    use asperity::topography::RoughnessParameters;
    use asperity::topography::generate::Seeds;

    use super::*;

    #[test]
    fn surfaces_have_the_gradient() {
        for (hurst, wavelengths) in [(0.8, 2.0), (0.5, 8.0), (1.0, 8.0)] {
            let cut_off = 16e-6;
            let shape = SpectrumShape::SelfAffine { hurst, roll_off: wavelengths * cut_off, cut_off };
            let spectrum = Spectrum::new(shape, Lay::default()).unwrap();
            let process =
                Process { spectrum, of: SpectrumOf::Heights, sigma: 1e-7, heights: Heights::GAUSSIAN };
            let generator = SurfaceGenerator { points: [1024; 2], pixel: [1e-6; 2], process, plateau: None };
            let map = generator.surface(Seeds { process: [7; 32], plateau: [0; 32] }).unwrap().0;
            let found = RoughnessParameters::new(&map);
            let expected = gradient(hurst, wavelengths, cut_off) * found.moments.sq;
            assert!((found.rms_slope() / expected - 1.0).abs() < 0.03, "{hurst} {wavelengths}");
        }
    }
}
