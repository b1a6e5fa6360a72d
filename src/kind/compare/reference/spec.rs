//! `reference = { ... }` in `[compare]`.

use serde::Deserialize;
use toml::Spanned;

use asperity::bem::Boundary;
use asperity_framework::input::Whole;
use asperity_framework::input::quantity::{Pure, Quantity};

/// How the boundary element reference is run; each key may be left out.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { loads = 9, error = 1e-6, cap = \"none\", boundary = \"mirrored\" }"
)]
pub struct ReferenceSpec {
    /// Loads of a sweep at which it runs.
    pub loads: Option<Spanned<Whole>>,
    /// Relative dual gap.
    pub error: Option<Spanned<Quantity<Pure>>>,
    /// The largest pressure.
    pub cap: Option<Spanned<CapSpec>>,
    /// What lies beyond the edge of the map.
    pub boundary: Option<Boundary>,
    /// Points along an axis for each of the map's.
    pub refine: Option<Spanned<Whole>>,
}

/// The largest pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CapSpec {
    /// The hardness of the softer body: perfectly plastic contacts.
    Hardness,
    /// Elastic contacts.
    None,
}
