//! `[indentation]`: one sphere on a layered flat.

use std::path::PathBuf;

use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::layer::LayerSpec;
use asperity_framework::input::OneOrMany;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Length, Quantity};
use asperity_framework::input::sweep::LogSweep;

/// A ball, a flat, its layers, laws and indentations.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct IndentationSpec {
    /// Name of the ball's material.
    pub ball: Spanned<String>,
    /// Radius of the ball.
    pub radius: Quantity<Length>,
    /// Name of the substrate's material.
    pub flat: Spanned<String>,
    /// The layers on the flat: each layer by itself.
    pub layer: Spanned<Layers>,
    /// The laws to run.
    pub law: Spanned<Laws>,
    /// How far the ball is pressed in.
    pub indentation: Spanned<LogSweep<Length>>,
    /// A file of measured points, laid over the curves.
    pub overlay: Option<Spanned<PathBuf>>,
    /// Axes of the load figure.
    #[serde(default)]
    pub show: Show,
}

/// Axes of the load figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
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

impl<'de> Deserialize<'de> for Layers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a layer such as { material = \"lead\", thickness = \"1.2 um\" }, or a list of layers";
        OneOrMany::read(deserializer, expected)?.at_least_one("layer").map(Self)
    }
}
