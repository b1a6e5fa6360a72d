//! `reference = { ... }` in `[compare]`.

use asperity::bem::Boundary;
use asperity_contact_framework::input::quantity::{Pure, Quantity};
use asperity_contact_framework::input::{Spanned, Whole};
use schemars::JsonSchema;
use serde::Deserialize;

/// How the boundary element reference is run; each key may be left out.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { loads = 9, error = 1e-6, cap = \"none\", boundary = \"mirrored\" }"
)]
pub struct ReferenceSpec {
    /// Number of the loads of a sweep at which it runs; all of a list.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 9, "examples" = [5]))]
    pub loads: Option<Spanned<Whole>>,
    /// Relative dual gap at which an iteration ends.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "default" = 1e-6, "examples" = [1e-4]))]
    pub error: Option<Spanned<Quantity<Pure>>>,
    /// The largest contact pressure.
    #[schemars(extend("x-default" = "the hardness where the law yields and no layer of finite thickness is there, else none", "examples" = ["none"]))]
    pub cap: Option<Spanned<CapSpec>>,
    /// What lies beyond the border of the map.
    #[schemars(extend("x-default" = "periodic on generated and periodic maps, else mirrored", "examples" = ["mirrored"]))]
    pub boundary: Option<Boundary>,
    /// Points along an axis for each of the map; with 2 the map itself is solved too, and the difference is part of the error bar.
    #[schemars(extend("x-range" = "1 to 2", "default" = 1, "examples" = [2]))]
    pub refine: Option<Spanned<Whole>>,
}

/// The largest pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CapSpec {
    /// The hardness of the softer body: perfectly plastic contacts.
    Hardness,
    /// Elastic contacts.
    None,
}
