//! `[tiled]`: both models on a surface that may be larger than a machine.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::sweep::LinearSweep;

use crate::layer::LayerSpec;
use crate::study_plan::RoughBody;

/// Both models on one surface that may be larger than memory: it is summed tile by tile, in one process or on many machines (docs/clusters.md).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TiledSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, of spheres.
    pub law: Spanned<Laws>,
    /// A layer on the flat or on the rough body, of one thickness or several.
    #[schemars(extend("x-default" = "none: both bodies are bare", "examples" = [{ "material": "lead", "thickness": [0, "50 nm", "1 um", "inf"] }]))]
    pub layer: Option<LayerSpec>,
    /// Separations at which the sum runs, d/sigma from the mean asperity height; the integral runs there and at the pressures of the sum.
    pub separation: Spanned<LinearSweep>,
    /// The surface, by name.
    #[schemars(extend("x-default" = "the only one of the file", "examples" = ["ground"]))]
    pub surface: Option<Spanned<String>>,
}
