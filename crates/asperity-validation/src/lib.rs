//! Measures the program itself: run time against error, and `f64` against an evaluation of 32 digits.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod kind;
pub mod precision;
pub mod stability;
