//! `[causes]` resolved: the random process of each point of the grid.

use std::fmt;

use asperity::distribution::Johnson;
use asperity::study::LawContact;
use asperity::topography::generate::{Process, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::{Flat, Heights, reduced_modulus};
use asperity_contact_framework::contact::Bodies;
use asperity_contact_framework::input::quantity::Quantity;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

use super::spec::CausesSpec;

/// Points along a side.
const POINTS: [u64; 2] = [64, 4096];
/// At least two give a scatter.
const REALISATIONS: [u64; 2] = [2, 1000];
/// Values along an axis of the grid, and loads.
const MOST: usize = 32;

/// Surfaces of several skewnesses and bandwidths, the same in all else.
pub struct CausesPlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    /// The law.
    pub law: LawContact,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// What they are multiples of: E* times the gradient, Pa.
    pub unit: f64,
    /// Surfaces of each point.
    pub realisations: usize,
    /// Standard deviation of the surface heights, m.
    pub sigma: f64,
    /// Root mean square gradient.
    pub gradient: f64,
    /// Hurst exponent.
    pub hurst: f64,
    /// Row by row of equal wavelengths, by skewness.
    pub points: Vec<PointPlan>,
}

/// A point of the grid.
pub struct PointPlan {
    /// Skewness of the surface heights.
    pub skewness: f64,
    /// Longest over shortest wavelength.
    pub wavelengths: f64,
    /// The surfaces.
    pub generator: SurfaceGenerator,
}

impl PointPlan {
    /// Kurtosis of the surface heights.
    pub fn kurtosis(&self) -> f64 {
        kurtosis(self.skewness)
    }
}

/// That of a gamma distribution of this skewness: 3 if Gaussian.
fn kurtosis(skewness: f64) -> f64 {
    3.0 + 1.5 * skewness * skewness
}

impl fmt::Display for CausesPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Bodies { rough, flat } = &self.bodies;
        writeln!(f, "  {rough} on {flat}, law {}", self.law.label)?;
        writeln!(
            f,
            "  {} surfaces of {} skewnesses and bandwidths, {} loads",
            self.points.len() * self.realisations,
            self.points.len(),
            self.loads.len()
        )
    }
}

/// Reads `[causes]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<CausesSpec>) -> Result<CausesPlan, InputError> {
    let raw = table.get_ref();
    let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
    let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
    let laws = &raw.law.get_ref().0;
    if laws.len() != 1 {
        let message = format!("found {} laws; allowed: one", laws.len());
        return Err(file.source.error_at(raw.law.span(), message));
    }
    file.spheres_only(&raw.law, "the asperities of [causes] are taken as spheres")?;
    file.check_laws(&raw.law, (rough, &pair[0]), &[(flat, &pair[1])])?;
    let flats = [(None, Flat::Bare(pair[1]))];
    let law = file.law_plans(&raw.law, (rough, &pair[0]), &flats, flat)?.remove(0);
    let points = file.whole_within(&raw.points, POINTS, "points")? as usize;
    let realisations = file.whole_within(&raw.realisations, REALISATIONS, "realisations")? as usize;
    let skewnesses = ascending(file, &raw.skewness, Quantity::value, 2)?;
    let wavelengths = ascending(file, &raw.wavelengths, Quantity::value, 2)?;
    let loads = ascending(file, &raw.loads, Quantity::value, 1)?;
    let unit = reduced_modulus(&pair[0], &pair[1]) * raw.gradient.get_ref().value();
    let mut all = Vec::new();
    for &wavelengths in &wavelengths {
        for &skewness in &skewnesses {
            let generator = generator(file, raw, points, skewness, wavelengths)?;
            all.push(PointPlan { skewness, wavelengths, generator });
        }
    }
    Ok(CausesPlan {
        bodies: Bodies { rough: rough.clone(), flat: flat.clone() },
        law,
        loads: loads.into_iter().map(|load| load * unit).collect(),
        unit,
        realisations,
        sigma: raw.sigma.value(),
        gradient: raw.gradient.get_ref().value(),
        hurst: raw.hurst.get_ref().value(),
        points: all,
    })
}

/// The surfaces of a point: their pixel is the one at which a self-affine surface has the gradient.
fn generator(
    file: &SpecFile,
    raw: &CausesSpec,
    points: usize,
    skewness: f64,
    wavelengths: f64,
) -> Result<SurfaceGenerator, InputError> {
    let (hurst, pixels) = (raw.hurst.get_ref().value(), raw.cut_off_pixels.get_ref().value());
    if wavelengths * pixels > points as f64 {
        let message = format!(
            "found {wavelengths} times the shortest wavelength of {pixels} pixels; allowed: at most the side of a surface, {points} pixels"
        );
        return Err(file.source.error_at(raw.wavelengths.span(), message));
    }
    let heights = if skewness == 0.0 {
        Heights::GAUSSIAN
    } else {
        let johnson = Johnson::from_moments(skewness, kurtosis(skewness));
        Heights::new(johnson.map_err(|error| file.source.error_at(raw.skewness.span(), error))?)
    };
    let sigma = raw.sigma.value();
    let pixel = sigma * gradient(hurst, wavelengths, pixels) / raw.gradient.get_ref().value();
    let cut_off = pixels * pixel;
    let shape = SpectrumShape::SelfAffine { hurst, roll_off: wavelengths * cut_off, cut_off };
    let generator = Spectrum::new(shape, Lay::default()).and_then(|spectrum| {
        let process = Process { spectrum, of: SpectrumOf::Heights, sigma, heights };
        let generator = SurfaceGenerator { points: [points; 2], pixel: [pixel; 2], process, plateau: None };
        generator.check().map(|()| generator)
    });
    generator.map_err(|error| {
        let span = match error {
            SpectrumError::Hurst(_) => raw.hurst.span(),
            SpectrumError::BelowPixel { .. } => raw.cut_off_pixels.span(),
            _ => raw.wavelengths.span(),
        };
        file.source.error_at(span, error)
    })
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

fn ascending<T>(
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
    use super::*;
    use asperity::topography::RoughnessParameters;
    use asperity::topography::generate::Seeds;

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
