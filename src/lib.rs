//! The experiment program: from a spec file to a report.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod experiment;
pub mod precision;
pub mod report;
pub mod stability;
pub mod units;
