//! The input file: quantities with units, common tables, and errors that name file, line and key.

pub mod accept;
pub mod bare;
mod error;
pub mod figure;
mod file;
mod forms;
pub mod heights;
mod in_memory;
pub mod law;
pub mod material;
mod one_or_many;
pub mod quantity;
mod resolver;
pub mod schema;
mod spanned;
pub mod sweep;
mod whole;

pub use error::{InputError, Source, plain_message};
pub use file::SpecFile;
pub use forms::{Forms, named, named_or_none};
pub use in_memory::InMemory;
pub use one_or_many::OneOrMany;
pub use resolver::materials;
pub use spanned::Spanned;
pub use whole::Whole;
