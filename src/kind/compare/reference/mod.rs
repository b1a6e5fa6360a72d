//! The boundary element reference beside the models: the same maps, bodies and loads, without asperities.
//!
//! | file | what lives there |
//! |---|---|
//! | `spec` | `reference = { ... }` |
//! | `plan` | its loads, the contacts that it solves, time and memory |
//! | `run` | the solver on a realisation of a surface |
//! | `point` | a contact in the terms of the models, with bounds of its errors |
//! | `spots` | what its spots conduct, and their friction |
//! | `view` | a part of the contact, and the distribution of pressures |

pub mod plan;
mod point;
mod run;
mod spec;
mod spots;
mod view;

pub use plan::{ElasticCase, ReferencePlan, Solution};
pub use run::{ReferenceRun, SMALL_YIELDING};
pub use spec::ReferenceSpec;
pub use view::{ContactView, Part, numbered_patches};
