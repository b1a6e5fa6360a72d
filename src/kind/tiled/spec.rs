//! `[tiled]`: both models on a surface that may be larger than a machine.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_framework::input::Spanned;
use asperity_framework::input::accept::AcceptSpec;
use asperity_framework::input::law::Laws;
use asperity_framework::input::sweep::LinearSweep;
use asperity_framework::input::tolerance::ToleranceSpec;

use crate::kind::compare::spec::{CompareSpec, RoughBody};
use crate::layer::LayerSpec;

/// Both models on one surface that may be larger than memory: it is summed tile by tile, in one process or in parts on many machines (docs/clusters.md).
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
    /// A layer on the flat, of one thickness or several.
    #[schemars(extend("x-default" = "none: the flat is bare", "examples" = [{ "material": "lead", "thickness": [0, "50 nm", "1 um", "inf"] }]))]
    pub layer: Option<LayerSpec>,
    /// Separations at which the sum runs, d/sigma from the mean asperity height; the integral runs there and at the pressures of the sum.
    pub separation: Spanned<LinearSweep>,
    /// The surface, by name.
    #[schemars(extend("x-default" = "the only one of the file", "examples" = ["ground"]))]
    pub surface: Option<Spanned<String>>,
}

impl TiledSpec {
    /// Both models at the separations, as a `[compare]` table.
    pub fn compared(&self) -> CompareSpec {
        CompareSpec {
            rough: self.rough.clone(),
            flat: self.flat.clone(),
            law: self.law.clone(),
            layer: self.layer.clone(),
            models: None,
            reference: None,
            lines: None,
            statistical: None,
            accept: AcceptSpec::default(),
            robustness: false,
            attribution: false,
            rank_models: false,
            surfaces: self.surface.clone().map(|surface| vec![surface]),
            separation: Some(self.separation.get_ref().clone()),
            tolerance: ToleranceSpec::default(),
            pressure: None,
            force: None,
        }
    }
}
