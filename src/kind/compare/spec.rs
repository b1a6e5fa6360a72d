//! `[compare]`: both models on the same surfaces, and the reference beside them.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use toml::Spanned;

use super::reference::ReferenceSpec;
use super::statistical::StatisticalSpec;
use crate::layer::LayerSpec;
use asperity::analytical::AnalyticalLine;
use asperity::compare::Kind;
use asperity_framework::input::accept::AcceptSpec;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Force, Pressure};
use asperity_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_framework::input::tolerance::ToleranceSpec;

/// Two bodies, laws, models and controls.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CompareSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<RoughBody>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// The laws to run.
    pub law: Spanned<Laws>,
    /// The layer on the flat.
    pub layer: Option<LayerSpec>,
    /// What to run; both models by default.
    pub models: Option<Spanned<Models>>,
    /// How the reference is run.
    pub reference: Option<Spanned<ReferenceSpec>>,
    /// Closed results beside the models.
    pub lines: Option<Spanned<Lines>>,
    /// The statistical model.
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest differences between the models that are accepted.
    #[serde(default)]
    pub accept: AcceptSpec,
    /// Whether the verdicts on measured maps are computed again under other treatments of the map.
    #[serde(default = "yes")]
    pub robustness: bool,
    /// Whether the gap between the models is divided among its causes.
    #[serde(default = "yes")]
    pub attribution: bool,
    /// Whether all statistical models are compared with sum and reference.
    #[serde(default = "yes")]
    pub rank_models: bool,
    /// The surfaces to run on; all of the file by default.
    pub surfaces: Option<Vec<Spanned<String>>>,
    /// d/sigma.
    pub separation: Option<LinearSweep>,
    /// Relative tolerance of load and area of the curves over d/sigma; exact by default.
    #[serde(default)]
    pub tolerance: ToleranceSpec,
    /// Nominal pressures.
    pub pressure: Option<Spanned<LogSweep<Pressure>>>,
    /// Forces on the nominal area.
    pub force: Option<Spanned<LogSweep<Force>>>,
}

fn yes() -> bool {
    true
}

/// The name of one material: a second rough body is not modelled.
#[derive(Debug, Clone)]
pub struct RoughBody(pub String);

impl<'de> Deserialize<'de> for RoughBody {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneName;

        impl<'de> Visitor<'de> for OneName {
            type Value = RoughBody;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of one material")
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<RoughBody, E> {
                Ok(RoughBody(name.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, _: A) -> Result<RoughBody, A::Error> {
                Err(A::Error::custom(
                    "found a list; allowed: one rough body against a smooth flat. For two rough bodies enter \
                     the composite surface: the sum of both height maps, or a population with the composite \
                     sigma and curvature",
                ))
            }
        }
        deserializer.deserialize_any(OneName)
    }
}

/// A list of models and the reference, none twice, at least one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Vec<ModelName>")]
pub struct Models {
    /// The models.
    pub kinds: Vec<Kind>,
    /// Whether the reference runs.
    pub has_reference: bool,
}

/// One of `models`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum ModelName {
    Statistical,
    Deterministic,
    Reference,
}

impl Default for Models {
    fn default() -> Self {
        Self { kinds: vec![Kind::Statistical, Kind::Deterministic], has_reference: false }
    }
}

impl TryFrom<Vec<ModelName>> for Models {
    type Error = String;

    fn try_from(names: Vec<ModelName>) -> Result<Self, String> {
        const ALLOWED: &str =
            "allowed: one or more of \"statistical\", \"deterministic\" and \"reference\", each once";
        if names.is_empty() {
            return Err(format!("found an empty list; {ALLOWED}"));
        }
        if (1..names.len()).any(|k| names[..k].contains(&names[k])) {
            return Err(format!("found a model twice; {ALLOWED}"));
        }
        let kind = |name: &ModelName| match name {
            ModelName::Statistical => Some(Kind::Statistical),
            ModelName::Deterministic => Some(Kind::Deterministic),
            ModelName::Reference => None,
        };
        Ok(Self {
            kinds: names.iter().filter_map(kind).collect(),
            has_reference: names.contains(&ModelName::Reference),
        })
    }
}

/// A list of lines, none twice, at least one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Vec<AnalyticalLine>")]
pub struct Lines(pub Vec<AnalyticalLine>);

impl TryFrom<Vec<AnalyticalLine>> for Lines {
    type Error = String;

    fn try_from(lines: Vec<AnalyticalLine>) -> Result<Self, String> {
        let names: Vec<String> =
            AnalyticalLine::ALL.iter().map(|line| format!("\"{}\"", line.name())).collect();
        let allowed = format!("allowed: one or more of {}, each once", names.join(", "));
        if lines.is_empty() {
            return Err(format!("found an empty list; {allowed}"));
        }
        if (1..lines.len()).any(|k| lines[..k].contains(&lines[k])) {
            return Err(format!("found a line twice; {allowed}"));
        }
        Ok(Self(lines))
    }
}
