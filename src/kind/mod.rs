//! The kinds of experiment. To add one: a folder here, or another crate, and a line in [`KINDS`].

pub mod causes;
pub mod compare;
pub mod indentation;
pub mod laws;
pub mod limit;
pub mod sampling_interval;
pub mod tiled;

use crate::sweep;
use asperity_contact_framework::AnyKind;
use asperity_contact_framework::report::digest::DigestRow;
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::report::table_docs;
#[cfg(feature = "validation")]
use asperity_validation::kind::{
    coverage::IntervalCoverage, precision::Precision, solver_validation::SolverValidation,
    stability::Stability,
};

/// Every kind, in the order in which messages list them; those that measure the program itself only with the feature
/// `validation`.
pub const KINDS: &[&dyn AnyKind] = &[
    &causes::Causes,
    &compare::Compare,
    #[cfg(feature = "validation")]
    &IntervalCoverage,
    &indentation::Indentation,
    &laws::Laws,
    &limit::Limit,
    #[cfg(feature = "validation")]
    &Precision,
    &sampling_interval::SamplingInterval,
    #[cfg(feature = "validation")]
    &SolverValidation,
    #[cfg(feature = "validation")]
    &Stability,
    &tiled::Tiled,
];

/// What reports may be of: a kind of experiment, or a sweep over keys of one.
pub const REPORTED: &[&dyn AnyKind] = &{
    let mut all: [&dyn AnyKind; KINDS.len() + 1] = [&sweep::Sweep; KINDS.len() + 1];
    let mut place = 0;
    while place < KINDS.len() {
        all[place] = KINDS[place];
        place += 1;
    }
    all
};

/// The table of surfaces, which some kinds read.
pub const SURFACES: &str = "surface";

/// The tables that the kinds of experiment write, or those of `only` one kind, with unit and meaning of every column, as
/// Markdown.
pub fn columns(only: Option<&str>) -> String {
    let kinds = REPORTED.iter().filter(|kind| only.is_none_or(|name| name == kind.name()));
    table_docs::markdown(kinds.map(|kind| {
        let mut tables = if kind.name() == sweep::NAME { sweep::documented() } else { kind.tables() };
        if tables.iter().any(|table| table.is_long) {
            tables.push(Schema::of::<DigestRow>());
        }
        (kind.name(), tables)
    }))
}
