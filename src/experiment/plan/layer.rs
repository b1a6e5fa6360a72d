//! A layer on the flat.

use std::fmt;

use crate::coating::{CoatingError, Rule};
use crate::experiment::refusal::Refusal;
use crate::experiment::spec::LayerSpec;
use crate::interface::Flat;
use crate::material::Material;

use super::read::Reader;

/// A layer in one thickness or several.
#[derive(Debug, Clone)]
pub struct LayerPlan {
    /// Name of its material.
    pub name: String,
    /// The material.
    pub material: Material,
    /// How its modulus and that of the substrate are put together.
    pub rule: Rule,
    /// Thicknesses, m, ascending; 0 and infinity among them.
    pub thicknesses: Vec<f64>,
}

impl LayerPlan {
    /// The flat with the layer in the thickness `thickness` (m) on it.
    ///
    /// # Errors
    /// See [`CoatingError`]; a layer that was read has none.
    pub fn on(&self, substrate: &Material, thickness: f64) -> Result<Flat, CoatingError> {
        Flat::with_layer(&self.material, substrate, thickness, self.rule)
    }

    /// Whether some thickness is neither no layer nor all layer.
    pub fn has_finite(&self) -> bool {
        self.thicknesses.iter().any(|&t| t > 0.0 && t.is_finite())
    }
}

/// "lead of 0, 5e-8, inf m, rule gao".
impl fmt::Display for LayerPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let thicknesses: Vec<String> = self.thicknesses.iter().map(|t| format!("{t:e}")).collect();
        write!(f, "{} of {} m, rule {}", self.name, thicknesses.join(", "), self.rule.name())
    }
}

impl Reader<'_> {
    /// Resolves a layer on `substrate`.
    pub(super) fn layer(&self, words: &LayerSpec, substrate: &Material) -> Result<LayerPlan, Refusal> {
        let plan = LayerPlan {
            name: words.material.get_ref().clone(),
            material: self.body(words.material.get_ref(), words.material.span())?,
            rule: words.rule,
            thicknesses: words.thickness.0.clone(),
        };
        // Between no layer and all layer both bodies count together; a search for a thickness asks for any.
        plan.on(substrate, 1.0).map_err(|error| {
            self.source.refuse(words.material.span(), format!("found \"{}\": {error}", plan.name))
        })?;
        Ok(plan)
    }
}
