//! `[causes]`: both models over a grid of generated surfaces.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::{NominalPressureRange, SigmaRange};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Finite, Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;

use crate::kind::compare::reference::ReferenceSpec;
use crate::kind::compare::spec::Models;
use crate::study_plan::RoughBody;
use crate::surface::TargetSpec;

/// Why the models differ, and with a reference which is nearer, over a grid of generated surfaces: of skewness and bandwidth, or with
/// `summits` of skewness and kurtosis.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CausesSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, for spheres.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// What runs: the integral and the sum, and the boundary elements of the reference.
    #[schemars(extend("default" = ["statistical", "deterministic"], "examples" = [["statistical", "deterministic", "reference"]]))]
    pub models: Option<Spanned<Models>>,
    /// How the boundary elements run; only with `"reference"` among the models.
    #[schemars(extend("x-default" = "those of [compare]", "examples" = [{ "error": 1e-6 }]))]
    pub reference: Option<Spanned<ReferenceSpec>>,
    /// The largest differences between the models that do not matter to you.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1 }]))]
    pub accept: AcceptSpec,
    /// Skewnesses of the surface heights, ascending.
    #[schemars(extend("x-range" = "2 to 32 numbers", "examples" = [[-1.5, 0, 1.5]]))]
    pub skewness: Spanned<Vec<Quantity<Pure, Finite>>>,
    /// Longest over shortest wavelength of the power law, ascending: they set the bandwidth. Not with `summits`.
    #[schemars(extend("x-default" = "none: `kurtosis` is the other axis", "x-range" = "2 to 32 numbers above 1", "examples" = [[2, 8, 32]]))]
    pub wavelengths: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Kurtoses of the surface heights, ascending; only with `summits`.
    #[schemars(extend("x-default" = "that of a gamma distribution of the skewness", "x-range" = "2 to 32 numbers", "examples" = [[3, 4.5, 6]]))]
    pub kurtosis: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Nominal pressures over E* times the root mean square gradient, ascending; not with `summits`.
    #[schemars(extend("x-default" = "none: by `pressure`", "x-range" = "1 to 32 numbers", "examples" = [[0.001, 0.01]]))]
    pub loads: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Nominal pressures, with `summits`.
    #[schemars(extend("x-default" = "none: by `loads`", "examples" = [["0.8 MPa", "2 MPa"]]))]
    pub pressure: Option<Spanned<LogSweep<Pressure, NominalPressureRange>>>,
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
    /// Standard deviation of the surface heights; not with `summits`.
    #[schemars(extend("x-default" = "none: by `summits`", "examples" = ["0.25 um"]))]
    pub sigma: Option<Spanned<Quantity<Length, SigmaRange>>>,
    /// Root mean square gradient of the surface; not with `summits`.
    #[schemars(extend("x-default" = "none: by `summits`", "examples" = [0.1]))]
    pub gradient: Option<Spanned<Quantity<Pure>>>,
    /// What the summits found on every surface shall have; the bandwidth follows.
    #[schemars(extend("x-default" = "none: by `sigma`, `gradient` and `wavelengths`", "examples" = [{ "radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2" }]))]
    pub summits: Option<Spanned<TargetSpec>>,
}
