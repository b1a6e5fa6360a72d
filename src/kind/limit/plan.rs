//! `[limit]` resolved: laws on their bodies, sizes checked.

use std::fmt;

use asperity::{Flat, Heights, Population};
use asperity_framework::contact::{Bodies, LawPlan};
use asperity_framework::input::{InputError, SpecFile};
use asperity_framework::{Memory, Plan, RunContext, set_memory};

use super::run::{LimitResults, run};
use super::spec::LimitSpec;

/// Sets of growing size against their limit.
pub struct LimitPlan {
    pub bodies: Bodies,
    pub laws: Vec<LawPlan>,
    pub sets: SetsPlan,
}

/// The sets of asperities.
#[derive(Debug, Clone)]
pub struct SetsPlan {
    /// What they are drawn from.
    pub population: Population,
    /// d/sigma.
    pub separations: Vec<f64>,
    pub counts: Vec<usize>,
    /// Random sets of each size.
    pub draws: usize,
}

impl LimitPlan {
    pub(super) fn new(file: &SpecFile, raw: &LimitSpec) -> Result<Self, InputError> {
        let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
        let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
        let counts = file.counts(&raw.count)?;
        let draws = file.several(&raw.draws, "random sets of each size")?;
        file.spheres_only(&raw.law, "the asperities of [limit] are spheres of equal radius")?;
        file.check_laws(&raw.law, (rough, &pair[0]), &[(flat, &pair[1])])?;
        let laws = file.law_plans(&raw.law, (rough, &pair[0]), &[(None, Flat::Bare(pair[1]))], flat)?;
        let population = Population {
            radius: raw.radius.value(),
            sigma: raw.sigma.value(),
            density: raw.density.value(),
            heights: Heights::GAUSSIAN,
        };
        let sets = SetsPlan { population, separations: raw.separation.0.clone(), counts, draws };
        Ok(Self { bodies: Bodies { rough: rough.clone(), flat: flat.clone() }, laws, sets })
    }
}

impl Plan for LimitPlan {
    type Outcome = LimitResults;

    fn memory(&self) -> Memory {
        let largest = self.sets.counts.iter().copied().max().unwrap_or(0);
        Memory { bytes: set_memory(largest as u128), key: None }
    }

    fn work(&self) -> u128 {
        let SetsPlan { separations, counts, draws, .. } = &self.sets;
        let asperities: u128 = counts.iter().map(|&count| count as u128).sum();
        asperities * ((draws + 1) * self.laws.len() * separations.len()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<LimitResults, InputError> {
        run(context, self)
    }
}

impl fmt::Display for LimitPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { bodies, laws, sets: SetsPlan { counts, draws, .. } } = self;
        let laws: Vec<&str> = laws.iter().map(|law| law.label.as_str()).collect();
        writeln!(f, "  {} on {}, law {}", bodies.rough, bodies.flat, laws.join(", "))?;
        writeln!(f, "  {draws} random sets and one set at the quantiles for each size, {counts:?} asperities")
    }
}
