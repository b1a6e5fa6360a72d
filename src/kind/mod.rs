//! The kinds of experiment. To add one: a folder here, or another crate, and a line in [`REPORTED`].

pub mod causes;
pub mod compare;
pub mod indentation;
pub mod laws;
pub mod limit;
pub mod sampling_interval;
pub mod tiled;

use crate::sweep;
use asperity_contact_framework::RegisteredKind;
#[cfg(feature = "validation")]
use asperity_validation::kind::{
    coverage::IntervalCoverage, precision::Precision, solver_validation::SolverValidation,
    stability::Stability,
};

/// What reports may be of: every kind of experiment, those that measure the program itself only with the feature `validation`; last the sweep
/// over keys of one.
pub const REPORTED: &[RegisteredKind] = &[
    RegisteredKind::of::<causes::Causes>(),
    RegisteredKind::of::<compare::Compare>(),
    #[cfg(feature = "validation")]
    RegisteredKind::of::<IntervalCoverage>(),
    RegisteredKind::of::<indentation::Indentation>(),
    RegisteredKind::of::<laws::Laws>(),
    RegisteredKind::of::<limit::Limit>(),
    #[cfg(feature = "validation")]
    RegisteredKind::of::<Precision>(),
    RegisteredKind::of::<sampling_interval::SamplingInterval>(),
    #[cfg(feature = "validation")]
    RegisteredKind::of::<SolverValidation>(),
    #[cfg(feature = "validation")]
    RegisteredKind::of::<Stability>(),
    RegisteredKind::of::<tiled::Tiled>(),
    RegisteredKind::of::<sweep::Sweep>(),
];

/// Every kind of experiment, in the order in which messages list them.
pub const KINDS: &[RegisteredKind] = REPORTED.split_at(REPORTED.len() - 1).0;

/// The table of surfaces, which some kinds read.
pub const SURFACES: &str = "surface";
