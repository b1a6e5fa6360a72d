//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;

use crate::study_plan::{RoughBody, StatisticalSpec};

/// The same surfaces at growing sampling intervals and under growing S filters: which results have a limit?
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SamplingIntervalSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact law: one.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// Nominal pressures at which both models run.
    #[schemars(extend("examples" = [{ "from": "0.1 MPa", "to": "100 MPa", "points": 31 }]))]
    pub pressure: Spanned<LogSweep<Pressure, NominalPressureRange>>,
    /// Sampling intervals in pixels, ascending.
    #[schemars(extend("x-range" = "3 to 32 numbers, from 1", "default" = [1, 2, 4, 8], "examples" = [[1, 2, 3, 4]]))]
    pub intervals: Option<Spanned<Vec<Whole>>>,
    /// Nesting indices of S filters in multiples of `nesting-index`, ascending; none of an empty list.
    #[schemars(extend("x-range" = "3 to 32 numbers", "default" = [1, 2, 4, 8], "examples" = [[1, 1.5, 2]]))]
    pub s_filter: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// The nesting index that `s-filter` multiplies.
    #[schemars(extend("x-default" = "five pixels", "examples" = ["2.5 um"]))]
    pub nesting_index: Option<Spanned<Quantity<Length>>>,
    /// Which statistical model runs.
    #[schemars(extend("x-default" = "Gaussian heights, arithmetic mean radius", "examples" = [{ "heights": "own" }]))]
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest changes of the difference between the models that do not matter to you.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1, "stiffness": "20 %" }]))]
    pub accept: AcceptSpec,
    /// The surfaces to run on, by name.
    #[schemars(extend("x-default" = "all of the file", "examples" = [["ground"]]))]
    pub surfaces: Option<Vec<Spanned<String>>>,
}
