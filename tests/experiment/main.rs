//! Tests of the program: specs in, reports out, and the command line. One program, so that it is linked once.

mod adaptive;
mod caveats;
mod cli;
#[path = "../../crates/asperity/tests/library/common.rs"]
mod common;
mod indentation;
mod layers;
mod stability;
mod work;
