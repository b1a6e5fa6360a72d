//! Effect of the layer thickness on one surface under one law.

use asperity::compare::Kind;

use crate::kind::compare::answers::{CaseResults, Threshold};

/// What the thickness changes.
#[derive(Debug)]
pub struct LayerFindings {
    /// The models that were run, the statistical one first.
    pub models: Vec<Kind>,
    /// Loads at which thicknesses are compared, Pa, ascending.
    pub loads: Vec<f64>,
}

impl LayerFindings {
    /// Of the `cases` and `thresholds` of one law; `None` without a layer in the spec.
    pub fn of(cases: &[&CaseResults], thresholds: &[&Threshold]) -> Option<Self> {
        if cases.iter().any(|case| case.thickness.is_none()) {
            return None;
        }
        let mut loads: Vec<f64> = thresholds.iter().map(|threshold| threshold.pressure).collect();
        loads.sort_unstable_by(f64::total_cmp);
        loads.dedup();
        let is_used = |kind: &Kind| {
            cases.iter().any(|case| case.comparison.curves.iter().any(|point| point.kind == *kind))
        };
        let models = [Kind::Statistical, Kind::Deterministic].into_iter().filter(is_used).collect();
        Some(Self { models, loads })
    }

    /// The model shown where only one is: the sum, or the integral if it is the only one.
    pub fn main_model(&self) -> Kind {
        if self.models.contains(&Kind::Deterministic) { Kind::Deterministic } else { Kind::Statistical }
    }
}
