//! The frame that a kind of contact experiment runs in: it knows the bodies, materials, laws and loads of a spec, reads spec files with
//! units and errors that name file, line and key, and writes pages, tables and summaries into folders that are replaced atomically.
//!
//! A kind implements [`Kind`], [`Plan`] and [`Outcome`]; it then has `check`, `run`, reports and `verify` without more. A plan that is [`Divided`](divided::Divided) can
//! be run in parts on many machines.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod contact;
pub mod digest;
pub mod disk;
pub mod divided;
mod folder;
mod group;
pub mod input;
pub mod kept;
pub mod keys;
mod kind;
pub mod metadata;
pub mod parts;
pub mod progress;
pub mod remedy;
pub mod report;
mod summary;

pub use folder::{Print, PrintError, ReportError, folder};
pub use group::Group;
pub use kind::{
    AnyKind, AnyPlan, InputSha256, Kind, Memory, Outcome, Plan, Planned, Reads, RunContext, fields,
    set_memory,
};
pub use summary::summary_json;
