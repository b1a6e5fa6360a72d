//! Output of a run: pages, tables, summaries, and their folder.
//!
//! Everything but [`store`] is pure: results in, bytes out.
//!
//! | module | what lives there |
//! |---|---|
//! | [`answer`] | what a page says first: a sentence, or a card of labelled lines |
//! | `page` | a page as Markdown and as self-contained HTML |
//! | [`mod@format`] | numbers and quantities as people read them |
//! | [`sections`] | sections of every page: set-up, provenance, references |
//! | [`table`] | columns with unit, meaning and value; CSV and records of JSON |
//! | [`view`] | choices of a table's columns and rows, for people |
//! | [`digest`] | sums of the columns of long tables, which stand for them where they are not kept |
//! | `glossary` | the terms of the program, explained where they first appear on a page |
//! | `index` | the pages that lead to all reports of a folder |
//! | [`store`] | the only module that writes to disk: a folder is replaced atomically |
//! | [`verify`] | comparison of new reports with committed ones |

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
