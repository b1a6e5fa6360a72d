//! `[causes]`: why the models differ, over a grid of skewness and bandwidth.

use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Finite, Length, Pure, Quantity};

/// Two bodies, a law, and the generated surfaces of the grid.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CausesSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<String>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// One law for spheres.
    pub law: Spanned<Laws>,
    /// Skewnesses of the surface heights, ascending.
    pub skewness: Spanned<Vec<Quantity<Pure, Finite>>>,
    /// Longest over shortest wavelength of the power law, ascending: they set the bandwidth.
    pub wavelengths: Spanned<Vec<Quantity<Pure>>>,
    /// Nominal pressures over E* and the root mean square gradient, ascending.
    pub loads: Spanned<Vec<Quantity<Pure>>>,
    /// Surfaces of each point of the grid.
    pub realisations: Spanned<Whole>,
    /// Points along each side of a surface.
    pub points: Spanned<Whole>,
    /// The shortest wavelength in pixels.
    pub cut_off_pixels: Spanned<Quantity<Pure>>,
    /// Hurst exponent.
    pub hurst: Spanned<Quantity<Pure, Finite>>,
    /// Standard deviation of the surface heights.
    pub sigma: Quantity<Length>,
    /// Root mean square gradient of the surface.
    pub gradient: Spanned<Quantity<Pure>>,
}
