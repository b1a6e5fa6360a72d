//! A case: one surface under one law and layer thickness, over all realisations.

use super::dependence::{Dependence, Treated};
use super::ranking::Ranking;
use super::results::{CaseResults, RealisationFacts, RealisationResults};
use super::two_bodies::{GreenwoodTrippPoint, ShortcutResult};
use super::verdicts::Verdicts;
use crate::compare::{Accepted, Realisation, Spread, spread};
use crate::surface::Surface;

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
