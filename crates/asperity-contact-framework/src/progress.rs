//! Progress of a run, as the library reports it.

pub use asperity::progress::{Named, Progress, Silent};
