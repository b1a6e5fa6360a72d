//! How the surfaces of two bodies answer to loads: displacement to pressure, and the potential to a current.

use crate::layer::exact_sphere::Kernel;
use crate::material::Material;

/// The field on the surfaces of two bodies under loads on them.
pub trait SurfaceResponse: Sync {
    /// The amplitude of the field under a wave of loads of unit amplitude and wave number `q` (1/m).
    fn to_wave(&self, q: f64) -> f64;

    /// Over pi r the field at the distance r from a unit load on half-spaces of the outermost materials.
    fn outermost(&self) -> f64;

    /// An elastic layer, and (1 - nu^2)/E of its material (1/Pa).
    fn layer(&self) -> Option<(&Layer, f64)> {
        None
    }
}

/// Two elastic bodies in frictionless contact: the sum of their surface displacements under pressure. Each is a
/// half-space, one of them with or without a bonded layer. Only the sum of the displacements counts: which of the bodies is the rough
/// one makes no difference.
#[derive(Debug, Clone)]
pub struct ElasticPair {
    /// (1 - nu^2)/E of the body without a layer, 1/Pa.
    bare: f64,
    /// The same of the other's outermost material.
    outer: f64,
    /// The same of the other's substrate.
    substrate: f64,
    layer: Option<Layer>,
}

/// A layer of finite thickness.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Its response over that of a half-space of its material.
    pub kernel: Kernel,
    /// m.
    pub thickness: f64,
}

/// (1 - nu^2)/E, 1/Pa.
fn plane_compliance(body: &Material) -> f64 {
    (1.0 - body.poisson()) * (1.0 + body.poisson()) / body.young()
}

impl ElasticPair {
    /// A `bare` body, and a `substrate` which may have a bonded layer of a material and a thickness (m; 0: no layer, infinite:
    /// nothing but layer): a rough body on a coated flat, or a flat under a coated rough body. Young's moduli and Poisson's ratios alone count; a layer responds as in its exact solution
    /// (Perriot and Barthel 2004), not by an effective modulus.
    pub fn new(bare: &Material, substrate: &Material, layer: Option<(&Material, f64)>) -> Self {
        let layer = layer.filter(|(_, thickness)| *thickness > 0.0);
        let (outermost, finite) = match layer {
            None => (substrate, None),
            Some((layer, thickness)) if thickness.is_finite() => {
                (layer, Some(Layer { kernel: Kernel::new(layer, substrate), thickness }))
            }
            Some((layer, _)) => (layer, None),
        };
        Self {
            bare: plane_compliance(bare),
            outer: plane_compliance(outermost),
            substrate: plane_compliance(substrate),
            layer: finite,
        }
    }

    /// E* of the pair without its layer, Pa.
    pub fn reduced_modulus(&self) -> f64 {
        (self.bare + self.substrate).recip()
    }

    /// The amplitude of the displacement under a wave of pressure of unit amplitude and wave number `q` (1/m), m/Pa.
    pub fn compliance(&self, q: f64) -> f64 {
        let kappa = self.layer.as_ref().map_or(1.0, |layer| layer.kernel.kappa(q * layer.thickness));
        2.0 / q * (self.bare + self.outer * kappa)
    }

    /// Whether one of the bodies has a layer of finite thickness.
    pub fn is_layered(&self) -> bool {
        self.layer.is_some()
    }
}

/// Displacements, m/Pa.
impl SurfaceResponse for ElasticPair {
    fn to_wave(&self, q: f64) -> f64 {
        self.compliance(q)
    }

    fn outermost(&self) -> f64 {
        self.bare + self.outer
    }

    fn layer(&self) -> Option<(&Layer, f64)> {
        self.layer.as_ref().map(|layer| (layer, self.outer))
    }
}

/// Two bodies that conduct through their contact, electrically or thermally. Each is a half-space, one of them with or without a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConductingPair {
    /// Resistivity of the body without a layer, ohm m or m K/W.
    bare: f64,
    /// Of the other's substrate.
    substrate: f64,
    /// Resistivity of its layer, and thickness, m.
    layer: Option<(f64, f64)>,
}

impl ConductingPair {
    /// Of resistivities (ohm m; thermally 1/k, m K/W): of a `bare` body, of a `substrate`, and of a layer on it of a thickness (m; 0: no
    /// layer, infinite: nothing but layer).
    pub fn new(bare: f64, substrate: f64, layer: Option<(f64, f64)>) -> Self {
        match layer.filter(|(_, thickness)| *thickness > 0.0) {
            Some((resistivity, thickness)) if thickness.is_infinite() => {
                Self { bare, substrate: resistivity, layer: None }
            }
            layer => Self { bare, substrate, layer },
        }
    }

    /// Whether one of the bodies has a layer of finite thickness.
    pub fn is_layered(&self) -> bool {
        self.layer.is_some()
    }
}

/// Potentials, ohm m^2 or m^2 K/W.
impl SurfaceResponse for ConductingPair {
    /// Of a layer of the resistivity ratio r on its substrate: r (1 + r T)/(r + T), T = tanh(q t), times that of the substrate.
    fn to_wave(&self, q: f64) -> f64 {
        let factor = self.layer.map_or(1.0, |(resistivity, thickness)| {
            let (ratio, tanh) = (resistivity / self.substrate, (q * thickness).tanh());
            ratio * (1.0 + ratio * tanh) / (ratio + tanh)
        });
        (self.bare + self.substrate * factor) / q
    }

    fn outermost(&self) -> f64 {
        0.5 * (self.bare + self.layer.map_or(self.substrate, |(resistivity, _)| resistivity))
    }
}
