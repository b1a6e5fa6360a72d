//! The workbench: a page that the program serves on the user's own machine. A map is dropped on it, a material chosen, a slider moved;
//! it shows the verdict while that happens.
//!
//! | module | what lives there |
//! |---|---|
//! | [`engine`] | what the server asks of the program |
//! | [`server`] | addresses, and the life of the server |
//! | `guard` | who may ask: host, origin and token of a request |
//! | `routes` | what can be asked |
//! | `analysis` | work on threads of its own, which ends where nobody waits for it |
//! | `folder`, `listing` | the user's files: read, added, listed; never outside of one folder |
//! | `allocator` | memory that returns to the system |
//! | `spec` | the spec of the page as TOML and as Python |
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
