//! Tests of the references: against vectors of 40 digits, and of the library against them.

#[path = "../../../asperity/tests/library/common.rs"]
mod common;

mod coverage;
mod solver;
mod stability;
