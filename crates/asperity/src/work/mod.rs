//! Counts of work: contacts evaluated, files read, surfaces made.

mod counted;

use crate::progress::PIECE;
pub use counted::{CountedContact, Timing};

use std::sync::atomic::{AtomicU64, Ordering};

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
