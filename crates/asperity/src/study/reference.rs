//! Verdicts on both models against the reference, on one surface under one law and thickness.

use crate::compare::{Accepted, AgainstReference, NearerStretch, Repeats, Stretch};

use super::results::CaseResults;

/// Which model is nearer to the reference, and whether it is near enough.
#[derive(Debug)]
pub struct ReferenceVerdicts {
    /// The differences, by growing load; over several realisations their mean.
    pub against: AgainstReference,
    /// The verdicts on the statistical and on the deterministic model: quantity by quantity, by growing load.
    pub stretches: [Vec<Stretch>; 2],
    /// Loads at which both stand alike: quantity by quantity, by growing load; of elastic contacts on a homogeneous half-space also
    /// loads at which only strains are large.
    pub nearer: Vec<NearerStretch>,
    /// Whether sum or reference yields: the cap is not the law.
    pub yields: bool,
    /// Whether there is a layer, which the sum replaces by an effective modulus.
    pub is_layered: bool,
}

impl ReferenceVerdicts {
    /// Of a case on all `repeats` of a surface; `None` where no load was compared.
    pub fn new(realisations: &[CaseResults], repeats: Repeats, accepted: &Accepted) -> Option<Self> {
        let cases = || realisations.iter();
        let each: Vec<AgainstReference> = cases().map(|case| case.against_reference.clone()).collect();
        let against = AgainstReference::over(&each, repeats).sorted();
        let yields = cases().any(|case| {
            let cap = case.reference.as_ref().and_then(|curve| curve.cap);
            cap.is_some() || case.yields
        });
        let is_layered = cases().any(|case| case.thickness.is_some_and(|t| t > 0.0 && t.is_finite()));
        (!against.nearness.is_empty()).then(|| Self {
            stretches: [0, 1].map(|model| Stretch::all(&against.models[model], accepted)),
            nearer: NearerStretch::all(&against, accepted, !yields && !is_layered),
            against,
            yields,
            is_layered,
        })
    }
}
