//! A law on two bodies.

use crate::{ContactLaw, Flat, Inapplicable, Material, MicroContact};

/// A law and the micro-contact that it makes of the two bodies.
pub struct LawContact {
    /// Name in tables and plots.
    pub label: String,
    /// Thickness of the layer, m; `None` without a layer.
    pub thickness: Option<f64>,
    /// The micro-contact.
    pub contact: Box<dyn MicroContact>,
    /// The law with its options.
    pub spec: ContactLaw,
}

impl LawContact {
    /// A law between a rough body and a flat without a layer.
    ///
    /// # Errors
    /// Materials without a property that the law needs.
    pub fn bare(law: ContactLaw, rough: &Material, flat: &Material) -> Result<Self, Inapplicable> {
        let contact = law.interface(rough, &Flat::Bare(*flat))?;
        Ok(Self { label: law.label(), thickness: None, contact, spec: law })
    }
}
