//! Counts of work: contacts evaluated, files read, surfaces made. A micro-contact that counts its evaluations, and the time that work takes.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns};
use crate::interface::{LoadBounds, MicroContact, Shapes, forward};
use crate::literature::Paper;
use crate::numeric::interval::Interval;
use crate::progress::{PIECE, Progress, Silent};
use crate::shape::Shape;
use crate::spot::{SpotProperties, SpotValues};

/// Counts of the work of one run.
///
/// A contact is counted in one of `asperities_touched`, `nodes` and `single_contacts`. Evaluations of effective
/// properties without a contact are not counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Work {
    /// Contacts of asperities in sums: each asperity above the flat at each separation.
    pub asperities_touched: u64,
    /// Contacts at quadrature nodes of integrals.
    pub nodes: u64,
    /// Contacts evaluated one by one: the curve of one asperity, both sides of a jump, bounds of a load that may
    /// decrease.
    pub single_contacts: u64,
    /// Number of these contacts on a layer of finite thickness.
    pub coating_calls: u64,
    /// Files read.
    pub files_read: u64,
    /// Sets of asperities drawn, read from lists or found on maps, per realisation.
    pub surfaces_made: u64,
}

/// The item counted; see [`Work`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Item {
    /// [`Work::asperities_touched`]
    Asperities,
    /// [`Work::nodes`]
    Nodes,
    /// [`Work::single_contacts`]
    SingleContacts,
    /// [`Work::coating_calls`]
    CoatingCalls,
    /// [`Work::files_read`]
    Files,
    /// [`Work::surfaces_made`]
    Surfaces,
}

/// Counts the work of one run on all its threads.
#[derive(Debug, Default)]
pub struct Counter([Part; PARTS]);

/// Number of separate counters, to avoid contention between threads.
const PARTS: usize = 16;

/// The counts of one thread, on a cache line of their own.
#[derive(Debug, Default)]
#[repr(align(128))]
struct Part([AtomicU64; 6]);

impl Counter {
    /// Adds `count` of an item, and says whether a further [`PIECE`] of them is full.
    #[inline]
    pub fn add(&self, item: Item, count: usize) -> bool {
        let part = rayon::current_thread_index().unwrap_or(0) % PARTS;
        let before = self.0[part].0[item as usize].fetch_add(count as u64, Ordering::Relaxed);
        let pieces = |count: u64| count / PIECE as u64;
        pieces(before + count as u64) > pieces(before)
    }

    /// The counts so far.
    pub fn work(&self) -> Work {
        let total =
            |item: Item| self.0.iter().map(|part| part.0[item as usize].load(Ordering::Relaxed)).sum();
        Work {
            asperities_touched: total(Item::Asperities),
            nodes: total(Item::Nodes),
            single_contacts: total(Item::SingleContacts),
            coating_calls: total(Item::CoatingCalls),
            files_read: total(Item::Files),
            surfaces_made: total(Item::Surfaces),
        }
    }
}

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
