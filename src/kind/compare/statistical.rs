//! `statistical` in `[compare]`: which statistical model runs.

use std::fmt;

use asperity::MeanRadius;
use asperity::distribution::HeightModel;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

use asperity_framework::input::heights::HeightsSpec;

/// `statistical` as a spec writes it: a height density and one radius, independent of each other.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StatisticalSpec {
    /// The height density; Gaussian, or a population's own, by default.
    heights: Option<HeightModelSpec>,
    /// Which mean radius.
    #[serde(default)]
    mean_radius: MeanRadius,
}

/// The statistical model of a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StatisticalModel {
    /// The height density; `None` for Gaussian heights, or those of a population.
    pub heights: Option<HeightModel>,
    /// Which mean radius.
    pub mean_radius: MeanRadius,
}

impl From<&StatisticalSpec> for StatisticalModel {
    fn from(spec: &StatisticalSpec) -> Self {
        Self {
            heights: spec.heights.as_ref().map(|heights| heights.0.clone()),
            mean_radius: spec.mean_radius,
        }
    }
}

/// `heights` of the statistical model: a distribution, or how it follows from the set.
#[derive(Debug, Clone)]
struct HeightModelSpec(HeightModel);

impl<'de> Deserialize<'de> for HeightModelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;

        impl<'de> Visitor<'de> for NameOrTable {
            type Value = HeightModelSpec;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(&HeightsSpec::allowed(&HeightModel::FITTED.map(|fitted| fitted.name())))
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<HeightModelSpec, E> {
                if let Some(fitted) = HeightModel::FITTED.into_iter().find(|fitted| fitted.name() == name) {
                    return Ok(HeightModelSpec(fitted));
                }
                let also = HeightModel::FITTED.map(|fitted| fitted.name());
                let heights = HeightsSpec::named(name, &also).map_err(E::custom)?;
                Ok(HeightModelSpec(HeightModel::Given(heights.0)))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<HeightModelSpec, A::Error> {
                let heights = HeightsSpec::deserialize(MapAccessDeserializer::new(map))?;
                Ok(HeightModelSpec(HeightModel::Given(heights.0)))
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}
