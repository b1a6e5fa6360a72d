//! `[causes]`: why the models differ, over a grid of skewness and bandwidth.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Finite, Length, Pure, Quantity};

/// Why the models differ, over a grid of skewness and bandwidth of generated surfaces.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CausesSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact law: one, for spheres.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// Skewnesses of the surface heights, ascending.
    #[schemars(extend("x-range" = "2 to 32 numbers", "examples" = [[-1.5, 0, 1.5]]))]
    pub skewness: Spanned<Vec<Quantity<Pure, Finite>>>,
    /// Longest over shortest wavelength of the power law, ascending: they set the bandwidth.
    #[schemars(extend("x-range" = "2 to 32 numbers above 1", "examples" = [[2, 8, 32]]))]
    pub wavelengths: Spanned<Vec<Quantity<Pure>>>,
    /// Nominal pressures over E* times the root mean square gradient, ascending.
    #[schemars(extend("x-range" = "1 to 32 numbers", "examples" = [[0.001, 0.01]]))]
    pub loads: Spanned<Vec<Quantity<Pure>>>,
    /// Surfaces of each point of the grid.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [8]))]
    pub realisations: Spanned<Whole>,
    /// Points along each side of a surface.
    #[schemars(extend("x-range" = "64 to 4096", "examples" = [1024]))]
    pub points: Spanned<Whole>,
    /// The shortest wavelength in pixels.
    #[schemars(extend("x-range" = "at least 2", "examples" = [8]))]
    pub cut_off_pixels: Spanned<Quantity<Pure>>,
    /// Hurst exponent.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.8]))]
    pub hurst: Spanned<Quantity<Pure, Finite>>,
    /// Standard deviation of the surface heights.
    #[schemars(extend("examples" = ["0.25 um"]))]
    pub sigma: Quantity<Length>,
    /// Root mean square gradient of the surface.
    #[schemars(extend("examples" = [0.1]))]
    pub gradient: Spanned<Quantity<Pure>>,
}
