//! The input file: quantities with units, common tables, and errors that name file, line and key.

pub mod accept;
pub mod bare;
mod error;
mod file;
mod forms;
pub mod heights;
pub mod law;
pub mod material;
pub mod quantity;
mod resolver;
pub mod schema;
pub mod sweep;

pub use error::{InputError, Source, plain_message};
pub use file::{InMemory, SpecFile};
pub use forms::{Forms, OneOrMany, Spanned, named, named_or_none};
pub use quantity::Whole;
pub use resolver::materials;
