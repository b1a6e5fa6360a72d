//! Where a deeper asperity has less area or load.

use asperity::sphere::DecreasingQuantity;

use crate::kind::compare::answers::FallResults;

/// Area or load that decreases with growing indentation under one law.
#[derive(Debug)]
pub struct Decreasing {
    /// Which of the two.
    pub of: DecreasingQuantity,
    /// Thicknesses of the layer under which it decreases, m; empty where no layer is asked for.
    pub thicknesses: Vec<f64>,
    /// The stretch on which most is lost.
    pub worst: FallResults,
}

impl Decreasing {
    /// Area, then load, as far as they decrease on these stretches of one law.
    pub fn among(falls: &[&FallResults]) -> Vec<Self> {
        DecreasingQuantity::ALL.into_iter().filter_map(|of| Self::of(falls, of)).collect()
    }

    fn of(falls: &[&FallResults], of: DecreasingQuantity) -> Option<Self> {
        let decreasing = || falls.iter().filter(|found| found.fall.of == of);
        let worst = decreasing().max_by(|a, b| a.fall.loss().total_cmp(&b.fall.loss()))?;
        let mut thicknesses: Vec<f64> = decreasing().filter_map(|found| found.thickness).collect();
        thicknesses.dedup();
        Some(Self { of, thicknesses, worst: FallResults::clone(worst) })
    }
}
