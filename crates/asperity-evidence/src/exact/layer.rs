//! The effective properties of a layered flat (DESIGN section 3; Pasaribu and Schipper 2005, Eqs. 14-20).

use super::Layer;
use crate::wide::{PI, Wide};
use asperity::{Material, ModulusModel};

/// Pairs are of layer and substrate.
#[derive(Debug, Clone)]
pub(super) struct EffectiveLayer {
    thickness: Wide,
    rule: ModulusModel,
    young: [Wide; 2],
    poisson: [Wide; 2],
    /// `None` where nothing yields.
    hardness: Option<[Wide; 2]>,
    /// Ratio of the yield strengths.
    strengths: Wide,
}

impl EffectiveLayer {
    pub(super) fn new(layer: &Layer, substrate: &Material) -> Self {
        let bodies = [&layer.material, substrate];
        let [of_layer, of_substrate] = bodies.map(|body| body.hardness().map(Wide::new));
        // A third of the hardness where none is known.
        let strength = |body: &Material| {
            let third = body.hardness().map(|hardness| Wide::new(hardness) / 3.0);
            body.yield_strength().map(Wide::new).or(third).unwrap_or(Wide::ONE)
        };
        Self {
            thickness: Wide::new(layer.thickness),
            rule: layer.rule,
            young: bodies.map(|body| Wide::new(body.young())),
            poisson: bodies.map(|body| Wide::new(body.poisson())),
            hardness: of_layer.zip(of_substrate).map(<[Wide; 2]>::from),
            strengths: strength(bodies[0]) / strength(bodies[1]),
        }
    }

    fn moduli(&self) -> Wide {
        self.young[0] / self.young[1]
    }

    /// At indentation `w` and contact radius `a` (m): (1 - nu_eff^2)/E_eff (1/Pa), nu_eff and H_eff (Pa; `None` where nothing yields).
    pub(super) fn effective(&self, w: Wide, a: Wide) -> (Wide, Wide, Option<Wide>) {
        let xi = self.thickness / a;
        let angle = xi.atan() * 2.0 / PI;
        // xi ln((1 + xi^2)/xi^2).
        let log = xi * (a / self.thickness * (a / self.thickness)).ln_1p();
        let mixed = |[layer, substrate]: [Wide; 2], part: Wide| substrate + (layer - substrate) * part;
        // Eq. 17, 14.
        let poisson = mixed(self.poisson, angle + log / PI);
        // Eq. 18, 15.
        let rest = (Wide::ONE - poisson * 2.0) * log - xi / (Wide::ONE + xi * xi);
        let of_modulus = angle + rest / (PI * 2.0 * (Wide::ONE - poisson));
        let compliance = match self.rule {
            ModulusModel::Gao => (Wide::ONE - poisson * poisson) / mixed(self.young, of_modulus),
            ModulusModel::Series => {
                // 2 (1 + nu)/E.
                let shear = [0, 1].map(|k| (Wide::ONE + self.poisson[k]) * 2.0 / self.young[k]);
                (Wide::ONE - poisson) * mixed(shear, of_modulus) / 2.0
            }
        };
        (compliance, poisson, self.hardness(w))
    }

    /// Eq. 16.
    fn hardness(&self, w: Wide) -> Option<Wide> {
        let [of_layer, of_substrate] = self.hardness?;
        let depth = w / self.thickness;
        let exponent = if of_layer < of_substrate {
            self.strengths / self.moduli() * depth * depth
        } else {
            of_layer / of_substrate / (self.strengths * self.moduli().sqrt()) * depth
        };
        Some(of_substrate + (of_layer - of_substrate) * (-exponent).exp())
    }

    /// Indentations (m) on whose scale the properties change, for asperities of the wide radius `b` (m).
    pub(super) fn scales(&self, b: Wide) -> Vec<Wide> {
        let mut scales = vec![self.thickness * self.thickness / b];
        if let Some([of_layer, of_substrate]) = self.hardness {
            scales.extend([1.0, 4.0, 12.0, 40.0].map(|x| {
                if of_layer < of_substrate {
                    self.thickness * (self.moduli() / self.strengths * x).sqrt()
                } else {
                    self.thickness * self.strengths * self.moduli().sqrt() * of_substrate / of_layer * x
                }
            }));
        }
        scales
    }
}
