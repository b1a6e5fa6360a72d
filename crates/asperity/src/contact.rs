//! One micro-contact at one indentation: area, load, stiffness, regime.

use crate::named_enum;
use crate::numeric::lanes::Real;

/// Contact radius over sphere radius, a/R, beyond which the paraboloid approximation fails and strains are not small.
pub const LARGEST_SLOPE: f64 = 0.3;

named_enum! {
    /// The deformation regime of an asperity.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Regime {
        /// Fully recoverable.
        Elastic = "elastic",
        /// Contained plastic deformation.
        ElasticPlastic = "elastic-plastic",
        /// The mean pressure has reached the hardness.
        Plastic = "plastic",
    }
}

/// The contact of one asperity at an indentation `w > 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Real contact area, m^2.
    pub area: f64,
    /// Normal load, N.
    pub load: f64,
    /// dP/dw, N/m; at a boundary, within `regime`.
    pub stiffness: f64,
    /// Deformation regime.
    pub regime: Regime,
}

/// The contacts of one asperity per lane of a register.
#[derive(Debug, Clone, Copy)]
pub struct Contacts<N: Real> {
    /// Real contact areas, m^2.
    pub area: N,
    /// Normal loads, N.
    pub load: N,
    /// dP/dw, N/m.
    pub stiffness: N,
    /// Lanes that are elastic.
    pub elastic: N::Mask,
    /// Lanes that are plastic.
    pub plastic: N::Mask,
}

impl<N: Real> Contacts<N> {
    /// Selects per lane the contact of `yes` where `mask` is set, and that of `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: N::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            area: N::select(mask, yes.area, no.area),
            load: N::select(mask, yes.load, no.load),
            stiffness: N::select(mask, yes.stiffness, no.stiffness),
            elastic: (mask & yes.elastic) | (!mask & no.elastic),
            plastic: (mask & yes.plastic) | (!mask & no.plastic),
        }
    }

    /// Area, load and stiffness multiplied by `count`.
    #[inline(always)]
    pub fn times(self, count: N) -> Self {
        Self { area: self.area * count, load: self.load * count, stiffness: self.stiffness * count, ..self }
    }
}

impl From<Contacts<f64>> for Contact {
    #[inline(always)]
    fn from(one: Contacts<f64>) -> Self {
        let regime = match one {
            Contacts { elastic: true, .. } => Regime::Elastic,
            Contacts { plastic: true, .. } => Regime::Plastic,
            _ => Regime::ElasticPlastic,
        };
        Self { area: one.area, load: one.load, stiffness: one.stiffness, regime }
    }
}

/// A quantity by regime, in the order of [`Regime::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByRegime(pub [f64; 3]);

impl ByRegime {
    /// Sum over the regimes.
    pub fn total(&self) -> f64 {
        self.0[0] + self.0[1] + self.0[2]
    }

    /// The fraction of each regime in the total, 0 to 1; `None` if the total is zero.
    pub fn shares(&self) -> Option<[f64; 3]> {
        let total = self.total();
        (total > 0.0).then(|| self.0.map(|part| part / total))
    }
}
