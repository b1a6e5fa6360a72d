//! Two homogeneous bodies.

use super::batch::{LaneContacts, accumulate, accumulate_weighted};
use super::{JUMP, LoadBounds, MicroContact, Reference, Shapes};
use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, Contacts};
use crate::law::{Inapplicable, Law, Pair};
use crate::literature::Paper;
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;
use crate::shape::Shape;

/// A rough and a flat body, both homogeneous, under one law.
#[derive(Debug, Clone)]
pub struct Interface<L> {
    law: L,
    pair: Pair,
    reference: Reference,
}

impl<L: Law + Clone> Interface<L> {
    /// The contact of a rough body with a flat one.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn bare(law: L, rough: &Material, flat: &Material) -> Result<Self, Inapplicable> {
        Self::all_layer(law, rough, flat, flat)
    }

    /// The contact with a flat that consists of `layer` only; load ratios still refer to `flat`.
    ///
    /// # Errors
    /// As [`Self::bare`].
    pub fn all_layer(
        law: L,
        rough: &Material,
        flat: &Material,
        layer: &Material,
    ) -> Result<Self, Inapplicable> {
        let pair = Pair::between(&law, rough, layer)?;
        Ok(Self { law: law.tuned(&pair), pair, reference: Reference::new(rough, flat) })
    }
}

/// A law and its pair by value, so that the compiler keeps both in registers.
struct LawOfPair<L>(L, Pair);

impl<L: Law> LaneContacts for LawOfPair<L> {
    /// Nothing: the bodies are the same everywhere.
    type Local<N: Real> = ();

    #[inline(always)]
    fn local<N: Real>(&self, _: N, _: N, _: N) {}

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, radius: N, spheres: N, (): &()) -> Contacts<N> {
        self.0.contacts(w, radius, &self.1.splat(w)).times(spheres)
    }
}

impl<L: Law + Clone> Interface<L> {
    fn law_of_pair(&self) -> LawOfPair<L> {
        LawOfPair(self.law.clone(), self.pair)
    }
}

impl<L: Law + Clone> MicroContact for Interface<L> {
    #[inline]
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.law.contacts(w, shape.radius, &self.pair.splat(w)).times(shape.spheres).into()
    }

    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        accumulate_weighted(self.law_of_pair(), indentations, weights, shape, accumulator);
    }

    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        accumulate(self.law_of_pair(), asperities, separation, accumulator);
    }

    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        self.law.critical_ratios(&self.pair).into_iter().map(|ratio| ratio * shape.radius).collect()
    }

    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        self.regime_changes(shape)
    }

    /// Within a range load and area of every law increase; they can decrease only at boundaries.
    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval> {
        /// Relative rounding error of a critical indentation and of the load jump there.
        const ROUNDING: f64 = 1e-14;
        let boundaries = self.law.critical_ratios(&self.pair).into_iter().zip(self.law.jumps(&self.pair));
        let dropping = boundaries.filter(|(_, jump)| *jump < 1.0 - JUMP);
        let ranges = dropping.map(|(ratio, _)| Interval {
            low: ratio * shapes.radii.low * (1.0 - ROUNDING),
            high: ratio * shapes.radii.high * (1.0 + ROUNDING),
        });
        Interval::union(ranges)
    }

    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        let highest = shape.spheres * self.law.highest_load(from, to, shape.radius, &self.pair);
        if self.regime_changes(shape).into_iter().any(|w| (from..=to).contains(&w)) {
            return LoadBounds::any(highest);
        }
        LoadBounds { highest, slopes: Interval { low: 0.0, high: f64::INFINITY } }
    }

    fn reference_modulus(&self) -> f64 {
        self.reference.modulus
    }

    fn reference_hardness(&self) -> f64 {
        self.reference.hardness
    }

    fn papers(&self) -> Vec<Paper> {
        self.law.papers().to_vec()
    }

    fn caveat(&self) -> Option<String> {
        self.law.caveat(&self.pair)
    }
}
