//! The experiment program: from a spec file to results and their report.
//!
//! ```text
//! spec file -> Experiment (a kind's plan) -> Outcome -> report folder
//! ```
#![deny(unsafe_code)]

mod experiment;
pub mod export;
pub mod keys;
pub mod kind;
mod layer;
pub mod materials;
pub mod model_tables;
mod plausibility;
mod presentation;
pub mod study_plan;
pub mod surface;
pub mod sweep;
#[cfg(feature = "cli")]
pub mod terminal;
#[cfg(feature = "serve")]
pub mod workbench;

pub use experiment::{Experiment, LIBRARY, TEMPLATE, make_surface, saved_spec, surface_report, write_index};
