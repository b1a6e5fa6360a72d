//! The flat body, bare or under a layer, and its contact with a rough one.

use super::{Interface, LayeredInterface, MicroContact};
use crate::law::{Inapplicable, Law, ScalableLaw};
use crate::layer::{LayerError, LayeredFlat, ModulusModel};
use crate::material::Material;

/// The flat body, or any body that may have a layer: [`ContactLaw::interface_of`](crate::ContactLaw::interface_of) takes it as the
/// rough one.
#[derive(Debug, Clone, PartialEq)]
pub enum Flat {
    /// One material.
    Bare(Material),
    /// A substrate under a layer of finite thickness.
    Layered {
        /// Material of the substrate.
        substrate: Material,
        /// Effective properties of layer and substrate.
        layered: LayeredFlat,
    },
    /// A layer of infinite thickness. Load ratios still refer to the substrate.
    AllLayer {
        /// Material of the substrate, for load ratios only.
        substrate: Material,
        /// Material of the layer.
        layer: Material,
    },
}

impl Flat {
    /// A layer of `thickness` (m) on a substrate: exactly the substrate for 0 and the layer for infinity.
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

    /// Like [`Self::with_layer`], with `coating` giving the layered flat of a finite, positive thickness.
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

    /// The micro-contact of a rough body with this flat under `law`.
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

    /// The micro-contact under a law that applies to homogeneous bodies only.
    ///
    /// # Errors
    /// A layer of finite thickness; see [`Inapplicable`].
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
