//! The figures of a comparison.

pub mod contact;
pub mod curves;
pub mod differences;
pub mod layers;
pub(crate) mod main_figure;
