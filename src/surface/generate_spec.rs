//! `[surface.NAME.generate]`: a random rough surface.

use serde::Deserialize;
use serde::de::Deserializer;
use toml::Spanned;

use crate::surface::pixel_spec::PixelSpec;
use asperity::topography::generate::{SigmaOf, SpectrumOf};
use asperity::topography::summits::Neighbours;
use asperity_framework::input::heights::HeightsSpec;
use asperity_framework::input::quantity::{Angle, ArealNumberDensity, Finite, Length, Pure, Quantity};
use asperity_framework::input::{OneOrMany, Whole};

/// A random rough surface: either pixel, sigma and the lengths of its spectrum, or what its summits shall be.
#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table with points, spectrum, and either pixel and sigma or summits"
)]
pub struct GenerateSpec {
    /// Points along x and y.
    pub points: Spanned<PointsSpec>,
    /// Their distances; not with `summits`.
    pub pixel: Option<Spanned<PixelSpec>>,
    /// Standard deviation of the surface heights; not with `summits`.
    pub sigma: Option<Spanned<Quantity<Length>>>,
    /// How the variance is spread over the waves.
    pub spectrum: Spanned<SpectrumSpec>,
    /// Distribution of the heights.
    pub heights: Option<HeightsSpec>,
    /// Whose spectrum it is: not with `summits`, which leave the spectrum open.
    pub spectrum_of: Option<Spanned<SpectrumOf>>,
    /// A finer process that cuts the surface; not with `summits`.
    pub plateau: Option<Spanned<PlateauSpec>>,
    /// What the found summits shall be.
    pub summits: Option<Spanned<TargetSpec>>,
    /// Which neighbours a summit is higher than.
    #[serde(default)]
    pub neighbours: Neighbours,
    /// How many surfaces are made.
    pub realisations: Option<Spanned<Whole>>,
}

/// The numbers that a surface and its found summits shall have.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { radius, sigma, density, heights }")]
pub struct TargetSpec {
    /// Arithmetic mean of the radii.
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights of the summits or of the surface.
    pub sigma: Quantity<Length>,
    /// Summits per area.
    pub density: Quantity<ArealNumberDensity>,
    /// Whose deviation sigma is, and whose mean separations are measured from.
    #[serde(default)]
    pub heights: SigmaOf,
}

/// A process that cuts the summits off.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { sigma, spectrum, height }")]
pub struct PlateauSpec {
    /// Standard deviation of its heights.
    pub sigma: Quantity<Length>,
    pub spectrum: Spanned<SpectrumSpec>,
    /// Height of its mean plane above that of the surface that it cuts.
    pub height: Quantity<Length, Finite>,
}

/// A spectrum: a table with its name as the only key.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpectrumSpec {
    SelfAffine(SelfAffineSpec),
    Gaussian(CorrelationSpec),
    Exponential(CorrelationSpec),
}

/// A self-affine spectrum; with `summits` its wavelengths are found and only `cut-off-pixels` may be given.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { hurst, roll-off, cut-off }")]
pub struct SelfAffineSpec {
    pub hurst: Quantity<Pure, Finite>,
    /// Longest wavelength of the power law.
    pub roll_off: Option<Quantity<Length>>,
    /// Shortest wavelength.
    pub cut_off: Option<Quantity<Length>>,
    /// Shortest wavelength in pixels.
    pub cut_off_pixels: Option<Quantity<Pure, Finite>>,
    /// Lengths along the lay over those across it.
    pub elongation: Option<Quantity<Pure, Finite>>,
    /// From the x axis to the lay.
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One correlation length, or one along the lay and one across it.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { correlation-length }")]
pub struct CorrelationSpec {
    /// Along the lay and across it.
    pub correlation_length: PixelSpec,
    /// From the x axis to the lay.
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One number of points, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PointsSpec(pub [u64; 2]);

impl<'de> Deserialize<'de> for PointsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number of points such as 1024, or a list of two: along x and along y";
        let counts = OneOrMany::<Whole>::read(deserializer, expected)?.along_both("numbers")?;
        Ok(Self(counts.map(|count| count.0)))
    }
}
