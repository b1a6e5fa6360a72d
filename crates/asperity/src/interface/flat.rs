//! The flat body, and its contact with a rough one.

use super::{Interface, LayeredInterface, MicroContact};
use crate::law::{Inapplicable, Law, ScalableLaw};
use crate::layer::{LayerError, LayeredFlat, ModulusModel};
use crate::material::Material;

/// The flat body.
#[derive(Debug, Clone, PartialEq)]
pub enum Flat {
    /// One material.
    Bare(Material),
    /// A substrate under a layer of finite thickness.
    Layered {
        /// The body below.
        substrate: Material,
        /// Effective properties of layer and substrate.
        layered: LayeredFlat,
    },
    /// Layer throughout (thickness infinity). Load ratios still refer to the substrate.
    AllLayer {
        /// The body below, too deep to matter.
        substrate: Material,
        /// Material of the layer.
        layer: Material,
    },
}

impl Flat {
    /// A layer of `thickness` (m) on a substrate: 0 is the substrate and infinity the layer, exactly.
    ///
    /// # Errors
    /// See [`LayerError`].
    pub fn with_layer(
        layer: &Material,
        substrate: &Material,
        thickness: f64,
        model: ModulusModel,
    ) -> Result<Self, LayerError> {
        Self::in_thickness(layer, substrate, thickness, || {
            LayeredFlat::new(layer, substrate, thickness, model)
        })
    }

    /// The same; `coating` is called for a finite, positive thickness only.
    ///
    /// # Errors
    /// Those of `coating`.
    pub fn in_thickness(
        layer: &Material,
        substrate: &Material,
        thickness: f64,
        layered: impl FnOnce() -> Result<LayeredFlat, LayerError>,
    ) -> Result<Self, LayerError> {
        let substrate = *substrate;
        Ok(match thickness {
            0.0 => Self::Bare(substrate),
            f64::INFINITY => Self::AllLayer { substrate, layer: *layer },
            _ => Self::Layered { layered: layered()?, substrate },
        })
    }

    /// The micro-contact of a rough body with it under `law`.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn under<L: ScalableLaw>(
        &self,
        law: L,
        rough: &Material,
    ) -> Result<Box<dyn MicroContact>, Inapplicable> {
        match self {
            Self::Layered { substrate, layered } => {
                Ok(Box::new(LayeredInterface::new(law, rough, substrate, layered.clone())?))
            }
            _ => self.homogeneous_under(law, rough),
        }
    }

    /// The same under a law that does not say what a layer of finite thickness does to it.
    ///
    /// # Errors
    /// Such a layer, and see [`Inapplicable`].
    pub fn homogeneous_under<L: Law + Clone>(
        &self,
        law: L,
        rough: &Material,
    ) -> Result<Box<dyn MicroContact>, Inapplicable> {
        match self {
            Self::Bare(flat) => Ok(Box::new(Interface::bare(law, rough, flat)?)),
            Self::Layered { .. } => Err(Inapplicable::Layer { law: law.name() }),
            Self::AllLayer { substrate, layer } => {
                Ok(Box::new(Interface::all_layer(law, rough, substrate, layer)?))
            }
        }
    }
}
