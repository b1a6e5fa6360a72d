//! The experiment kinds of this crate.

pub mod coverage;
pub mod precision;
pub mod solver_validation;
pub mod stability;
