//! The effective properties of a layered flat (DESIGN section 3; Pasaribu and Schipper 2005, Eqs. 14-20).

use super::Layer;
use crate::wide::{PI, Wide};
use asperity::{Material, ModulusModel};

#[derive(Debug, Clone)]
pub(super) struct EffectiveLayer {
    thickness: Wide,
    rule: ModulusModel,
    layer: Body,
    substrate: Body,
}

#[derive(Debug, Clone)]
struct Body {
    young: Wide,
    poisson: Wide,
    hardness: Option<Wide>,
    yield_strength: Option<Wide>,
}

/// The flat as an asperity feels it.
pub(super) struct EffectiveFlat {
    /// (1 - nu_eff^2)/E_eff, 1/Pa.
    pub(super) compliance: Wide,
    pub(super) poisson: Wide,
    /// H_eff, Pa; `None` where nothing yields.
    pub(super) hardness: Option<Wide>,
}

impl Body {
    fn new(body: &Material) -> Self {
        let hardness = body.hardness().map(Wide::new);
        let third = hardness.map(|hardness| hardness / 3.0);
        Self {
            young: Wide::new(body.young()),
            poisson: Wide::new(body.poisson()),
            hardness,
            yield_strength: body.yield_strength().map(Wide::new).or(third),
        }
    }

    /// 2 (1 + nu)/E.
    fn shear_compliance(&self) -> Wide {
        (Wide::ONE + self.poisson) * 2.0 / self.young
    }
}

impl EffectiveLayer {
    pub(super) fn new(layer: &Layer, substrate: &Material) -> Self {
        Self {
            thickness: Wide::new(layer.thickness),
            rule: layer.rule,
            layer: Body::new(&layer.material),
            substrate: Body::new(substrate),
        }
    }

    /// At indentation `w` and contact radius `a` (m).
    pub(super) fn effective(&self, w: Wide, a: Wide) -> EffectiveFlat {
        let (layer, substrate) = (&self.layer, &self.substrate);
        let xi = self.thickness / a;
        let angle = xi.atan() * 2.0 / PI;
        // xi ln((1 + xi^2)/xi^2).
        let log = xi * (a / self.thickness * (a / self.thickness)).ln_1p();
        // Eq. 17, 14.
        let of_poisson = angle + log / PI;
        let poisson = substrate.poisson + (layer.poisson - substrate.poisson) * of_poisson;
        // Eq. 18, 15.
        let rest = (Wide::ONE - poisson * 2.0) * log - xi / (Wide::ONE + xi * xi);
        let of_modulus = angle + rest / (PI * 2.0 * (Wide::ONE - poisson));
        let compliance = match self.rule {
            ModulusModel::Gao => {
                let young = substrate.young + (layer.young - substrate.young) * of_modulus;
                (Wide::ONE - poisson * poisson) / young
            }
            ModulusModel::Series => {
                let [of_layer, of_substrate] = [layer, substrate].map(Body::shear_compliance);
                let shear = of_substrate + (of_layer - of_substrate) * of_modulus;
                (Wide::ONE - poisson) * shear / 2.0
            }
        };
        EffectiveFlat { compliance, poisson, hardness: self.hardness(w) }
    }

    /// Eq. 16.
    fn hardness(&self, w: Wide) -> Option<Wide> {
        let (of_layer, of_substrate) = self.layer.hardness.zip(self.substrate.hardness)?;
        let (of_layer_y, of_substrate_y) = self.layer.yield_strength.zip(self.substrate.yield_strength)?;
        let strengths = of_layer_y / of_substrate_y;
        let moduli = self.layer.young / self.substrate.young;
        let depth = w / self.thickness;
        let exponent = if of_layer < of_substrate {
            strengths / moduli * depth * depth
        } else {
            of_layer / of_substrate / (strengths * moduli.sqrt()) * depth
        };
        Some(of_substrate + (of_layer - of_substrate) * (-exponent).exp())
    }

    /// Indentations (m) on whose scale the properties change, for asperities of the wide radius `b` (m).
    pub(super) fn scales(&self, b: Wide) -> Vec<Wide> {
        let whole = self.thickness * self.thickness / b;
        let mut scales = vec![whole];
        let bodies = self.layer.hardness.zip(self.substrate.hardness);
        if let Some((of_layer, of_substrate)) = bodies {
            let yields = [&self.layer, &self.substrate].map(|body| body.yield_strength.unwrap_or(Wide::ONE));
            let strengths = yields[0] / yields[1];
            let moduli = self.layer.young / self.substrate.young;
            for x in [1.0, 4.0, 12.0, 40.0] {
                scales.push(if of_layer < of_substrate {
                    self.thickness * (moduli / strengths * x).sqrt()
                } else {
                    self.thickness * strengths * moduli.sqrt() * of_substrate / of_layer * x
                });
            }
        }
        scales
    }
}
