//! `[laws]`: several laws on one asperity and on given surfaces.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::study_plan::{RoughBody, StatisticalSpec};
use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;

/// Several laws on one asperity, and on surfaces under both models: does the law matter more than the summation?
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawsSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, at least two; the others are compared with the first.
    #[schemars(extend("examples" = [["zmc", "hertz", "jackson-green"]]))]
    pub law: Spanned<Laws>,
    /// The asperity on which the laws are shown by themselves.
    #[schemars(extend("examples" = [{ "radius": "20 um" }]))]
    pub asperity: Spanned<AsperitySpec>,
    /// How far it is pressed, over the indentation at which it begins to yield by Zhao, Maietta and Chang.
    #[schemars(extend("examples" = [{ "from": 0.1, "to": 1000, "points": 200 }]))]
    pub indentation: Spanned<LogSweep<Pure>>,
    /// Nominal pressures at which the laws are compared on surfaces.
    #[schemars(extend("examples" = [{ "from": "0.1 MPa", "to": "100 MPa", "points": 31 }]))]
    pub pressure: Spanned<LogSweep<Pressure, NominalPressureRange>>,
    /// Which statistical model runs.
    #[schemars(extend("x-default" = "Gaussian heights, arithmetic mean radius", "examples" = [{ "heights": "own" }]))]
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest differences between the models that do not matter to you; verdicts refer to them.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1, "stiffness": "20 %" }]))]
    pub accept: AcceptSpec,
    /// The surfaces to run on, by name.
    #[schemars(extend("x-default" = "all of the file", "examples" = [["ground"]]))]
    pub surfaces: Option<Vec<Spanned<String>>>,
}

/// One asperity.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table such as { radius = \"20 um\" }, and curvature-ratio for elliptic laws"
)]
pub struct AsperitySpec {
    /// Its radius, 1/(mean curvature).
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// The larger principal curvature over the smaller one; needed by elliptic laws.
    #[schemars(extend("x-range" = "1 to 1e6", "examples" = [2]))]
    pub curvature_ratio: Option<Spanned<Quantity<Pure>>>,
}
