//! The experiment kinds of this crate.

pub mod coverage;
pub mod precision;
pub mod stability;
