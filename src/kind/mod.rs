//! The kinds of experiment. To add one: a folder here, or another crate, and a line in [`REPORTED`].

pub mod causes;
pub mod compare;
pub mod indentation;
pub mod laws;
pub mod limit;
pub mod sampling_interval;
pub mod tiled;

use asperity_contact_framework::RegisteredKind;
#[cfg(feature = "evidence")]
use asperity_evidence::EvidenceKind;

use crate::sweep;

/// What reports may be of: every kind of experiment, programs that prove what the library claims only with the feature `evidence`; last the
/// sweep over keys of one.
pub const REPORTED: &[RegisteredKind] = &[
    RegisteredKind::of::<causes::Causes>(),
    RegisteredKind::of::<compare::Compare>(),
    #[cfg(feature = "evidence")]
    RegisteredKind::of::<EvidenceKind>(),
    RegisteredKind::of::<indentation::Indentation>(),
    RegisteredKind::of::<laws::Laws>(),
    RegisteredKind::of::<limit::Limit>(),
    RegisteredKind::of::<sampling_interval::SamplingInterval>(),
    RegisteredKind::of::<tiled::Tiled>(),
    RegisteredKind::of::<sweep::Sweep>(),
];

/// Every kind of experiment, in the order in which messages list them.
pub const KINDS: &[RegisteredKind] = REPORTED.split_at(REPORTED.len() - 1).0;

/// The table of surfaces, which some kinds read.
pub const SURFACES: &str = "surface";
