//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters.

use serde::Deserialize;
use toml::Spanned;

use asperity_framework::input::Whole;
use asperity_framework::input::accept::AcceptSpec;
use asperity_framework::input::law::Laws;
use asperity_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_framework::input::sweep::LogSweep;
use asperity_framework::input::tolerance::ToleranceSpec;

use crate::kind::compare::spec::{CompareSpec, RoughBody};
use crate::kind::compare::statistical::StatisticalSpec;

/// Two bodies, a law, loads, sampling intervals and filters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SamplingIntervalSpec {
    /// Name of the rough body's material.
    pub rough: Spanned<RoughBody>,
    /// Name of the flat body's material.
    pub flat: Spanned<String>,
    /// The one law.
    pub law: Spanned<Laws>,
    /// Nominal pressures.
    pub pressure: Spanned<LogSweep<Pressure>>,
    /// Sampling intervals in pixels; 1, 2, 4 and 8 by default.
    pub intervals: Option<Spanned<Vec<Whole>>>,
    /// Nesting indices of S filters, in multiples of `nesting-index`; 1, 2, 4 and 8 by default, none of an empty list.
    pub s_filter: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// The nesting index that they are multiples of; five pixels by default.
    pub nesting_index: Option<Spanned<Quantity<Length>>>,
    /// The statistical model.
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest changes of the gap between the models that are accepted.
    #[serde(default)]
    pub accept: AcceptSpec,
    /// The surfaces to run on; all of the file by default.
    pub surfaces: Option<Vec<Spanned<String>>>,
}

impl SamplingIntervalSpec {
    /// Both models at the loads, as a `[compare]` table.
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
            attribution: true,
            rank_models: false,
            surfaces: self.surfaces.clone(),
            separation: None,
            tolerance: ToleranceSpec::default(),
            pressure: Some(self.pressure.clone()),
            force: None,
        }
    }
}
