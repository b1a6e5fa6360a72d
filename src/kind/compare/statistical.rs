//! `statistical` in `[compare]`: which statistical model runs.

use std::fmt;

use asperity::MeanRadius;
use asperity::distribution::HeightModel;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

use crate::study::{JointModel, StatisticalModel};
use asperity_framework::input::heights::{self, HeightsSpec};

/// `statistical` as a spec writes it: a height density and one radius, independent of each other, or a joint density of both.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct StatisticalSpec {
    /// The height density.
    #[schemars(extend("x-default" = "gaussian, or that of the population", "examples" = ["own"]))]
    heights: Option<HeightModelSpec>,
    /// Which mean radius all asperities have.
    #[schemars(extend("default" = "arithmetic", "examples" = ["in-contact"]))]
    mean_radius: Option<MeanRadius>,
    /// A joint density of height and curvature, on surfaces with a map; instead of `heights` and `mean-radius`.
    #[schemars(extend("x-default" = "none", "examples" = ["nayak-greenwood"]))]
    model: Option<JointModel>,
}

impl StatisticalSpec {
    /// The model.
    ///
    /// # Errors
    /// A joint density together with heights or a radius.
    pub fn model(&self) -> Result<StatisticalModel, String> {
        if let Some(joint) = self.model
            && (self.heights.is_some() || self.mean_radius.is_some())
        {
            return Err(format!(
                "model = \"{}\" has its own heights and radii; leave out `heights` and `mean-radius`, or `model`",
                joint.name()
            ));
        }
        Ok(StatisticalModel {
            heights: self.heights.as_ref().map(|heights| heights.0.clone()),
            mean_radius: self.mean_radius.unwrap_or_default(),
            joint: self.model,
        })
    }
}

/// `heights` of the statistical model: a distribution, or how it follows from the set.
#[derive(Debug, Clone)]
struct HeightModelSpec(HeightModel);

asperity_framework::written_schema!(HeightModelSpec, |_| heights::schema(
    &HeightModel::FITTED.map(|fitted| fitted.name())
));

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
