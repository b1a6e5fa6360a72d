//! What a layer changes on one surface.

use crate::Exceeded;
use crate::compare::ModelKind;
use crate::sphere::Decrease;

use super::case::CaseStudy;

/// What the thickness changes.
#[derive(Debug)]
pub struct LayerFindings {
    /// The models that were run, the statistical one first.
    pub models: Vec<ModelKind>,
    /// Loads at which thicknesses are compared, Pa, ascending.
    pub loads: Vec<f64>,
}

/// A range of indentations in which area or load of an asperity decreases.
#[derive(Debug, Clone)]
pub struct DecreaseResults {
    /// The law.
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// Of the asperity, m.
    pub radius: f64,
    /// The range.
    pub decrease: Decrease,
}

/// Largest thickness at which the real area is within 5 % of the uncoated one.
#[derive(Debug, Clone)]
pub struct Threshold {
    /// The law.
    pub law: String,
    /// The model.
    pub kind: ModelKind,
    /// The nominal pressure, Pa.
    pub pressure: f64,
    /// The limits that one of the models exceeds at that pressure without the layer: the load is then not admissible, and has no threshold.
    pub exceeded: Exceeded,
    /// The thickness, m: infinite where no layer has an effect, `None` where the thinnest one tested has, and where the load is not
    /// admissible.
    pub thickness: Option<f64>,
}

impl LayerFindings {
    /// Of the `cases` and `thresholds` of one law; `None` without a layer in the spec.
    pub fn new(cases: &[&CaseStudy], thresholds: &[&Threshold]) -> Option<Self> {
        if cases.iter().any(|case| case.first().thickness.is_none()) {
            return None;
        }
        let mut loads: Vec<f64> = thresholds.iter().map(|threshold| threshold.pressure).collect();
        loads.sort_unstable_by(f64::total_cmp);
        loads.dedup();
        let is_used = |kind: &ModelKind| {
            cases.iter().any(|case| case.first().comparison.curves.iter().any(|point| point.kind == *kind))
        };
        let models = [ModelKind::Statistical, ModelKind::Deterministic].into_iter().filter(is_used).collect();
        Some(Self { models, loads })
    }

    /// The model shown where only one is: the sum, or the integral if it is the only one.
    pub fn main_model(&self) -> ModelKind {
        if self.models.contains(&ModelKind::Deterministic) {
            ModelKind::Deterministic
        } else {
            ModelKind::Statistical
        }
    }
}

/// One law, all thicknesses together, on the first realisation.
#[derive(Debug)]
pub struct LawFindings {
    /// The law, as tables name it.
    pub law: String,
    /// Effect of the layer thickness; `None` without a layer in the spec.
    pub layer: Option<LayerFindings>,
}

impl LawFindings {
    /// Of every law, in file order.
    pub fn all(cases: &[CaseStudy], thresholds: &[Threshold]) -> Vec<Self> {
        let mut laws: Vec<&str> = cases.iter().map(|case| case.first().law.as_str()).collect();
        laws.dedup();
        let findings = |law: &str| {
            let cases: Vec<&CaseStudy> = cases.iter().filter(|case| case.first().law == law).collect();
            let thresholds: Vec<&Threshold> =
                thresholds.iter().filter(|threshold| threshold.law == law).collect();
            Self { law: law.to_owned(), layer: LayerFindings::new(&cases, &thresholds) }
        };
        laws.into_iter().map(findings).collect()
    }
}
