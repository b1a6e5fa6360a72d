//! Output of a run: pages, tables, summaries, and their folder.
//!
//! Everything but [`store`] is pure: results in, bytes out.
//!
//! | module | what lives there |
//! |---|---|
//! | `page` | a page as Markdown and as self-contained HTML |
//! | [`mod@format`] | numbers and quantities as people read them |
//! | [`sections`] | sections of every page: set-up, provenance, references |
//! | [`table`] | columns with unit and meaning; CSV, for machines |
//! | [`table_docs`] | the documentation of tables |
//! | `index` | the pages that lead to all reports of a folder |
//! | [`store`] | the only module that writes to disk: a folder is replaced atomically |
//! | [`verify`] | comparison of new reports with committed ones |

pub mod format;
mod index;
pub mod page;
pub mod sections;
pub mod store;
pub mod table;
pub mod table_docs;
pub mod verify;

pub use index::{Index, MARK, PROGRAM};
pub use page::Page;
