//! Results of both models: of a realisation of a surface, of a case on it, and of a case over all realisations, with the verdicts against
//! the reference.

use super::dependence::{Dependence, Treated};
use super::models::StatisticalModel;
use super::ranking::Ranking;
use super::two_bodies::{GreenwoodTrippPoint, ShortcutResult};
use super::verdicts::Verdicts;
use crate::compare::{
    Accepted, AgainstReference, Attribution, Comparison, Difference, Gaps, NearerStretch, NotModelled, Pair,
    Pairing, Realisation, ReferenceCurve, ReferencePoint, Repeats, Spread, Stretch, spread,
};
use crate::surface::Surface;
use crate::topography::RoughnessParameters;
use crate::{Population, Statistics};

/// One realisation of a surface.
#[derive(Debug)]
pub struct RealisationFacts {
    /// Number of asperities.
    pub asperities: usize,
    /// Nominal area, m^2.
    pub nominal_area: f64,
    /// Statistics of the asperities.
    pub statistics: Statistics,
    /// What d is measured in, m.
    pub sigma: f64,
    /// Of the map that they were found on.
    pub roughness: Option<RoughnessParameters>,
    /// Input of the statistical model.
    pub population: Population,
    /// The statistical model.
    pub model: StatisticalModel,
}

/// Results on one realisation of a surface.
#[derive(Debug)]
pub struct RealisationResults {
    /// Its asperities and the model of them.
    pub facts: RealisationFacts,
    /// Law by law, thickness by thickness.
    pub cases: Vec<CaseResults>,
}

/// One case on one realisation.
#[derive(Debug)]
pub struct CaseResults {
    /// The law, as tables name it.
    pub law: String,
    /// Whether contacts yield under it.
    pub yields: bool,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Results of both models.
    pub comparison: Comparison,
    /// The largest gaps between them.
    pub gaps: Gaps,
    /// The differences at equal load, in the order of the pairs, with their sampling uncertainty.
    pub differences: Vec<Difference>,
    /// Why there is no model-based interval on a small map; `None` where there is one, and on other surfaces.
    pub not_modelled: Option<NotModelled>,
    /// The differences divided among their causes, in the order of the pairs at equal load; empty where none is asked for.
    pub attribution: Vec<Attribution>,
    /// The reference; `None` where none is asked for.
    pub reference: Option<ReferenceCurve>,
    /// How far both models are from it, in the order of the pairs.
    pub against_reference: AgainstReference,
}

impl CaseResults {
    /// The gap of a pair at equal load divided among its causes; `None` for other pairs, and where it is not divided.
    pub fn attribution_of(&self, pair: &Pair) -> Option<&Attribution> {
        self.attribution.iter().filter(|_| pair.pairing == Pairing::Load).find(|at| at.load == pair.target)
    }

    /// The reference at the load of a pair of both models; `None` where it did not run.
    pub fn reference_of(&self, pair: &Pair) -> Option<&ReferencePoint> {
        self.reference.as_ref().filter(|_| pair.pairing == Pairing::Load)?.at_load(pair.target)
    }
}

/// One case over all realisations, with what follows from them.
#[derive(Debug)]
pub struct CaseStudy {
    /// Results on each realisation; at least one.
    pub realisations: Vec<CaseResults>,
    /// Both models at the loads that all realisations have in common; empty for a single realisation.
    pub spread: Vec<Spread>,
    /// Whether the statistical model may be used.
    pub verdicts: Verdicts,
    /// The other statistical models on the first realisation, where they were ranked.
    pub ranking: Option<Ranking>,
    /// Of two rough bodies, what is usual in place of their sum.
    pub shortcuts: Vec<ShortcutResult>,
    /// Of two rough bodies, the curve of Greenwood and Tripp, where they allow it.
    pub greenwood_tripp: Vec<GreenwoodTrippPoint>,
    /// The differences under other treatments of a measured map.
    pub treated: Vec<Treated>,
    /// The choices in the analysis of the map that decide a verdict.
    pub dependences: Vec<Dependence>,
}

impl CaseStudy {
    /// The cases of a surface from the results on its `realisations`, of which `surface` is the first. The verdicts compare the
    /// differences with those accepted; ranking and treatments are empty.
    pub fn all(
        surface: &Surface,
        realisations: Vec<RealisationResults>,
        accepted: Accepted,
    ) -> (Vec<RealisationFacts>, Vec<Self>) {
        let mut facts = Vec::new();
        let mut cases: Vec<Vec<CaseResults>> = Vec::new();
        for realisation in realisations {
            facts.push(realisation.facts);
            for (index, case) in realisation.cases.into_iter().enumerate() {
                if index == cases.len() {
                    cases.push(Vec::new());
                }
                cases[index].push(case);
            }
        }
        let sigmas: Vec<f64> = facts.iter().map(|facts| facts.sigma).collect();
        let study = |realisations: Vec<CaseResults>| {
            let pairs: Vec<Realisation> = realisations
                .iter()
                .zip(&sigmas)
                .map(|(case, &sigma)| (&case.comparison.pairs[..], sigma))
                .collect();
            Self {
                spread: spread(&pairs),
                verdicts: Verdicts::new(surface, &realisations, accepted),
                ranking: None,
                shortcuts: Vec::new(),
                greenwood_tripp: Vec::new(),
                treated: Vec::new(),
                dependences: Vec::new(),
                realisations,
            }
        };
        let cases = cases.into_iter().map(study).collect();
        (facts, cases)
    }

    /// Results on the first realisation.
    pub fn first(&self) -> &CaseResults {
        &self.realisations[0]
    }

    /// The loads (Pa) at which the verdicts were computed again under other treatments, ascending.
    pub fn treated_loads(&self) -> Vec<f64> {
        let longest = self.treated.iter().max_by_key(|treated| treated.differences.len());
        longest.map_or_else(Vec::new, |treated| treated.differences.iter().map(|at| at.load).collect())
    }
}

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
