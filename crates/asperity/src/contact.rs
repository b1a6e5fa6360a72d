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

/// Many contacts: areas, loads, stiffnesses, and the place of each regime in [`Regime::ALL`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ContactColumns([Vec<f64>; 4]);

impl ContactColumns {
    /// Appends one contact per lane.
    #[inline(always)]
    pub(crate) fn extend<N: Real>(&mut self, contacts: &Contacts<N>) {
        let Contacts { area, load, stiffness, elastic, plastic } = *contacts;
        let [first, second, third] = Regime::ALL.map(|regime| regime as usize as f64);
        let unless_plastic = N::select(elastic, area.splat(first), area.splat(second));
        let regime = N::select(plastic, area.splat(third), unless_plastic);
        for (column, lanes) in self.0.iter_mut().zip([area, load, stiffness, regime]) {
            let start = column.len();
            column.resize(start + N::LANES, 0.0);
            lanes.store(&mut column[start..]);
        }
    }

    /// The contacts from `start` on, one per lane of the type of `zero`.
    #[inline(always)]
    pub(crate) fn load<N: Real>(&self, start: usize, zero: N) -> Contacts<N> {
        let [area, load, stiffness, regime] = &self.0;
        let regime = zero.load(&regime[start..]);
        let between = zero.splat(Regime::ElasticPlastic as usize as f64);
        Contacts {
            area: zero.load(&area[start..]),
            load: zero.load(&load[start..]),
            stiffness: zero.load(&stiffness[start..]),
            elastic: regime.lt(between),
            plastic: between.lt(regime),
        }
    }
}

impl FromIterator<Contact> for ContactColumns {
    fn from_iter<I: IntoIterator<Item = Contact>>(contacts: I) -> Self {
        let mut columns = Self::default();
        for Contact { area, load, stiffness, regime } in contacts {
            let (elastic, plastic) = (regime == Regime::Elastic, regime == Regime::Plastic);
            columns.extend(&Contacts { area, load, stiffness, elastic, plastic });
        }
        columns
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
