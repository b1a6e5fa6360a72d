//! The experiment kinds of this crate.

mod boundary_elements;
pub mod coverage;
pub mod precision;
pub mod solver_validation;
pub mod stability;
