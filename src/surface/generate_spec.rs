//! `[surface.NAME.generate]`: a random rough surface.

use asperity::topography::generate::{SigmaOf, SpectrumOf};
use asperity::topography::summits::Neighbours;
use asperity_contact_framework::input::bare::SigmaRange;
use asperity_contact_framework::input::heights::HeightsSpec;
use asperity_contact_framework::input::quantity::{
    Angle, ArealNumberDensity, Finite, Length, Pure, Quantity,
};
use asperity_contact_framework::input::{OneOrMany, Spanned, Whole, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::Deserializer;
use serde_json::json;

use crate::surface::spec::PixelSpec;

/// A random rough surface: either pixel, sigma and the lengths of its spectrum, or what its summits shall be.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table with points, spectrum, and either pixel and sigma or summits"
)]
pub struct GenerateSpec {
    /// Points along both axes, or along x and along y.
    #[schemars(extend("x-range" = "8 to 1048576", "examples" = [1024, [1024, 512]]))]
    pub points: Spanned<PointsSpec>,
    /// Distance of the points; not with `summits`.
    #[schemars(extend("examples" = ["0.5 um"]))]
    pub pixel: Option<Spanned<PixelSpec>>,
    /// Standard deviation of the surface heights; not with `summits`.
    #[schemars(extend("examples" = ["0.25 um"]))]
    pub sigma: Option<Spanned<Quantity<Length, SigmaRange>>>,
    /// How the variance is spread over the wavelengths.
    #[schemars(extend("examples" = [{ "self-affine": { "hurst": 0.8, "roll-off": "40 um", "cut-off": "4 um" } }]))]
    pub spectrum: Spanned<SpectrumSpec>,
    /// Distribution of the surface heights.
    #[schemars(extend("default" = "gaussian", "examples" = [{ "johnson": { "skewness": -1, "kurtosis": 4.5 } }]))]
    pub heights: Option<HeightsSpec>,
    /// Which field has the spectrum, where heights are transformed; not with `summits`.
    #[schemars(extend("default" = "heights", "examples" = ["gaussian"]))]
    pub spectrum_of: Option<Spanned<SpectrumOf>>,
    /// A finer process that cuts the summits off, as in plateau honing; not with `summits`.
    #[schemars(extend("x-default" = "none", "examples" = [{ "sigma": "0.05 um", "height": "0.2 um", "spectrum": { "gaussian": { "correlation-length": "5 um" } } }]))]
    pub plateau: Option<Spanned<PlateauSpec>>,
    /// What the summits found on the surface shall have; pixel and wavelengths follow.
    #[schemars(extend("x-default" = "none", "examples" = [{ "radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2" }]))]
    pub summits: Option<Spanned<TargetSpec>>,
    /// Which neighbours a summit is higher than.
    #[serde(default)]
    #[schemars(extend("default" = "four", "examples" = ["eight"]))]
    pub neighbours: Neighbours,
    /// How many surfaces are generated; their scatter gives the intervals.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 1, "examples" = [8]))]
    pub realisations: Option<Spanned<Whole>>,
}

/// The numbers that a surface and its found summits shall have.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { radius, sigma, density, heights }")]
pub struct TargetSpec {
    /// Arithmetic mean of the radii of the summits.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights of the summits, or of the surface.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length, SigmaRange>,
    /// Summits per area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// Whose standard deviation sigma is, and whose mean separations are measured from.
    #[serde(default)]
    #[schemars(extend("default" = "summits", "examples" = ["surface"]))]
    pub heights: SigmaOf,
}

/// A process that cuts the summits off.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { sigma, spectrum, height }")]
pub struct PlateauSpec {
    /// Standard deviation of its heights.
    #[schemars(extend("examples" = ["0.05 um"]))]
    pub sigma: Quantity<Length, SigmaRange>,
    /// Its spectrum.
    #[schemars(extend("x-type" = "a table as `spectrum` of the surface", "examples" = [{ "gaussian": { "correlation-length": "5 um" } }]))]
    pub spectrum: Spanned<SpectrumSpec>,
    /// Height of its mean plane above that of the surface that it cuts.
    #[schemars(extend("examples" = ["0.2 um"]))]
    pub height: Quantity<Length, Finite>,
}

/// A spectrum: a table with its name as the only key.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpectrumSpec {
    /// A power law between two wavelengths, constant above the longer one.
    SelfAffine(SelfAffineSpec),
    /// The autocorrelation exp(-(r/l)^2), l the correlation length.
    Gaussian(CorrelationSpec),
    /// The autocorrelation exp(-r/l).
    Exponential(CorrelationSpec),
}

/// A self-affine spectrum; with `summits` its wavelengths are found and only `cut-off-pixels` may be given.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { hurst, roll-off, cut-off }")]
pub struct SelfAffineSpec {
    /// Hurst exponent.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.8]))]
    pub hurst: Quantity<Pure, Finite>,
    /// Longest wavelength of the power law; not with `summits`.
    #[schemars(extend("examples" = ["40 um"]))]
    pub roll_off: Option<Quantity<Length>>,
    /// Shortest wavelength; not with `summits`.
    #[schemars(extend("examples" = ["4 um"]))]
    pub cut_off: Option<Quantity<Length>>,
    /// Shortest wavelength in pixels; only with `summits`.
    #[schemars(extend("default" = 8, "x-range" = "at least 2", "examples" = [8]))]
    pub cut_off_pixels: Option<Quantity<Pure, Finite>>,
    /// Lengths along the lay over those across it.
    #[schemars(extend("default" = 1, "examples" = [4]))]
    pub elongation: Option<Quantity<Pure, Finite>>,
    /// From the x axis to the lay; only with a lay.
    #[schemars(extend("default" = 0, "x-range" = "up to a full turn", "examples" = ["30 deg"]))]
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One correlation length, or one along the lay and one across it.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { correlation-length }")]
pub struct CorrelationSpec {
    /// One correlation length, or one along the lay and one across it.
    #[schemars(extend("x-type" = "length, or a list of two: along the lay and across it", "examples" = ["20 um", ["20 um", "5 um"]]))]
    pub correlation_length: PixelSpec,
    /// From the x axis to the lay; only with a lay.
    #[schemars(extend("default" = 0, "x-range" = "up to a full turn", "examples" = ["30 deg"]))]
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One number of points, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PointsSpec(pub [u64; 2]);

written_schema!(PointsSpec, |_| schema::one_or_many(
    json!({ "type": "integer", "minimum": 1 }),
    "whole number, or a list of two: along x and along y"
));

impl<'de> Deserialize<'de> for PointsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number of points such as 1024, or a list of two: along x and along y";
        let counts = OneOrMany::<Whole>::read(deserializer, expected)?.along_both("numbers")?;
        Ok(Self(counts.map(|count| count.0)))
    }
}
