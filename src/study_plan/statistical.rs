//! `statistical` in a spec: which statistical model runs.

use asperity::MeanRadius;
use asperity::distribution::HeightModel;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

use asperity::study::{JointModel, StatisticalModel};
use asperity_contact_framework::input::heights;

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

asperity_contact_framework::written_schema!(HeightModelSpec, |_| heights::schema(
    &HeightModel::FITTED.map(|fitted| fitted.name())
));

impl<'de> Deserialize<'de> for HeightModelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let fitted = HeightModel::FITTED.map(|fitted| (fitted.name(), fitted));
        heights::read_or(deserializer, &fitted, HeightModel::Given).map(Self)
    }
}
