//! The boundary element reference beside the models: the same maps, bodies and loads, without asperities.

pub mod plan;
mod run;
mod spots;
mod view;

pub use plan::{ElasticCase, ReferencePlan, ReferenceSpec, Solution};
pub use run::{ReferenceRun, SMALL_YIELDING};
pub use view::{ContactView, Part, numbered_patches};
