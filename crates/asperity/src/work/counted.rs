//! A micro-contact that counts its evaluations, and the time that work takes.

use std::time::Duration;

use super::{Counter, Item};
use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns};
use crate::interface::{LoadBounds, MicroContact, Shapes, forward};
use crate::literature::Paper;
use crate::numeric::interval::Interval;
use crate::progress::{Progress, Silent};
use crate::shape::Shape;
use crate::spot::{SpotProperties, SpotValues};

/// A micro-contact that counts its evaluations, those of a block at once.
pub struct CountedContact<'a> {
    contact: &'a dyn MicroContact,
    is_layered: bool,
    counter: &'a Counter,
    progress: &'a dyn Progress,
}

impl<'a> CountedContact<'a> {
    /// Counts the evaluations of `contact` in `counter`.
    pub fn new(contact: &'a dyn MicroContact, counter: &'a Counter) -> Self {
        Self { contact, is_layered: contact.is_layered(), counter, progress: &Silent }
    }

    /// The same, which shows to `progress` that the evaluations go on.
    #[must_use]
    pub fn watched_by(self, progress: &'a dyn Progress) -> Self {
        Self { progress, ..self }
    }

    fn count(&self, item: Item, count: usize) {
        if self.counter.add(item, count) {
            self.progress.advance(0.0);
        }
        if self.is_layered {
            self.counter.add(Item::CoatingCalls, count);
        }
    }
}

impl MicroContact for CountedContact<'_> {
    forward! { contact:
        fn spot_values(&self, w: f64, shape: Shape) -> Option<SpotValues>;
        fn spot_properties(&self) -> Option<&SpotProperties>;
        fn regime_changes(&self, shape: Shape) -> Vec<f64>;
        fn breakpoints(&self, shape: Shape) -> Vec<f64>;
        fn may_decrease(&self, shapes: Shapes) -> Vec<Interval>;
        fn reference_modulus(&self) -> f64;
        fn reference_hardness(&self) -> f64;
        fn papers(&self) -> Vec<Paper>;
        fn caveat(&self) -> Option<String>;
    }

    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.count(Item::SingleContacts, 1);
        self.contact.contact(w, shape)
    }

    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        self.count(Item::SingleContacts, 1);
        self.contact.load_over(from, to, shape)
    }

    fn contacts(&self, indentations: &[f64], shape: Shape) -> ContactColumns {
        self.count(Item::Nodes, indentations.len());
        self.contact.contacts(indentations, shape)
    }

    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        self.count(Item::Nodes, indentations.len());
        self.contact.accumulate_weighted(indentations, weights, shape, accumulator);
    }

    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        self.count(Item::Asperities, asperities.count());
        self.contact.accumulate(asperities, separation, accumulator);
    }

    fn is_layered(&self) -> bool {
        self.is_layered
    }
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    /// Reading files.
    pub read: Duration,
    /// Drawing asperities.
    pub generate: Duration,
    /// Levelling, filtering, finding summits.
    pub summits: Duration,
    /// The integrals.
    pub statistical: Duration,
    /// The sums, ordering included.
    pub deterministic: Duration,
    /// Both models again, for sampling errors.
    pub sampling: Duration,
    /// The boundary element reference.
    pub reference: Duration,
    /// All of it.
    pub total: Duration,
}
