//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::bare::PixelRange;
use asperity_contact_framework::input::heights::HeightsSpec;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Finite, Length, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;

/// How often 95 % intervals cover the truth: windows of random processes, each taken as a measured map.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CoverageSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact law: one, for spheres.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// Points along each side of a window.
    #[schemars(extend("x-range" = "64 to 1024", "examples" = [256]))]
    pub points: Spanned<Whole>,
    /// Distance of the points.
    #[schemars(extend("examples" = ["0.5 um"]))]
    pub pixel: Quantity<Length, PixelRange>,
    /// Standard deviation of the surface heights.
    #[schemars(extend("examples" = ["0.25 um"]))]
    pub sigma: Quantity<Length>,
    /// Hurst exponent of all self-affine spectra.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.8]))]
    pub hurst: Spanned<Quantity<Pure, Finite>>,
    /// Shortest wavelength of all spectra.
    #[schemars(extend("examples" = ["4 um"]))]
    pub cut_off: Spanned<Quantity<Length>>,
    /// Windows of each case.
    #[schemars(extend("x-range" = "8 to 100000", "examples" = [1000]))]
    pub windows: Spanned<Whole>,
    /// Which intervals are claimed.
    #[serde(default)]
    #[schemars(extend("default" = "blocks", "examples" = ["model-based"]))]
    pub intervals: Intervals,
    /// How many of them are also studied under other treatments, as measured maps are.
    #[schemars(extend("x-range" = "0 to 100000", "default" = 0, "examples" = [100]))]
    pub robustness: Option<Spanned<Whole>>,
    /// How many windows of each case are checked for spikes and line offsets, of which they have none.
    #[schemars(extend("x-range" = "0 to 100000", "default" = 0, "examples" = [500]))]
    pub checked: Option<Spanned<Whole>>,
    /// Spikes planted in windows of a case.
    #[schemars(extend("x-default" = "none"))]
    pub spikes: Option<Spanned<SpikesSpec>>,
    /// Random processes by name.
    pub case: Spanned<IndexMap<Spanned<String>, CaseSpec>>,
}

/// What the intervals that are examined rest on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Intervals {
    /// Blocks of a window.
    #[default]
    Blocks,
    /// Surfaces generated with the spectrum and the heights of a window that is too small for blocks.
    ModelBased,
}

/// A random process.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { roll-off, elongation, heights, plateau, patches, against, windows, checked, contacts }"
)]
pub struct CaseSpec {
    /// Longest wavelength of the power law.
    #[schemars(extend("examples" = ["40 um"], "x-range" = "up to the side of a window"))]
    pub roll_off: Spanned<Quantity<Length>>,
    /// Wavelengths along x over those along y, which are the ones given.
    #[schemars(extend("default" = 1, "x-range" = "1e-3 to 1e3", "examples" = [4]))]
    pub elongation: Option<Spanned<Quantity<Pure, Finite>>>,
    /// Distribution to which the heights of the Gaussian field are transformed.
    #[schemars(extend("default" = "gaussian"))]
    pub heights: Option<HeightsSpec>,
    /// A finer Gaussian roughness that truncates the summits, as wear does: the surface is the lower of both.
    #[schemars(extend("x-default" = "none"))]
    pub plateau: Option<Spanned<PlateauSpec>>,
    /// An amplitude that varies from place to place.
    #[schemars(extend("x-default" = "none"))]
    pub patches: Option<Spanned<PatchesSpec>>,
    /// A second rough body, of the process of another case, on which each window lies at several random relative positions.
    #[schemars(extend("x-default" = "none: a smooth flat"))]
    pub against: Option<Spanned<AgainstSpec>>,
    /// Windows of this case.
    #[schemars(extend("x-range" = "8 to 100000", "x-default" = "`windows` of `[coverage]`", "examples" = [3000]))]
    pub windows: Option<Spanned<Whole>>,
    /// Windows of this case that are checked.
    #[schemars(extend("x-range" = "0 to 100000", "x-default" = "`checked` of `[coverage]`", "examples" = [3000]))]
    pub checked: Option<Spanned<Whole>>,
    /// Effective contacts of the sum in the mean of the windows of a pilot map: a load for each.
    #[schemars(extend("x-range" = "1 to 1e6", "examples" = [[30, 100]]))]
    pub contacts: Spanned<LogSweep<Pure>>,
}

/// A second rough body.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { case, shifts }")]
pub struct AgainstSpec {
    /// The case whose process it is.
    #[schemars(extend("examples" = ["short-gaussian"]))]
    pub case: Spanned<String>,
    /// Relative positions of each pair of windows.
    #[schemars(extend("x-range" = "1 to 1000", "examples" = [8]))]
    pub shifts: Spanned<Whole>,
}

/// A finer roughness with a self-affine spectrum of the same Hurst exponent and cut-off.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { sigma, roll-off, height }")]
pub struct PlateauSpec {
    /// Standard deviation of its heights.
    #[schemars(extend("examples" = ["20 nm"]))]
    pub sigma: Quantity<Length>,
    /// Its longest wavelength.
    #[schemars(extend("examples" = ["12 um"]))]
    pub roll_off: Spanned<Quantity<Length>>,
    /// Height of its mean plane above that of the surface that it truncates.
    #[schemars(extend("examples" = ["30 nm"]))]
    pub height: Quantity<Length, Finite>,
}

/// An amplitude exp(c f - c^2) of the heights, f a Gaussian field of unit variance with the autocorrelation exp(-(r/l)^2).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { modulation, length }")]
pub struct PatchesSpec {
    /// Standard deviation c of the logarithm of the amplitude.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.3]))]
    pub modulation: Spanned<Quantity<Pure, Finite>>,
    /// Correlation length l of the amplitude: at most a fifth of the side of a window.
    #[schemars(extend("examples" = ["40 um"]))]
    pub length: Spanned<Quantity<Length>>,
}

/// Spikes of one point, planted in windows that are used for nothing else: each number of them with each height.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { case, counts, deviations, windows }"
)]
pub struct SpikesSpec {
    /// The case whose process the windows are of.
    #[schemars(extend("examples" = ["short"]))]
    pub case: Spanned<String>,
    /// Numbers of spikes in a window.
    #[schemars(extend("x-range" = "each 1 to 10000", "examples" = [[1, 10, 100]]))]
    pub counts: Spanned<Vec<Whole>>,
    /// Heights of the spikes above the medians of the 9 x 9 points around them, in robust standard deviations of such deviations.
    #[schemars(extend("x-range" = "each 1 to 1000", "examples" = [[4, 6, 15]]))]
    pub deviations: Spanned<Vec<Quantity<Pure, Finite>>>,
    /// Windows.
    #[schemars(extend("x-range" = "4 to 100000", "examples" = [40]))]
    pub windows: Spanned<Whole>,
}
