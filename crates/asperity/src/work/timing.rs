//! Measured times.

use std::time::Duration;

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
