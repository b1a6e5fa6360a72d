//! The flat body, and its contact with a rough one.

use super::{Interface, Layered, MicroContact};
use crate::law::{Inapplicable, Law, ScalableLaw};
use crate::layer::{Coating, CoatingError, Rule};
use crate::material::Material;

/// The flat body.
#[derive(Debug, Clone, PartialEq)]
pub enum Flat {
    /// One material.
    Bare(Material),
    /// A substrate under a layer of finite thickness.
    Coated {
        /// The body below.
        substrate: Material,
        /// Effective properties of layer and substrate.
        coating: Coating,
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
    /// See [`CoatingError`].
    pub fn with_layer(
        layer: &Material,
        substrate: &Material,
        thickness: f64,
        rule: Rule,
    ) -> Result<Self, CoatingError> {
        Self::in_thickness(layer, substrate, thickness, || Coating::new(layer, substrate, thickness, rule))
    }

    /// The same; `coating` is called for a finite, positive thickness only.
    ///
    /// # Errors
    /// Those of `coating`.
    pub fn in_thickness(
        layer: &Material,
        substrate: &Material,
        thickness: f64,
        coating: impl FnOnce() -> Result<Coating, CoatingError>,
    ) -> Result<Self, CoatingError> {
        let substrate = *substrate;
        Ok(match thickness {
            0.0 => Self::Bare(substrate),
            f64::INFINITY => Self::AllLayer { substrate, layer: *layer },
            _ => Self::Coated { coating: coating()?, substrate },
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
            Self::Coated { substrate, coating } => {
                Ok(Box::new(Layered::new(law, rough, substrate, coating.clone())?))
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
            Self::Coated { .. } => Err(Inapplicable::Layer { law: law.name() }),
            Self::AllLayer { substrate, layer } => {
                Ok(Box::new(Interface::all_layer(law, rough, substrate, layer)?))
            }
        }
    }
}
