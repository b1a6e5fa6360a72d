//! Findings of a comparison as typed facts; the report only phrases them.
//!
//! | file | what lives there |
//! |---|---|
//! | `verdicts` | whether the statistical model may be used, by quantity and stretch of load |
//! | `causes` | why the models differ, and why they differ from the reference |
//! | `reference` | which model is nearer to the reference, and whether it is near enough |
//! | `layer` | what the thickness of a layer changes |
//! | `readings` | what reading sigma and d as those of the surface changes |

mod causes;
mod layer;
mod readings;
mod reference;
mod verdicts;

pub use causes::LeadingCause;
pub use layer::LayerFindings;
pub use readings::{ReadAnswer, ReadLoads, Readings};
pub use reference::ReferenceVerdicts;
pub use verdicts::{Basis, Verdicts};

use asperity::compare::{PointCounts, Realisation, Spread, spread};
use asperity_framework::input::accept::AcceptSpec;

use super::answers::{CaseResults, RealisationResults, Threshold};
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
    /// Whether the statistical model may be used.
    pub verdicts: Verdicts,
}

/// One law, all thicknesses together, on the first realisation.
#[derive(Debug)]
pub struct LawFindings {
    /// The law, as tables name it.
    pub law: String,
    /// At how many points the models do not hold.
    pub counts: PointCounts,
    /// Effect of the layer thickness; `None` without a layer in the spec.
    pub layer: Option<LayerFindings>,
}

impl SurfaceFindings {
    /// Of the first realisation `surface`, the results of all `realisations`, and the findings on the first.
    pub fn of(
        surface: &Surface,
        realisations: &[&RealisationResults],
        thresholds: &[Threshold],
        accept: AcceptSpec,
    ) -> Self {
        let first = realisations[0];
        let mut laws: Vec<&str> = first.cases.iter().map(|case| case.law.as_str()).collect();
        laws.dedup();
        Self {
            cases: (0..first.cases.len())
                .map(|index| CaseFindings::of(surface, realisations, index, accept))
                .collect(),
            laws: laws.into_iter().map(|law| LawFindings::of(first, law, thresholds)).collect(),
        }
    }
}

impl CaseFindings {
    fn of(surface: &Surface, realisations: &[&RealisationResults], index: usize, accept: AcceptSpec) -> Self {
        let pairs: Vec<Realisation> = realisations
            .iter()
            .map(|answered| (&answered.cases[index].comparison.pairs[..], answered.sigma))
            .collect();
        let accepted = accept.on(surface.plane.sigma);
        Self { spread: spread(&pairs), verdicts: Verdicts::of(surface, realisations, index, accepted) }
    }
}

impl LawFindings {
    fn of(first: &RealisationResults, law: &str, thresholds: &[Threshold]) -> Self {
        let cases: Vec<_> = first.cases.iter().filter(|case| case.law == law).collect();
        let thresholds: Vec<_> = thresholds.iter().filter(|threshold| threshold.law == law).collect();
        let counts = |case: &&CaseResults| PointCounts::of(&case.comparison);
        Self {
            law: law.to_owned(),
            counts: cases.iter().map(counts).sum(),
            layer: LayerFindings::of(&cases, &thresholds),
        }
    }
}
