//! `[indentation]`: one sphere on a layered flat.

use std::fmt;
use std::path::PathBuf;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

use crate::layer::LayerSpec;
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
        struct SomeLayers;

        impl<'de> Visitor<'de> for SomeLayers {
            type Value = Layers;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "a layer such as { material = \"lead\", thickness = \"1.2 um\" }, or a list of layers",
                )
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Layers, A::Error> {
                Ok(Layers(vec![LayerSpec::deserialize(MapAccessDeserializer::new(map))?]))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Layers, A::Error> {
                let mut layers = Vec::new();
                while let Some(layer) = list.next_element()? {
                    layers.push(layer);
                }
                if layers.is_empty() {
                    return Err(A::Error::custom("found an empty list; allowed: at least one layer"));
                }
                Ok(Layers(layers))
            }
        }
        deserializer.deserialize_any(SomeLayers)
    }
}
