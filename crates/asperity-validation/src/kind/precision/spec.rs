//! `[precision]`: run time against error of integrals, sums, surfaces and boundary elements.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};

/// Run time against error of integrals, sums, surfaces and boundary elements.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PrecisionSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<String>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact law: one, for spheres.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// Populations of Gaussian heights, by name.
    pub case: Spanned<IndexMap<Spanned<String>, CaseSpec>>,
    /// Quadrature rules, by order and by tolerance.
    pub integral: Option<IntegralSpec>,
    /// Summation methods, by number of asperities.
    pub sum: Option<SumSpec>,
    /// Random maps, by pixel and side.
    pub surface: Option<SurfaceSpec>,
    /// Boundary elements on Hertz's contact, by pixel.
    pub reference: Option<ReferenceSpec>,
}

/// A population by its three numbers.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { radius, sigma, density }")]
pub struct CaseSpec {
    /// Radius of every asperity.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { separation }")]
pub struct IntegralSpec {
    /// Separations, d/sigma.
    #[schemars(extend("x-range" = "-10 to 35", "examples" = [[-1, 0, 1, 2, 3, 4]]))]
    pub separation: Spanned<LinearSweep>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { count, huge-count }")]
pub struct SumSpec {
    /// Sizes of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [[1000, 1e6]]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Further sizes, only with --huge.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [1e9]))]
    pub huge_count: Option<Spanned<LogSweep<Pure>>>,
}

/// Random maps with the autocorrelation exp(-(r/l)^2).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { points-per-length, lengths, realisations }"
)]
pub struct SurfaceSpec {
    /// Points per correlation length.
    #[schemars(extend("x-range" = "from 1", "examples" = [[2, 4, 8]]))]
    pub points_per_length: Spanned<LogSweep<Pure>>,
    /// Sides of the maps in correlation lengths.
    #[schemars(extend("x-range" = "from 10", "examples" = [[32, 64]]))]
    pub lengths: Spanned<LogSweep<Pure>>,
    /// Maps of each size.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [8]))]
    pub realisations: Spanned<Whole>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { pixels }")]
pub struct ReferenceSpec {
    /// Pixels per contact radius.
    #[schemars(extend("x-range" = "4 to 400", "examples" = [[8, 16, 32]]))]
    pub pixels: Spanned<LogSweep<Pure>>,
}
