//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

use indexmap::IndexMap;
use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::heights::HeightsSpec;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Finite, Length, Pure, Quantity};
use asperity_framework::input::sweep::LogSweep;

/// Two bodies, a law, windows, and the random processes that these are seen of.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CoverageSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<String>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// One law for spheres.
    pub law: Spanned<Laws>,
    /// Points along each side of a window.
    pub points: Spanned<Whole>,
    /// Their distance.
    pub pixel: Quantity<Length>,
    /// Standard deviation of the surface heights.
    pub sigma: Quantity<Length>,
    /// Hurst exponent of all self-affine spectra.
    pub hurst: Spanned<Quantity<Pure, Finite>>,
    /// Their shortest wavelength.
    pub cut_off: Spanned<Quantity<Length>>,
    /// Windows of each case.
    pub windows: Spanned<Whole>,
    /// Random processes by name.
    pub case: Spanned<IndexMap<Spanned<String>, CaseSpec>>,
}

/// A random process.
#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { roll-off, heights, contacts }"
)]
pub struct CaseSpec {
    /// Longest wavelength of the power law.
    pub roll_off: Spanned<Quantity<Length>>,
    /// Distribution to which the heights of the Gaussian field with the spectrum are transformed.
    pub heights: Option<HeightsSpec>,
    /// Effective contacts of the sum in the mean of the windows of a pilot map: a load for each.
    pub contacts: Spanned<LogSweep<Pure>>,
}
