//! The experiment kinds of this crate.

pub mod precision;
pub mod stability;
