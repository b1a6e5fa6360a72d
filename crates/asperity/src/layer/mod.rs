//! The layered body, the flat or the rough one: a solid whose modulus, Poisson's ratio and hardness change with the indentation of each
//! asperity (Pasaribu and Schipper 2005, Eqs. 14-20).
//!
//! | file | what lives there |
//! |---|---|
//! | `weights` | the weights of the layer as functions of xi = t/a (Eqs. 17, 18) |
//! | `modulus` | nu_eff and E_eff by the paper's model or in series (Eqs. 14, 15) |
//! | `hardness` | H_eff (Eq. 16) |

pub mod exact_sphere;
mod hardness;
mod modulus;
mod weights;

pub use modulus::ModulusModel;

use crate::interface::Flat;
use crate::literature::{self, Paper};
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::is_positive;
use crate::numeric::lanes::Real;
use hardness::EffectiveHardness;
use modulus::EffectiveModulus;

/// The effective properties of a layer of finite thickness on a substrate, independent of the rough body.
#[derive(Debug, Clone, PartialEq)]
pub struct LayeredFlat {
    inverse_thickness: f64,
    modulus: EffectiveModulus,
    hardness: Option<EffectiveHardness>,
}

/// A layered flat whose effective properties are undefined.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LayerError {
    /// The thickness must be positive and finite; a flat of thickness 0 or infinity is homogeneous.
    #[error("thickness {0} m; allowed: positive and finite")]
    Thickness(f64),
    /// Both bodies must have a hardness, or neither.
    #[error("only one of layer and substrate has a hardness; allowed: both, or neither")]
    OneHardness,
}

/// Fraction of the distance to the singularities +-i from which on a panel also resolves the pole beyond 0.
const FAR: f64 = 0.3;

/// Effective properties of the layered flat under one asperity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effective<N = f64> {
    /// (1 - nu_eff^2)/E_eff, 1/Pa.
    pub compliance: N,
    /// d(compliance)/d ln w, 1/Pa.
    pub compliance_slope: N,
    /// H_eff (Eq. 16), Pa; infinite if neither body yields.
    pub hardness: N,
    /// d H_eff/d ln w, Pa.
    pub hardness_slope: N,
}

/// Bounds of the effective properties over a range of indentations and radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Compliance, 1/Pa.
    pub compliance: Interval,
    /// d(compliance)/d ln w, 1/Pa.
    pub compliance_slope: Interval,
    /// nu_eff.
    pub poisson: Interval,
    /// d nu_eff/d ln w.
    pub poisson_slope: Interval,
    /// H_eff, Pa.
    pub hardness: Interval,
    /// d ln H_eff/d ln w.
    pub hardness_slope: Interval,
}

impl LayeredFlat {
    /// A layer of `thickness` (m) on a substrate.
    ///
    /// # Errors
    /// A thickness that is not positive and finite; a hardness of one body alone.
    pub fn new(
        layer: &Material,
        substrate: &Material,
        thickness: f64,
        model: ModulusModel,
    ) -> Result<Self, LayerError> {
        if !is_positive(thickness) {
            return Err(LayerError::Thickness(thickness));
        }
        if layer.hardness().is_some() != substrate.hardness().is_some() {
            return Err(LayerError::OneHardness);
        }
        Ok(Self {
            inverse_thickness: thickness.recip(),
            modulus: EffectiveModulus::new(model, layer, substrate),
            hardness: EffectiveHardness::new(layer, substrate),
        })
    }

    /// The sources of the equations.
    pub fn papers(&self) -> Vec<Paper> {
        let mut papers = vec![literature::PASARIBU_SCHIPPER_2005, literature::GAO_CHIU_LEE_1992];
        papers.push(match self.modulus.model() {
            ModulusModel::Gao => literature::SWAIN_MENCIK_1994,
            ModulusModel::Series => literature::SONG_PHARR_1999,
        });
        papers.extend(self.hardness.map(|_| literature::BHATTACHARYA_NIX_1988));
        papers
    }

    /// 1/xi = a/t with a = (b w)^.5 (Eqs. 19, 20).
    #[inline(always)]
    fn inverse<N: Real>(&self, w: N, b: N) -> N {
        (b * w).sqrt() * self.inverse_thickness
    }

    /// Effective properties under asperities of radii `b` (m) at indentations `w` (m).
    #[inline(always)]
    pub fn at<N: Real>(&self, w: N, b: N) -> Effective<N> {
        let (compliance, compliance_slope) = self.compliance(w, b);
        let (hardness, hardness_slope) = match self.hardness(w) {
            Some(found) => found,
            None => (w.splat(f64::INFINITY), w.splat(0.0)),
        };
        Effective { compliance, compliance_slope, hardness, hardness_slope }
    }

    /// (1 - nu_eff^2)/E_eff under asperities of radii `b` (m) at indentations `w` (m), and its d/d ln w, 1/Pa.
    #[inline(always)]
    pub(crate) fn compliance<N: Real>(&self, w: N, b: N) -> (N, N) {
        self.modulus.compliance(self.inverse(w, b))
    }

    /// H_eff (Eq. 16) at indentations `w` (m), and its d/d ln w, Pa; `None` if neither body yields.
    #[inline(always)]
    #[expect(clippy::manual_map, reason = "no closure may return lanes")]
    pub(crate) fn hardness<N: Real>(&self, w: N) -> Option<(N, N)> {
        match &self.hardness {
            Some(hardness) => Some(hardness.at(w * self.inverse_thickness)),
            None => None,
        }
    }

    /// nu_eff (Eq. 14) under asperities of radii `b` (m) at indentations `w` (m), and d nu_eff/d ln w.
    #[inline(always)]
    pub fn poisson<N: Real>(&self, w: N, b: N) -> (N, N) {
        self.modulus.poisson_and_slope(self.inverse(w, b))
    }

    /// nu_eff (Eq. 14) and E_eff (Eq. 15, Pa) under an asperity of radius `b` (m) at indentation `w` (m).
    pub fn elasticity(&self, w: f64, b: f64) -> (f64, f64) {
        let poisson = self.modulus.poisson(self.inverse(w, b));
        (poisson, (1.0 - poisson) * (1.0 + poisson) / self.at(w, b).compliance)
    }

    /// The same layer with another thickness (m).
    ///
    /// # Errors
    /// A thickness that is not positive and finite.
    pub fn with_thickness(&self, thickness: f64) -> Result<Self, LayerError> {
        if !is_positive(thickness) {
            return Err(LayerError::Thickness(thickness));
        }
        Ok(Self { inverse_thickness: thickness.recip(), ..self.clone() })
    }

    /// Bounds of the effective properties over radii `b` (m) and indentations `w` (m).
    pub fn over(&self, w: Interval, b: Interval) -> Bounds {
        let inverse = Interval { low: self.inverse(w.low, b.low), high: self.inverse(w.high, b.high) };
        let [(compliance, compliance_slope), (poisson, poisson_slope)] = self.modulus.over(inverse);
        let never = (Interval::point(f64::INFINITY), Interval::point(0.0));
        let depth = w * self.inverse_thickness;
        let (hardness, hardness_slope) =
            self.hardness.as_ref().map_or(never, |hardness| hardness.over(depth));
        Bounds { compliance, compliance_slope, poisson, poisson_slope, hardness, hardness_slope }
    }

    /// The range of H_eff over all indentations, Pa.
    pub fn hardness_range(&self) -> Interval {
        self.hardness.as_ref().map_or(Interval::point(f64::INFINITY), EffectiveHardness::range)
    }

    /// The range of nu_eff over all indentations.
    pub fn poisson_range(&self) -> Interval {
        self.modulus.poisson_range()
    }

    /// The indentation (m) at which H_eff equals `hardness` (Pa); `None` if there is none.
    pub fn indentation_of_hardness(&self, hardness: f64) -> Option<f64> {
        Some(self.hardness.as_ref()?.reaching(hardness)? / self.inverse_thickness)
    }

    /// The indentation (m) beyond which the hardness is that of the substrate; 0 if neither body yields.
    pub fn depth(&self) -> f64 {
        self.hardness.as_ref().map_or(0.0, EffectiveHardness::end) / self.inverse_thickness
    }

    /// Indentations (m) between which the reduced modulus under an asperity of radius `b` (m) is smooth, where `other`
    /// (1/Pa) is the compliance of the other body. In w^.5 its singularities are at a = +-i t, with a pole at the a < 0
    /// where the two compliances cancel.
    pub fn modulus_scales(&self, b: f64, other: f64) -> impl Iterator<Item = f64> {
        let pole = self.modulus.pole(other).min(1.0);
        let thickness = self.inverse_thickness.recip();
        let scales = [pole, 1.0].into_iter().skip(usize::from(pole > FAR));
        scales.map(move |inverse| (inverse * thickness).powi(2) / b)
    }

    /// Indentations (m) between which 1/H_eff is smooth.
    pub fn hardness_scales(&self) -> Vec<f64> {
        let depths = self.hardness.as_ref().map(EffectiveHardness::scales).unwrap_or_default();
        depths.into_iter().map(|depth| depth / self.inverse_thickness).collect()
    }
}

/// A layer on a substrate: what does not depend on its thickness is found once.
#[derive(Debug, Clone)]
pub struct Coating {
    /// Material of the layer.
    pub material: Material,
    substrate: Material,
    /// The layer, 1 m thick, on its substrate.
    layered: LayeredFlat,
}

impl Coating {
    /// A layer of `material` on `substrate`.
    ///
    /// # Errors
    /// Materials that the effective hardness cannot be computed of.
    pub fn new(material: Material, substrate: Material, rule: ModulusModel) -> Result<Self, LayerError> {
        let layered = LayeredFlat::new(&material, &substrate, 1.0, rule)?;
        Ok(Self { material, substrate, layered })
    }

    /// The substrate with the layer in a thickness (m) on it: the substrate alone at 0, the layer alone at infinity.
    ///
    /// # Errors
    /// A thickness that is neither positive nor 0.
    pub fn flat(&self, thickness: f64) -> Result<Flat, LayerError> {
        let layered = || self.layered.with_thickness(thickness);
        Flat::in_thickness(&self.material, &self.substrate, thickness, layered)
    }
}
