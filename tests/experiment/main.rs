//! Tests of the program: specs in, reports out, and the command line. One program, so that it is linked once.

mod caveats;
mod cli;
#[path = "../../crates/asperity/tests/library/common.rs"]
mod common;
mod indentation;
mod layers;
mod registry;
mod work;

/// What came out of a run, which is a `T`.
fn downcast<T: std::any::Any>(outcome: Box<dyn asperity_framework::Outcome>) -> T {
    *(outcome as Box<dyn std::any::Any>).downcast().expect("the results of this kind")
}
