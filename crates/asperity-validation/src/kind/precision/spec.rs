//! `[precision]`: run time against error of integrals, sums and surfaces.

use indexmap::IndexMap;
use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{ArealNumberDensity, Length, Pure, Quantity};
use asperity_framework::input::sweep::{LinearSweep, LogSweep};

/// Two bodies, a law, populations, and what is measured of them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PrecisionSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<String>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// One law for spheres.
    pub law: Spanned<Laws>,
    /// Populations of Gaussian heights, by name.
    pub case: Spanned<IndexMap<Spanned<String>, CaseSpec>>,
    /// Rules of quadrature.
    pub integral: Option<IntegralSpec>,
    /// Summation methods.
    pub sum: Option<SumSpec>,
    /// Curves of many separations.
    pub curve: Option<CurveSpec>,
    /// Lists of asperities in files.
    pub list: Option<ListsSpec>,
    /// The difference between the models divided among its causes.
    pub attribution: Option<AttributionSpec>,
    /// Random sets of growing size.
    pub sampling: Option<SamplingSpec>,
    /// Random maps of growing size and fineness.
    pub grid: Option<GridSpec>,
}

/// A population by its three numbers.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { radius, sigma, density }")]
pub struct CaseSpec {
    /// Radius of every asperity.
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights.
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    pub density: Quantity<ArealNumberDensity>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { separation }")]
pub struct IntegralSpec {
    /// d/sigma.
    pub separation: Spanned<LinearSweep>,
}

#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { count, full-count, separations, threads }"
)]
pub struct SumSpec {
    /// Sizes of the sets.
    pub count: Spanned<LogSweep<Pure>>,
    /// Sizes that stand in the report only where it is made with --full.
    pub full_count: Option<Spanned<LogSweep<Pure>>>,
    pub separations: Spanned<LogSweep<Pure>>,
    pub threads: Spanned<LogSweep<Pure>>,
}

/// Curves within a tolerance.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { asperities, separations, tolerance }")]
pub struct CurveSpec {
    /// Asperities in the set that is summed.
    pub asperities: Spanned<Whole>,
    /// Separations of the curve.
    pub separations: Spanned<Whole>,
    pub tolerance: Spanned<LogSweep<Pure>>,
}

#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { count, full-count, separations }"
)]
pub struct ListsSpec {
    /// Lengths of the lists.
    pub count: Spanned<LogSweep<Pure>>,
    /// Lengths that stand in the report only where it is made with --full.
    pub full_count: Option<Spanned<LogSweep<Pure>>>,
    /// Separations at which each is summed.
    pub separations: Spanned<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { count, loads }")]
pub struct AttributionSpec {
    /// Sizes of the sets.
    pub count: Spanned<LogSweep<Pure>>,
    /// Loads at which each difference is divided.
    pub loads: Spanned<Whole>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { separation, count, draws }")]
pub struct SamplingSpec {
    /// d/sigma.
    pub separation: LinearSweep,
    /// Sizes of the sets.
    pub count: Spanned<LogSweep<Pure>>,
    /// Sets of each size.
    pub draws: Spanned<Whole>,
}

/// Random maps with the autocorrelation exp(-(r/l)^2).
#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { points-per-length, lengths, realisations }"
)]
pub struct GridSpec {
    /// Points a correlation length.
    pub points_per_length: Spanned<LogSweep<Pure>>,
    /// Sides of the maps in correlation lengths.
    pub lengths: Spanned<LogSweep<Pure>>,
    /// Maps of each kind.
    pub realisations: Spanned<Whole>,
}
