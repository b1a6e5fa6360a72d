//! `[solver-validation]`: what the boundary element solver is compared with, and how finely.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::quantity::{Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;

/// Boundary elements against known solutions; problems that are left out are not run.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SolverSpec {
    /// A paraboloid on a half-space (Hertz).
    pub hertz: Option<HertzSpec>,
    /// A wavy surface, in partial and in full contact.
    pub sinusoid: Option<SinusoidSpec>,
    /// Spheres on a bonded layer.
    pub layered_sphere: Option<LayeredSpec>,
    /// A published ensemble of rough surfaces.
    pub ensemble: Option<EnsembleSpec>,
    /// Errors by the grid against the bounds that the reference states.
    pub grid: Option<GridSpec>,
    /// Iterations and convolutions per load.
    pub work: Option<WorkSpec>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { pixels }")]
pub struct HertzSpec {
    /// Pixels per contact radius.
    #[schemars(extend("examples" = [[8, 16, 32]], "x-range" = "4 to 400"))]
    pub pixels: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { points, pressure }")]
pub struct SinusoidSpec {
    /// Points per wavelength.
    #[schemars(extend("x-range" = "8 to 16384", "examples" = [[64, 128]]))]
    pub points: Spanned<LogSweep<Pure>>,
    /// Mean pressure over that which closes the gap.
    #[schemars(extend("x-range" = "1e-4 to 0.9999", "examples" = [[0.1, 0.5]]))]
    pub pressure: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { pixels }")]
pub struct LayeredSpec {
    /// Pixels per contact radius.
    #[schemars(extend("examples" = [16], "x-range" = "4 to 400"))]
    pub pixels: Spanned<Whole>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { points, realisations, pressure, error }")]
pub struct EnsembleSpec {
    /// Points along a side.
    #[schemars(extend("x-range" = "64 to 8192", "examples" = [[256, 512]]))]
    pub points: Spanned<LogSweep<Pure>>,
    /// Surfaces.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [8]))]
    pub realisations: Spanned<Whole>,
    /// Nominal pressures over E*.
    #[schemars(extend("x-range" = "1e-6 to 10", "examples" = [[0.001, 0.01]]))]
    pub pressure: Spanned<LogSweep<Pure>>,
    /// Relative dual gap at which an iteration ends.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "examples" = [1e-6]))]
    pub error: Spanned<Quantity<Pure>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { points, realisations, pressure, error }")]
pub struct GridSpec {
    /// Points along a side of the fine grid, a multiple of 32; there are 32 in the shortest wave.
    #[schemars(extend("x-range" = "256 to 8192", "examples" = [1024]))]
    pub points: Spanned<Whole>,
    /// Surfaces of each case.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [8]))]
    pub realisations: Spanned<Whole>,
    /// Nominal pressures over E* times the root mean square gradient; below 0.2, the cap of one of the cases.
    #[schemars(extend("x-range" = "1e-6 to 0.19", "examples" = [[0.002, 0.02]]))]
    pub pressure: Spanned<LogSweep<Pure>>,
    /// Relative dual gap at which an iteration ends.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "examples" = [1e-6]))]
    pub error: Spanned<Quantity<Pure>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { points, pressure, error }")]
pub struct WorkSpec {
    /// Points along a side.
    #[schemars(extend("x-range" = "64 to 8192", "examples" = [[256, 512]]))]
    pub points: Spanned<LogSweep<Pure>>,
    /// Nominal pressures over E* times the root mean square gradient.
    #[schemars(extend("x-range" = "1e-6 to 10", "examples" = [[0.001, 0.01]]))]
    pub pressure: Spanned<LogSweep<Pure>>,
    /// Relative dual gap at which an iteration ends.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "examples" = [1e-6]))]
    pub error: Spanned<Quantity<Pure>>,
}
