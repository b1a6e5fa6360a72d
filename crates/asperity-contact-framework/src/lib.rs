//! The frame that a kind of contact experiment runs in: it knows the bodies, materials, laws and loads of a spec, reads spec files with
//! units and errors that name file, line and key, and writes pages, tables and summaries into folders that are replaced atomically.
//!
//! A kind implements [`Kind`], [`Plan`] and [`Outcome`]; it then has `check`, `run`, reports and `verify` without more. A plan that is [`Divided`] can
//! be run by many machines.
#![deny(unsafe_code)]

pub mod digest;
mod folder;
pub mod input;
pub mod kept;
pub mod keys;
mod kind;
pub mod metadata;
pub mod remedy;
pub mod report;

pub use asperity::progress;
pub use folder::{ReportError, folder, summary_json};
pub use kind::{Divided, Kind, Memory, Outcome, Plan, Reads, RegisteredKind, RunContext, fields, set_memory};
pub use metadata::Group;
