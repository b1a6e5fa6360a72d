//! The kinds of experiment. To add one: a folder here, or another crate, and a line in [`KINDS`].

pub mod compare;
pub mod indentation;
pub mod laws;
pub mod limit;

use asperity_framework::Kind;
use asperity_validation::kind::{precision::Precision, stability::Stability};

/// Every kind, in the order in which messages list them.
pub const KINDS: [&dyn Kind; 6] =
    [&compare::Compare, &indentation::Indentation, &laws::Laws, &limit::Limit, &Precision, &Stability];

/// The table of surfaces, which some kinds read.
pub const SURFACES: &str = "surface";
