//! `[limit]`: convergence of the deterministic to the statistical model as the number of asperities grows.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_contact_framework::input::{Spanned, Whole};

/// Convergence of the sum to the integral: sets of equal radii and Gaussian heights, of growing size.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LimitSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws.
    pub law: Spanned<Laws>,
    /// Radius of every asperity.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the asperity heights.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// Separations, d/sigma.
    #[schemars(extend("examples" = [[0, 1, 2]]))]
    pub separation: LinearSweep,
    /// Numbers of asperities of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [{ "from": 100, "to": 1e6, "points": 9 }]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Random sets of each size.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [100]))]
    pub draws: Spanned<Whole>,
}
