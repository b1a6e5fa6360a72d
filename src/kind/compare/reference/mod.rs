//! The boundary element reference beside the models: the same maps, bodies and loads, without asperities.
//!
//! | file | what lives there |
//! |---|---|
//! | `plan` | its loads, the contacts that it solves, time and memory |
//! | `run` | the solver on a realisation of a surface |
//! | `spots` | what its spots conduct, and their friction |
//! | `view` | a part of the contact, and the distribution of pressures |

pub mod plan;
mod run;
mod spots;
mod view;

pub use plan::{ElasticCase, ReferencePlan, ReferenceSpec, Solution};
pub use run::{ReferenceRun, SMALL_YIELDING};
pub use view::{ContactView, Part, numbered_patches};
