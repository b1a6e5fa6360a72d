//! Where a deeper asperity has less area or load.

use asperity::sphere::DecreasingQuantity;

use crate::kind::compare::answers::DecreaseResults;

/// Area or load that decreases with growing indentation under one law.
#[derive(Debug)]
pub struct Decreasing {
    /// Which of the two.
    pub of: DecreasingQuantity,
    /// Thicknesses of the layer under which it decreases, m; empty without a layer in the spec.
    pub thicknesses: Vec<f64>,
    /// The range with the largest relative decrease.
    pub worst: DecreaseResults,
}

impl Decreasing {
    /// Area, then load, where they decrease in these ranges of one law.
    pub fn among(decreases: &[&DecreaseResults]) -> Vec<Self> {
        DecreasingQuantity::ALL.into_iter().filter_map(|of| Self::of(decreases, of)).collect()
    }

    fn of(decreases: &[&DecreaseResults], of: DecreasingQuantity) -> Option<Self> {
        let decreasing = || decreases.iter().filter(|found| found.decrease.of == of);
        let worst = decreasing().max_by(|a, b| a.decrease.loss().total_cmp(&b.decrease.loss()))?;
        let mut thicknesses: Vec<f64> = decreasing().filter_map(|found| found.thickness).collect();
        thicknesses.dedup();
        Some(Self { of, thicknesses, worst: DecreaseResults::clone(worst) })
    }
}
