//! `[stability]`: numerical error of `f64` over the whole representable range.

use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::quantity::{
    Dimension, Length, Positive, Pure, Quantity, Range, SeparationRange,
};

/// How many cases are checked, and what they are drawn from; everything has a default.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StabilitySpec {
    /// Scenes of each family of single contacts.
    pub contacts: Option<Spanned<Whole>>,
    /// Of each family of sums.
    pub sums: Option<Spanned<Whole>>,
    /// Of each family of integrals.
    pub integrals: Option<Spanned<Whole>>,
    /// Of each family of load control.
    pub loads: Option<Spanned<Whole>>,
    /// Of each family of a million asperities.
    pub millions: Option<Spanned<Whole>>,
    /// Cells along each side of an error map.
    pub cells: Option<Spanned<Whole>>,
    /// d/sigma.
    pub separation: Option<Spanned<SpanSpec<Pure, SeparationRange>>>,
    /// Radius over sigma.
    pub radius_over_sigma: Option<Spanned<SpanSpec<Pure>>>,
    /// H/E*.
    pub hardness_over_modulus: Option<Spanned<SpanSpec<Pure>>>,
    /// Of a layer.
    pub thickness: Option<Spanned<SpanSpec<Length>>>,
}

/// `{ from, to }`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "Quantity<D, R>: Deserialize<'de>"))]
pub struct SpanSpec<D, R = Positive> {
    from: Quantity<D, R>,
    to: Quantity<D, R>,
}

impl<D: Dimension, R: Range> SpanSpec<D, R> {
    /// Both ends, SI.
    pub fn ends(&self) -> [f64; 2] {
        [self.from.value(), self.to.value()]
    }
}
