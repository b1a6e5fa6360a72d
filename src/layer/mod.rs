//! A layer on the flat: what a spec says of it, and what is made of that.

mod plan;
mod spec;
mod warning;

pub use plan::{LayerPlan, layer, thickness_words};
pub use spec::LayerSpec;
pub use warning::rule_warning;
