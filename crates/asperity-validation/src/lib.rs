//! Measures the program itself: run time against error, `f64` against an evaluation of 32 digits, how often intervals hold
//! the truth, and boundary elements against known solutions.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod coverage;
pub mod kind;
pub mod precision;
pub mod solver;
pub mod stability;
