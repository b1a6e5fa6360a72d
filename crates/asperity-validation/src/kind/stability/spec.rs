//! `[stability]`: numerical error of `f64` over the whole representable range.

use schemars::JsonSchema;
use serde::Deserialize;

use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::Whole;
use asperity_contact_framework::input::quantity::{
    Dimension, Length, Positive, Pure, Quantity, Range, SeparationRange,
};

/// Numerical error over the whole range of numbers, against 32 digits; every key has a default.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StabilitySpec {
    /// Cases of each group of single contacts.
    #[schemars(extend("x-range" = "1 to 100000", "default" = 1000, "examples" = [100]))]
    pub contacts: Option<Spanned<Whole>>,
    /// Cases of each group of sums.
    #[schemars(extend("x-range" = "1 to 100000", "default" = 200, "examples" = [100]))]
    pub sums: Option<Spanned<Whole>>,
    /// Cases of each group of integrals.
    #[schemars(extend("x-range" = "1 to 100000", "default" = 250, "examples" = [100]))]
    pub integrals: Option<Spanned<Whole>>,
    /// Cases of each group of load control.
    #[schemars(extend("x-range" = "1 to 100000", "default" = 50, "examples" = [100]))]
    pub loads: Option<Spanned<Whole>>,
    /// Cases of each group of a million asperities.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 3, "examples" = [100]))]
    pub millions: Option<Spanned<Whole>>,
    /// Cells along each side of an error map.
    #[schemars(extend("x-range" = "8 to 400", "examples" = [48], "default" = 48))]
    pub cells: Option<Spanned<Whole>>,
    /// Separations that are drawn, d/sigma.
    #[schemars(extend("examples" = [{ "from": -10, "to": 20 }]))]
    pub separation: Option<Spanned<SpanSpec<Pure, SeparationRange>>>,
    /// Radii that are drawn, over sigma.
    #[schemars(extend("examples" = [{ "from": 1, "to": 1e6 }]))]
    pub radius_over_sigma: Option<Spanned<SpanSpec<Pure>>>,
    /// Hardnesses that are drawn, over E*.
    #[schemars(extend("examples" = [{ "from": 1e-4, "to": 1 }]))]
    pub hardness_over_modulus: Option<Spanned<SpanSpec<Pure>>>,
    /// Thicknesses of a layer that are drawn.
    #[schemars(extend("examples" = [{ "from": "1 nm", "to": "1 mm" }]))]
    pub thickness: Option<Spanned<SpanSpec<Length>>>,
}

/// `{ from, to }`
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound(deserialize = "Quantity<D, R>: Deserialize<'de>"))]
#[schemars(bound = "Quantity<D, R>: JsonSchema")]
pub struct SpanSpec<D, R = Positive> {
    /// Lower end.
    from: Quantity<D, R>,
    /// Upper end.
    to: Quantity<D, R>,
}

impl<D: Dimension, R: Range> SpanSpec<D, R> {
    /// Both ends, SI.
    pub fn ends(&self) -> [f64; 2] {
        [self.from.value(), self.to.value()]
    }
}
