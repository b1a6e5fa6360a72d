//! The workbench: a page that the program serves on the user's own machine. A map is dropped on it, a material chosen, a slider moved;
//! it shows the verdict while that happens.
//!
//! The server holds no session: each request brings the whole spec, which is the state of the page.
#![deny(unsafe_code)]

mod allocator;
mod analysis;
pub mod engine;
mod folder;
mod guard;
mod limits;
mod listing;
mod routes;
pub mod server;
mod spec;

pub use engine::{Engine, Example, Prepared, Refused, SpecText, Stage};
pub use server::{Options, ServeError, Server};
