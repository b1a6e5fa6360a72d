//! A layer on the flat or on the rough body: its spec and its plan.

mod plan;
mod spec;
mod warning;

pub use plan::{LayerPlan, layer, thickness_words};
pub use spec::LayerSpec;
pub use warning::{CoatedSurface, hardness_warning, rule_warning};
