//! Effect of the layer thickness on one surface under one law.

use asperity::Regime;
use asperity::compare::{GapQuantity, Kind};

use crate::kind::compare::answers::{CaseResults, Threshold};

/// What the thickness changes.
#[derive(Debug)]
pub struct LayerFindings {
    /// The models that were run, the statistical one first.
    pub models: Vec<Kind>,
    /// Loads at which thicknesses are compared, Pa, ascending.
    pub loads: Vec<f64>,
    /// How the plastic share of the load changes; `None` of one thickness, or where nothing is plastic.
    pub plastic: Option<PlasticRange>,
    /// How the difference between the models changes; `None` of one thickness, or without a valid result.
    pub gap: Option<GapRange>,
}

/// A value under one thickness of the layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtThickness {
    /// The thickness, m.
    pub thickness: f64,
    /// The value.
    pub value: f64,
}

/// Plastic shares of the load at one load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlasticRange {
    /// The nominal pressure, Pa.
    pub load: f64,
    /// The model.
    pub model: Kind,
    /// The largest share.
    pub largest: AtThickness,
    /// The smallest share.
    pub smallest: AtThickness,
}

/// Largest differences of d/sigma between the models at equal load, by thickness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapRange {
    /// The thickness under which it is largest.
    pub largest: AtThickness,
    /// The thickness under which it is smallest.
    pub smallest: AtThickness,
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
        let mut found = Self { models, loads, plastic: None, gap: None };
        if cases.len() > 1 {
            found.plastic = found.plastic_range(cases);
            found.gap = gap_range(cases);
        }
        Some(found)
    }

    /// The model shown where only one is: the sum, or the integral if it is the only one.
    pub fn main_model(&self) -> Kind {
        if self.models.contains(&Kind::Deterministic) { Kind::Deterministic } else { Kind::Statistical }
    }

    /// At the highest load, under the main model.
    fn plastic_range(&self, cases: &[&CaseResults]) -> Option<PlasticRange> {
        let load = *self.loads.last()?;
        let model = self.main_model();
        let share = |case: &CaseResults| {
            let shares = case.comparison.at_load(model, load)?.response.pressure.shares()?;
            Some(shares[Regime::Plastic as usize])
        };
        let [smallest, largest] = ends(cases, share)?;
        (largest.value > 0.0).then_some(PlasticRange { load, model, largest, smallest })
    }
}

fn gap_range(cases: &[&CaseResults]) -> Option<GapRange> {
    let gap = |case: &CaseResults| Some(case.gaps.of_quantity(GapQuantity::Separation)?.difference().abs());
    let [smallest, largest] = ends(cases, gap)?;
    Some(GapRange { largest, smallest })
}

/// The smallest and the largest value over the thicknesses that have one.
fn ends(cases: &[&CaseResults], value: impl Fn(&CaseResults) -> Option<f64>) -> Option<[AtThickness; 2]> {
    let at = |case: &&CaseResults| Some(AtThickness { thickness: case.thickness?, value: value(case)? });
    let all = || cases.iter().filter_map(at);
    let smallest = all().min_by(|a, b| a.value.total_cmp(&b.value))?;
    let largest = all().max_by(|a, b| a.value.total_cmp(&b.value))?;
    Some([smallest, largest])
}
