//! `[solver-validation]`: what the boundary element solver is compared with, and how finely.

use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::quantity::{Pure, Quantity};
use asperity_framework::input::sweep::LogSweep;

/// Problems; those that are left out are not run.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SolverSpec {
    /// A paraboloid on a half-space.
    pub hertz: Option<HertzSpec>,
    /// A wave, in partial and in full contact.
    pub sinusoid: Option<SinusoidSpec>,
    /// Spheres on a bonded layer.
    pub layered_sphere: Option<LayeredSpec>,
    /// The published ensemble.
    pub ensemble: Option<EnsembleSpec>,
    /// Steps and convolutions.
    pub work: Option<WorkSpec>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { pixels }")]
pub struct HertzSpec {
    /// Pixels per contact radius.
    pub pixels: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { points, pressure }")]
pub struct SinusoidSpec {
    /// Points per wavelength.
    pub points: Spanned<LogSweep<Pure>>,
    /// Mean pressure over that which closes the gap.
    pub pressure: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { pixels }")]
pub struct LayeredSpec {
    /// Pixels per contact radius.
    pub pixels: Spanned<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { points, realisations, pressure, error }")]
pub struct EnsembleSpec {
    /// Points along a side.
    pub points: Spanned<LogSweep<Pure>>,
    /// Surfaces.
    pub realisations: Spanned<Whole>,
    /// p/E*.
    pub pressure: Spanned<LogSweep<Pure>>,
    /// Relative dual gap.
    pub error: Spanned<Quantity<Pure>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { points, pressure, error }")]
pub struct WorkSpec {
    /// Points along a side.
    pub points: Spanned<LogSweep<Pure>>,
    /// p/(E* g).
    pub pressure: Spanned<LogSweep<Pure>>,
    /// Relative dual gap.
    pub error: Spanned<Quantity<Pure>>,
}
