//! What the spots of a contact conduct, and how they resist sliding: quantities that follow from the area and the load of each
//! micro-contact, and are summed like these.
//!
//! | module | content |
//! |---|---|
//! | `conduction` | electrical and thermal conductance of a spot, with a film on it or a layer under it; correlations in use for joints |
//! | `layered` | a circular spot on a layer |
//! | `shear` | shear force of a spot under boundary friction; its tangential stiffness |

mod conduction;
mod layered;
mod shear;

pub use conduction::{Conduction, ConductionError, GapMedium, cluster_conductance, tube_factor};
pub use conduction::{Correlation, Joint};
pub use layered::{LAYER_RATIOS, LayerFactor};
pub use shear::{BrokenFilm, Shear, ShearStrength, Tangential};

use crate::contact::Contact;
use crate::literature::Paper;
use crate::named_enum;
use crate::shape::Shape;

named_enum! {
    /// A quantity of a spot that is summed over all spots.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum SpotQuantity {
        /// Electrical conductance, S.
        ElectricalConductance = "electrical-conductance",
        /// Thermal conductance, W/K.
        ThermalConductance = "thermal-conductance",
        /// Shear force, N.
        ShearForce = "shear-force",
        /// Tangential stiffness while nothing slips, N/m.
        TangentialStiffness = "tangential-stiffness",
    }
}

/// A value for each of [`SpotQuantity::ALL`]; 0 of a quantity that is not asked for.
pub type SpotValues = [f64; SpotQuantity::ALL.len()];

/// What is asked of the spots of an interface.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpotProperties {
    /// Of their electrical conductance.
    pub electrical: Option<Conduction>,
    /// Of their thermal conductance.
    pub thermal: Option<Conduction>,
    /// What conducts heat beside the spots, through the gap.
    pub medium: Option<GapMedium>,
    /// Of their shear force.
    pub shear: Option<Shear>,
    /// Of their tangential stiffness.
    pub tangential: Option<Tangential>,
}

impl SpotProperties {
    /// Whether nothing is asked for.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a conductance is asked for.
    pub fn conducts(&self) -> bool {
        self.electrical.is_some() || self.thermal.is_some()
    }

    /// The properties of conduction of an electrical or a thermal conductance; `None` of another quantity, and where it is not asked
    /// for.
    pub fn conduction(&self, quantity: SpotQuantity) -> Option<&Conduction> {
        match quantity {
            SpotQuantity::ElectricalConductance => self.electrical.as_ref(),
            SpotQuantity::ThermalConductance => self.thermal.as_ref(),
            SpotQuantity::ShearForce | SpotQuantity::TangentialStiffness => None,
        }
    }

    /// The values of an asperity of `shape` whose contact at the indentation `w` (m) is `contact`.
    pub fn values(&self, w: f64, contact: &Contact, shape: Shape) -> SpotValues {
        let conductance = |conduction: &Option<Conduction>| {
            conduction.as_ref().map_or(0.0, |conduction| conduction.conductance(contact.area, shape.spheres))
        };
        [
            conductance(&self.electrical),
            conductance(&self.thermal),
            self.shear.as_ref().map_or(0.0, |shear| shear.force(w, contact)),
            self.tangential.map_or(0.0, |tangential| tangential.stiffness(contact.area, shape.spheres)),
        ]
    }

    /// The indentations (m) at which one of the values jumps, ascending.
    pub fn jumps(&self) -> Vec<f64> {
        self.shear.iter().filter_map(Shear::breakthrough).collect()
    }

    /// The sources of its equations.
    pub fn papers(&self) -> Vec<Paper> {
        let conduction = self.conducts().then_some(Conduction::PAPERS).into_iter().flatten();
        let shear = self.shear.iter().flat_map(|_| Shear::PAPERS);
        let tangential = self.tangential.iter().flat_map(|_| Tangential::PAPERS);
        conduction.chain(shear).chain(tangential).copied().collect()
    }
}
