//! `[surface.NAME.pair]`: two rough bodies.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::{Spanned, Whole};

/// Two rough bodies, of which each is another surface of the spec: with a height map, or both Gaussian populations.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { a, b, shifts } such as { a = \"ring\", b = \"liner\", shifts = 16 }"
)]
pub struct PairSpec {
    /// The surface of the body whose material is `rough`.
    #[schemars(extend("examples" = ["ring"]))]
    pub a: Spanned<String>,
    /// The surface of the body whose material is `flat`; its x axis is mirrored, since each map is seen from outside its body.
    #[schemars(extend("examples" = ["liner"]))]
    pub b: Spanned<String>,
    /// Number of random relative positions of two maps. Maps that repeat are shifted around their border; of others the overlap counts, at least three
    /// quarters of the shorter side along each axis.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 16, "examples" = [16]))]
    pub shifts: Option<Spanned<Whole>>,
    /// Whether b is also rotated at random by 0, 90, 180 or 270 degrees.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub rotations: bool,
}
