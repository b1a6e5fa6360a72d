//! What a run tells: pages, tables, summaries, and the folder that holds them.
//!
//! Everything but [`store`] is pure: results in, bytes out.
//!
//! | module | what lives there |
//! |---|---|
//! | `page` | one content in two forms, Markdown and self-contained HTML |
//! | [`mod@format`] | numbers and quantities as people read them |
//! | [`sections`] | what every page says: the bodies, the sources, the files |
//! | [`table`] | columns with unit and meaning; CSV, for machines |
//! | [`table_docs`] | the documentation of tables |
//! | `index` | the pages that lead to all reports of a folder |
//! | [`store`] | the only place that touches the disk: a folder is replaced whole or not at all |
//! | [`verify`] | do fresh reports say the same as committed ones? |

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
