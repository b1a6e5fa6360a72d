//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
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
    pub pixel: Quantity<Length>,
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
    /// Random processes by name.
    pub case: Spanned<IndexMap<Spanned<String>, CaseSpec>>,
}

/// A random process.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { roll-off, heights, contacts }"
)]
pub struct CaseSpec {
    /// Longest wavelength of the power law.
    #[schemars(extend("examples" = ["40 um"], "x-range" = "up to the side of a window"))]
    pub roll_off: Spanned<Quantity<Length>>,
    /// Distribution to which the heights of the Gaussian field are transformed.
    #[schemars(extend("default" = "gaussian"))]
    pub heights: Option<HeightsSpec>,
    /// Effective contacts of the sum in the mean of the windows of a pilot map: a load for each.
    #[schemars(extend("x-range" = "1 to 1e6", "examples" = [[30, 100]]))]
    pub contacts: Spanned<LogSweep<Pure>>,
}
