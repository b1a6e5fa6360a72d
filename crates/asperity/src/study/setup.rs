//! What both models are run with: a law on two bodies, loads, and what is asked for.

use super::models::StatisticalModel;
use crate::compare::{Controls, ModelKind};
use crate::progress::Progress;
use crate::surface::Surface;
use crate::{ContactLaw, Flat, Inapplicable, Material, MicroContact};

/// What both models are run with on a surface.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// The laws, each under every thickness of the layer.
    pub laws: &'a [LawContact],
    /// The laws alone.
    pub law_specs: &'a [ContactLaw],
    /// The models to run.
    pub models: &'a [ModelKind],
    /// The statistical model.
    pub statistical: &'a StatisticalModel,
    /// Whether the gap between the models is divided among its causes.
    pub is_attributed: bool,
    /// Whether all statistical models are compared with sum and reference.
    pub is_ranked: bool,
    /// What the surface is pressed to.
    pub controls: &'a Controls,
    /// Whether surfaces are generated for the sampling error of a map that is too small for blocks.
    pub generates: bool,
    /// The area that the forces of the controls act on, m²; `None` for the nominal area of each surface.
    pub nominal_area: Option<f64>,
    /// The seed of the spec.
    pub seed: u64,
    /// Whoever watches.
    pub progress: &'a dyn Progress,
}

impl Setup<'_> {
    /// The area that a force on `surface` acts on, m².
    pub fn load_area(&self, surface: &Surface) -> f64 {
        self.nominal_area.unwrap_or(surface.set.nominal_area())
    }

    /// Whether both models are run, so that they can be compared.
    pub fn has_both_models(&self) -> bool {
        [ModelKind::Statistical, ModelKind::Deterministic].iter().all(|kind| self.models.contains(kind))
    }
}

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
