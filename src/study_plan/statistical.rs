//! `rough` and `statistical` in a spec, and how good the effective-modulus models of a layer are.

use asperity::compare::{ModulusCheck, ModulusFindings};
use asperity::distribution::HeightModel;
use asperity::study::{JointModel, StatisticalModel};
use asperity::{ContactError, MeanRadius, Paper};
use asperity_contact_framework::contact::LayerMetadata;
use asperity_contact_framework::input::schema::TYPE;
use asperity_contact_framework::input::{Forms, InputError, heights};
use asperity_contact_framework::{RunContext, written_schema};
use schemars::JsonSchema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::StudyPlan;
use crate::layer::LayerPlan;

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

/// The name of one material: that of the other body is `flat`, also where it is rough.
#[derive(Debug, Clone)]
pub struct RoughBody(pub String);

written_schema!(RoughBody, |_| json!({ "type": "string", TYPE: "name of a material" }));

impl<'de> Deserialize<'de> for RoughBody {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("the name of one material")
            .text(|name| Ok(Self(name.to_owned())))
            .list(|_: Vec<IgnoredAny>| {
                Err("found a list; allowed: one material, that of the rough body. For two rough bodies use \
                     [surface.NAME.pair], the sum of both height maps, with the second material as `flat`; or a population with the \
                     composite sigma and curvature"
                    .to_owned())
            })
            .read(deserializer)
    }
}

/// The layer, and the check of its rule where some contact is under it, whose sources are added to `papers`.
///
/// # Errors
/// A layer that the exact solution does not apply to.
pub fn layer_metadata(
    context: &RunContext,
    plan: &StudyPlan,
    papers: &mut Vec<Paper>,
) -> Result<Option<LayerMetadata>, InputError> {
    let Some(layer) = &plan.layer else { return Ok(None) };
    let mut check = None;
    if plan.uses_rule(layer) {
        let (findings, rules) =
            rule_check(plan, layer).map_err(|error| InputError::file(&context.source.path, error))?;
        papers.extend(rules);
        check = Some(findings);
    }
    let thicknesses = layer.thicknesses.clone();
    Ok(Some(LayerMetadata { name: layer.name.clone(), rule: layer.rule, on: layer.on, thicknesses, check }))
}

/// How good both rules are between the materials of a study.
fn rule_check(plan: &StudyPlan, layer: &LayerPlan) -> Result<(ModulusFindings, Vec<Paper>), ContactError> {
    /// a/t, from and to.
    const RANGE: [f64; 2] = [0.1, 10.0];
    let [bare, substrate] = plan.bare_and_coated();
    let check = ModulusCheck::new(bare, &layer.coating.material, substrate)?;
    Ok((check.findings(RANGE[0], RANGE[1]), check.papers()))
}
