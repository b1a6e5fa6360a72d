//! Output of a run: pages, tables, summaries, and their folder.
//!
//! Everything but [`store`] is pure: results in, bytes out.

pub mod answer;
pub mod digest;
pub mod format;
mod glossary;
mod index;
pub mod page;
pub mod sections;
pub mod store;
pub mod table;
pub mod verify;
pub mod view;

pub use glossary::meanings;
pub(crate) use index::CARD;
pub use index::{Index, MARK, PROGRAM};
pub use page::Page;
