//! The bodies and the law of a case: every number that goes in, an exact `f64`.

use std::fmt;

use super::laws::CoveredLaw;
use asperity::{ContactError, Flat, Material, MicroContact, ModulusModel};

/// The layer on the flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Of what.
    pub material: Material,
    /// m; 0 and infinity are no layer and all layer.
    pub thickness: f64,
    /// Effective-modulus model.
    pub rule: ModulusModel,
}

/// Two bodies under a law.
#[derive(Debug, Clone)]
pub struct Bodies {
    /// The law.
    pub law: CoveredLaw,
    /// The rough body.
    pub rough: Material,
    /// The flat, or what is below its layer.
    pub flat: Material,
    /// The layer on it.
    pub layer: Option<Layer>,
}

impl Bodies {
    /// The micro-contact that both models add up.
    ///
    /// # Errors
    /// Bodies to which the law does not apply.
    pub fn contact(&self) -> Result<Box<dyn MicroContact>, ContactError> {
        let flat = match &self.layer {
            Some(layer) => Flat::with_layer(&layer.material, &self.flat, layer.thickness, layer.rule)?,
            None => Flat::Bare(self.flat),
        };
        Ok(self.law.chosen().interface(&self.rough, &flat)?)
    }
}

/// Every number so that it reads back to the same `f64`.
impl fmt::Display for Bodies {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "law {}", self.law)?;
        let body = |f: &mut fmt::Formatter, name: &str, body: &Material| {
            write!(f, "; {name}: young = {:e}, poisson = {:e}", body.young(), body.poisson())?;
            for (key, value) in [("hardness", body.hardness()), ("yield-strength", body.yield_strength())] {
                if let Some(value) = value {
                    write!(f, ", {key} = {value:e}")?;
                }
            }
            Ok(())
        };
        body(f, "rough", &self.rough)?;
        body(f, "flat", &self.flat)?;
        if let Some(layer) = &self.layer {
            body(f, "layer", &layer.material)?;
            write!(f, ", thickness = {:e}, rule {}", layer.thickness, layer.rule.name())?;
        }
        Ok(())
    }
}
