//! Findings of a comparison as typed facts; the report only phrases them.
//!
//! | file | what lives there |
//! |---|---|
//! | `recommendation` | which model to use, and why |
//! | `layer` | what the thickness of a layer changes |
//! | `decreasing` | where a deeper asperity has less area or load |
//! | `readings` | what reading sigma and d as those of the surface changes |

mod decreasing;
mod layer;
mod readings;
mod recommendation;

pub use decreasing::Decreasing;
pub use layer::{AtThickness, GapRange, LayerFindings, PlasticRange};
pub use readings::{ReadAnswer, ReadLoads, Readings};
pub use recommendation::Recommendation;

use asperity::compare::{Pairing, PointCounts, Realisation, Spread, SpreadFindings, spread, valid_stretches};

use super::answers::{CaseResults, DecreaseResults, RealisationResults, Threshold};
use crate::surface::Surface;

/// Findings on one surface.
#[derive(Debug)]
pub struct SurfaceFindings {
    /// One per case, in the order of the results.
    pub cases: Vec<CaseFindings>,
    /// Law by law, in file order.
    pub laws: Vec<LawFindings>,
}

/// One law and thickness, over all realisations.
#[derive(Debug)]
pub struct CaseFindings {
    /// Both models at the loads that all realisations have in common; empty for a single realisation.
    pub spread: Vec<Spread>,
    /// Difference between the models over the realisations; `None` without a common valid load.
    pub over_realisations: Option<SpreadFindings>,
    /// First and last of each stretch of neighbouring loads (Pa) on which a finding may rest.
    pub valid_loads: Vec<[f64; 2]>,
    /// Which model to use; `None` without a valid result.
    pub recommendation: Option<Recommendation>,
}

/// One law, all thicknesses together, on the first realisation.
#[derive(Debug)]
pub struct LawFindings {
    /// The law, as tables name it.
    pub law: String,
    /// At how many points the models do not hold.
    pub counts: PointCounts,
    /// What decreases with growing indentation, area before load.
    pub decreasing: Vec<Decreasing>,
    /// Effect of the layer thickness; `None` without a layer in the spec.
    pub layer: Option<LayerFindings>,
}

impl SurfaceFindings {
    /// Of the first realisation `surface`, the results of all `realisations`, and the findings on the first.
    pub fn of(
        surface: &Surface,
        realisations: &[&RealisationResults],
        thresholds: &[Threshold],
        decreases: &[DecreaseResults],
    ) -> Self {
        let first = realisations[0];
        let mut laws: Vec<&str> = first.cases.iter().map(|case| case.law.as_str()).collect();
        laws.dedup();
        Self {
            cases: (0..first.cases.len())
                .map(|index| CaseFindings::of(surface, realisations, index))
                .collect(),
            laws: laws
                .into_iter()
                .map(|law| LawFindings::of(surface, first, law, thresholds, decreases))
                .collect(),
        }
    }
}

impl CaseFindings {
    fn of(surface: &Surface, realisations: &[&RealisationResults], index: usize) -> Self {
        let pairs: Vec<Realisation> = realisations
            .iter()
            .map(|answered| {
                (&answered.cases[index].comparison.pairs[..], answered.sigma, answered.nominal_area)
            })
            .collect();
        let spread = spread(&pairs);
        let over_realisations = SpreadFindings::of(&spread, realisations.len());
        let gaps = &realisations[0].cases[index].gaps;
        let is_significant = match &over_realisations {
            Some(found) => Some(found.is_significant()),
            None => (!gaps.largest.is_empty()).then(|| gaps.is_significant()),
        };
        let recommendation =
            is_significant.map(|is_significant| Recommendation::new(surface, is_significant));
        let valid_loads = if over_realisations.is_some() {
            valid_stretches(spread.iter().map(|at| (at.target, at.is_valid())))
        } else {
            let (pairs, _, area) = pairs[0];
            let at_load = pairs.iter().filter(|pair| pair.pairing == Pairing::Load);
            valid_stretches(at_load.map(|pair| (pair.target, pair.is_valid(area))))
        };
        Self { spread, over_realisations, valid_loads, recommendation }
    }
}

impl LawFindings {
    fn of(
        surface: &Surface,
        first: &RealisationResults,
        law: &str,
        thresholds: &[Threshold],
        decreases: &[DecreaseResults],
    ) -> Self {
        let cases: Vec<_> = first.cases.iter().filter(|case| case.law == law).collect();
        let thresholds: Vec<_> = thresholds.iter().filter(|threshold| threshold.law == law).collect();
        let decreases: Vec<_> = decreases.iter().filter(|found| found.law == law).collect();
        let counts = |case: &&CaseResults| PointCounts::of(&case.comparison, surface.set.nominal_area());
        Self {
            law: law.to_owned(),
            counts: cases.iter().map(counts).sum(),
            decreasing: Decreasing::among(&decreases),
            layer: LayerFindings::of(surface, &cases, &thresholds),
        }
    }
}
