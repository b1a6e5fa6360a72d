//! `[limit]`: the deterministic model against the statistical one, to which it converges as the
//! number of asperities grows.

use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_framework::input::sweep::{LinearSweep, LogSweep};

/// A population of equal radii and Gaussian heights, in sets of growing size.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LimitSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<String>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// The laws to run.
    pub law: Spanned<Laws>,
    /// Radius of every asperity.
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights.
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    pub density: Quantity<ArealNumberDensity>,
    /// d/sigma.
    pub separation: LinearSweep,
    /// Sizes of the sets.
    pub count: Spanned<LogSweep<Pure>>,
    /// Sets drawn at random of each size.
    pub draws: Spanned<Whole>,
}
