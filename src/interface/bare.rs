//! Two homogeneous bodies.

use super::{LoadBounds, MicroContact};
use crate::contact::Contact;
use crate::law::{Law, Pair};
use crate::literature::Paper;
use crate::material::Material;
use crate::numeric::interval::Interval;

/// A rough and a flat body, both homogeneous, under one law.
#[derive(Debug, Clone, Copy)]
pub struct Interface<L> {
    law: L,
    pair: Pair,
    /// The pair that load ratios and the plasticity index refer to.
    reference: Pair,
}

impl<L: Law> Interface<L> {
    /// The contact of a rough body with a flat one.
    pub fn bare(law: L, rough: &Material, flat: &Material) -> Self {
        let pair = Pair::of(rough, flat);
        Self { law, pair, reference: pair }
    }

    /// The same with the flat all of `layer`; load ratios still refer to `flat`.
    pub fn all_layer(law: L, rough: &Material, flat: &Material, layer: &Material) -> Self {
        Self { law, pair: Pair::of(rough, layer), reference: Pair::of(rough, flat) }
    }
}

impl<L: Law> MicroContact for Interface<L> {
    #[inline]
    fn contact(&self, w: f64, b: f64) -> Contact {
        self.law.contact(w, b, &self.pair)
    }

    fn regime_changes(&self, b: f64) -> Vec<f64> {
        self.law.critical_ratios(&self.pair).into_iter().map(|ratio| ratio * b).collect()
    }

    fn breakpoints(&self, b: f64) -> Vec<f64> {
        self.regime_changes(b)
    }

    /// Bare contacts of one law are similar whatever their radius, and within a regime no law falls.
    fn load_rises_to(&self, _: Interval) -> f64 {
        if super::drops(&self.law, &self.pair) { 0.0 } else { f64::INFINITY }
    }

    fn load_over(&self, from: f64, to: f64, b: f64) -> LoadBounds {
        if self.regime_changes(b).into_iter().any(|w| (from..=to).contains(&w)) {
            return LoadBounds::any(self.law.highest_load(from, to, b, &self.pair, &self.pair));
        }
        let strain = self.pair.reduced_modulus / self.pair.hardness;
        let u = |w: f64| w / b * strain * strain;
        let exponents = self.law.load_exponents(Interval { low: u(from), high: u(to) });
        let w = Interval { low: from, high: to };
        LoadBounds::between(w, [from, to].map(|w| self.contact(w, b).load), exponents)
    }

    fn reference_modulus(&self) -> f64 {
        self.reference.reduced_modulus
    }

    fn reference_hardness(&self) -> f64 {
        self.reference.hardness
    }

    fn papers(&self) -> Vec<Paper> {
        self.law.papers().to_vec()
    }
}
