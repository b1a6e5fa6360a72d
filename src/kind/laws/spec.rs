//! `[laws]`: several laws on one asperity and on given surfaces.

use serde::Deserialize;
use toml::Spanned;

use crate::kind::compare::spec::{CompareSpec, RoughBody};
use crate::kind::compare::statistical::StatisticalSpec;
use asperity_framework::input::accept::AcceptSpec;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_framework::input::sweep::LogSweep;
use asperity_framework::input::tolerance::ToleranceSpec;

/// Two bodies, laws, one asperity, and the loads on the surfaces.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawsSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<RoughBody>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// The laws; the others are compared with the first.
    pub law: Spanned<Laws>,
    /// The asperity on which the laws are shown by themselves.
    pub asperity: Spanned<AsperitySpec>,
    /// How far it is pressed, in the indentation at which it begins to yield by Zhao, Maietta and Chang.
    pub indentation: Spanned<LogSweep<Pure>>,
    /// Nominal pressures at which the laws are compared on surfaces.
    pub pressure: Spanned<LogSweep<Pressure>>,
    /// The statistical model.
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest differences between the models that are accepted.
    #[serde(default)]
    pub accept: AcceptSpec,
    /// The surfaces to run on; all of the file by default.
    pub surfaces: Option<Vec<Spanned<String>>>,
}

#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table such as { radius = \"20 um\" }, and curvature-ratio for elliptic laws"
)]
pub struct AsperitySpec {
    /// 1/(mean curvature).
    pub radius: Quantity<Length>,
    /// The larger principal curvature over the smaller one, for elliptic laws.
    pub curvature_ratio: Option<Spanned<Quantity<Pure>>>,
}

impl LawsSpec {
    /// The part on surfaces, as a `[compare]` table.
    pub fn compared(&self) -> CompareSpec {
        CompareSpec {
            rough: self.rough.clone(),
            flat: self.flat.clone(),
            law: self.law.clone(),
            layer: None,
            models: None,
            reference: None,
            lines: None,
            statistical: self.statistical.clone(),
            accept: self.accept,
            robustness: false,
            attribution: false,
            rank_models: false,
            surfaces: self.surfaces.clone(),
            separation: None,
            tolerance: ToleranceSpec::default(),
            pressure: Some(self.pressure.clone()),
            force: None,
        }
    }
}
