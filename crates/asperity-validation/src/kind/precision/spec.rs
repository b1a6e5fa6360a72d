//! `[precision]`: run time against error of integrals, sums and surfaces.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;

use asperity_framework::input::Spanned;
use asperity_framework::input::Whole;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_framework::input::sweep::{LinearSweep, LogSweep};

/// Run time against error of integrals, sums and surfaces.
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
    /// Quadrature rules: time against error.
    pub integral: Option<IntegralSpec>,
    /// Summation methods: time against error.
    pub sum: Option<SumSpec>,
    /// Curves of many separations within a tolerance.
    pub curve: Option<CurveSpec>,
    /// Lists of asperities read from files.
    pub list: Option<ListsSpec>,
    /// The difference between the models divided among its causes.
    pub attribution: Option<AttributionSpec>,
    /// Random sets of growing size: sampling error against time.
    pub sampling: Option<SamplingSpec>,
    /// Random maps of growing size and fineness.
    pub grid: Option<GridSpec>,
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
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { count, full-count, separations, threads }"
)]
pub struct SumSpec {
    /// Sizes of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [[1000, 1e6]]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Further sizes, only with --full.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [1e9]))]
    pub full_count: Option<Spanned<LogSweep<Pure>>>,
    /// Numbers of separations.
    #[schemars(extend("x-range" = "1 to 100000", "examples" = [[1, 10, 100]]))]
    pub separations: Spanned<LogSweep<Pure>>,
    /// Numbers of threads.
    #[schemars(extend("x-range" = "1 to 1024", "examples" = [[1, 2]]))]
    pub threads: Spanned<LogSweep<Pure>>,
}

/// Curves within a tolerance.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { asperities, separations, tolerance }")]
pub struct CurveSpec {
    /// Asperities in the set that is summed.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [1000000]))]
    pub asperities: Spanned<Whole>,
    /// Separations of the curve.
    #[schemars(extend("x-range" = "2 to 100000", "examples" = [20000]))]
    pub separations: Spanned<Whole>,
    /// Relative tolerances.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "examples" = [[0.002, 0.01]]))]
    pub tolerance: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { count, full-count, separations }"
)]
pub struct ListsSpec {
    /// Lengths of the lists.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [[1000, 1e6]]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Further lengths, only with --full.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [1e8]))]
    pub full_count: Option<Spanned<LogSweep<Pure>>>,
    /// Separations at which each is summed.
    #[schemars(extend("x-range" = "1 to 100000", "examples" = [50]))]
    pub separations: Spanned<Whole>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { count, loads }")]
pub struct AttributionSpec {
    /// Sizes of the sets.
    #[schemars(extend("x-range" = "2000 to 1e12", "examples" = [1000000]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Loads at which each difference is divided.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [25]))]
    pub loads: Spanned<Whole>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { separation, count, draws }")]
pub struct SamplingSpec {
    /// Separations, d/sigma.
    #[schemars(extend("examples" = [[0, 1, 2]]))]
    pub separation: LinearSweep,
    /// Sizes of the sets.
    #[schemars(extend("x-range" = "1 to 1e12", "examples" = [[1000, 1e6]]))]
    pub count: Spanned<LogSweep<Pure>>,
    /// Random sets of each size.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [20]))]
    pub draws: Spanned<Whole>,
}

/// Random maps with the autocorrelation exp(-(r/l)^2).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { points-per-length, lengths, realisations }"
)]
pub struct GridSpec {
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
