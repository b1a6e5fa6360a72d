//! The kinds of experiment. To add one: a folder here, or another crate, and a line in [`REPORTED`].

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
#[cfg(feature = "evidence")]
use asperity_evidence::EvidenceKind;

/// What reports may be of: every kind of experiment, programs that prove what the library claims only with the feature `evidence`; last the
/// sweep over keys of one.
pub const REPORTED: &[&dyn AnyKind] = &[
    &causes::Causes,
    &compare::Compare,
    #[cfg(feature = "evidence")]
    &EvidenceKind,
    &indentation::Indentation,
    &laws::Laws,
    &limit::Limit,
    &sampling_interval::SamplingInterval,
    &tiled::Tiled,
    &sweep::Sweep,
];

/// Every kind of experiment, in the order in which messages list them.
pub const KINDS: &[&dyn AnyKind] = REPORTED.split_at(REPORTED.len() - 1).0;

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
