//! The bodies and the law of a case: every number that goes in, an exact `f64`.

use std::fmt;

use asperity::interface::{ContactError, Flat, MicroContact};
use asperity::law::{Ceb, FullyPlastic, Hertz, JacksonGreen, KogutEtsion, Zmc};
use asperity::layer::Rule;
use asperity::material::Material;

/// A law and its options.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Hertz.
    Hertz,
    /// Zhao, Maietta and Chang.
    Zmc {
        /// w1 E*^2/(b H^2); `None` for (0.3 pi)^2.
        onset: Option<f64>,
        /// w2/w1.
        transition_ratio: f64,
    },
    /// Chang, Etsion and Bogy.
    Ceb,
    /// Kogut and Etsion.
    KogutEtsion,
    /// Jackson and Green.
    JacksonGreen,
    /// Abbott and Firestone.
    FullyPlastic,
}

/// What lies on the flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Of what.
    pub material: Material,
    /// m; 0 and infinity are no layer and all layer.
    pub thickness: f64,
    /// How its modulus and that of the substrate are put together.
    pub rule: Rule,
}

/// Two bodies under a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bodies {
    /// The law.
    pub law: Law,
    /// The rough body.
    pub rough: Material,
    /// The flat, or what is below its layer.
    pub flat: Material,
    /// What lies on it.
    pub layer: Option<Layer>,
}

impl Bodies {
    /// The micro-contact that both models add up.
    ///
    /// # Errors
    /// Bodies that the law says nothing of.
    pub fn contact(&self) -> Result<Box<dyn MicroContact>, ContactError> {
        let flat = match &self.layer {
            Some(layer) => Flat::with_layer(&layer.material, &self.flat, layer.thickness, layer.rule)?,
            None => Flat::Bare(self.flat),
        };
        Ok(match self.law {
            Law::Hertz => flat.under(Hertz, &self.rough)?,
            Law::Zmc { onset, transition_ratio } => {
                let law = Zmc::new(onset.unwrap_or(Zmc::ONSET), transition_ratio);
                flat.under(law.unwrap_or_default(), &self.rough)?
            }
            Law::Ceb => flat.under(Ceb, &self.rough)?,
            Law::KogutEtsion => flat.under(KogutEtsion, &self.rough)?,
            Law::JacksonGreen => flat.homogeneous_under(JacksonGreen::default(), &self.rough)?,
            Law::FullyPlastic => flat.under(FullyPlastic, &self.rough)?,
        })
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Hertz => write!(f, "hertz"),
            Self::Zmc { onset: None, transition_ratio } => {
                write!(f, "zmc (transition-ratio = {transition_ratio:e})")
            }
            Self::Zmc { onset: Some(onset), transition_ratio } => {
                write!(f, "zmc (onset = {onset:e}, transition-ratio = {transition_ratio:e})")
            }
            Self::Ceb => write!(f, "ceb"),
            Self::KogutEtsion => write!(f, "kogut-etsion"),
            Self::JacksonGreen => write!(f, "jackson-green"),
            Self::FullyPlastic => write!(f, "fully-plastic"),
        }
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
