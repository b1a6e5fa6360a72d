//! `[indentation]`: one sphere on a layered flat.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

use crate::layer::LayerSpec;
use crate::paper::SphereFigure;
use asperity_contact_framework::input::OneOrMany;
use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::input::schema;
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::written_schema;

/// One ball on a layered flat: load, area and regimes, and the error of the effective-modulus models.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct IndentationSpec {
    /// The ball: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub ball: Spanned<String>,
    /// Radius of the ball.
    #[schemars(extend("examples" = ["5 mm"]))]
    pub radius: Quantity<Length>,
    /// The substrate: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The layers on the flat, each by itself.
    #[schemars(extend("examples" = [{ "material": "lead", "thickness": ["1 um", "10 um"] }]))]
    pub layer: Spanned<Layers>,
    /// The micro-contact laws.
    pub law: Spanned<Laws>,
    /// How far the ball is pressed in, ascending.
    #[schemars(extend("x-range" = "up to the radius", "examples" = [{ "from": "1 nm", "to": "1 um", "points": 100 }]))]
    pub indentation: Spanned<LogSweep<Length>>,
    /// A CSV of your measured points, laid over the curves: the columns indentation in m and load in N. Relative to the spec.
    #[schemars(extend("x-default" = "none", "examples" = ["points.csv"]))]
    pub overlay: Option<Spanned<PathBuf>>,
    /// Axes of the load figure.
    #[serde(default)]
    #[schemars(extend("default" = "load", "examples" = ["approach"]))]
    pub show: Show,
    /// The figure of Pasaribu and Schipper (2005) that the spec reproduces: the load figure is named after it.
    #[schemars(extend("x-default" = "none", "examples" = [5]))]
    pub figure_of_paper: Option<SphereFigure>,
}

/// Axes of the load figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Show {
    /// Load against indentation.
    #[default]
    Load,
    /// Normal approach against load.
    Approach,
}

/// One layer or a list of them.
#[derive(Debug)]
pub struct Layers(pub Vec<LayerSpec>);

written_schema!(Layers, |generator| schema::one_or_many(
    generator.subschema_for::<LayerSpec>(),
    "a layer, or a list of layers; keys as in `compare.layer`"
));

impl<'de> Deserialize<'de> for Layers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a layer such as { material = \"lead\", thickness = \"1.2 um\" }, or a list of layers";
        OneOrMany::read(deserializer, expected)?.at_least_one("layer").map(Self)
    }
}
