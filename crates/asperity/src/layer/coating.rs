//! A layer of any thickness on a substrate.

use super::{LayerError, LayeredFlat, ModulusModel};
use crate::{Flat, Material};

/// A layer on a substrate: what does not depend on its thickness is found once.
#[derive(Debug, Clone)]
pub struct Coating {
    /// Material of the layer.
    pub material: Material,
    substrate: Material,
    /// The layer, 1 m thick, on its substrate.
    layered: LayeredFlat,
}

impl Coating {
    /// A layer of `material` on `substrate`.
    ///
    /// # Errors
    /// Materials that the effective hardness cannot be computed of.
    pub fn new(material: Material, substrate: Material, rule: ModulusModel) -> Result<Self, LayerError> {
        let layered = LayeredFlat::new(&material, &substrate, 1.0, rule)?;
        Ok(Self { material, substrate, layered })
    }

    /// The substrate with the layer in a thickness (m) on it: the substrate alone at 0, the layer alone at infinity.
    ///
    /// # Errors
    /// A thickness that is neither positive nor 0.
    pub fn flat(&self, thickness: f64) -> Result<Flat, LayerError> {
        let layered = || self.layered.with_thickness(thickness);
        Flat::in_thickness(&self.material, &self.substrate, thickness, layered)
    }
}
