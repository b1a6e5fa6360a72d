//! Rough-surface contact two ways: the statistical integral and the sum over the real asperities.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod asperity;
pub mod compare;
pub mod contact;
pub mod experiment;
pub mod interface;
pub mod law;
pub mod literature;
pub mod material;
pub mod model;
pub mod numeric;
pub mod report;
pub mod surface;
pub mod units;
