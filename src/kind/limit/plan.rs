//! `[limit]` resolved: laws on their bodies, sizes checked.

use std::fmt;

use asperity::{Flat, Heights, Population};
use asperity_framework::contact::{Bodies, LawPlan};
use asperity_framework::input::{InputError, SpecFile};

use super::spec::LimitSpec;

/// Sets of growing size against their limit.
pub struct LimitPlan {
    /// Who touches whom.
    pub bodies: Bodies,
    /// The laws.
    pub laws: Vec<LawPlan>,
    /// What the sets are drawn from.
    pub population: Population,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Sizes of the sets.
    pub counts: Vec<usize>,
    /// Random sets of each size.
    pub draws: usize,
}

impl fmt::Display for LimitPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let laws: Vec<&str> = self.laws.iter().map(|law| law.label.as_str()).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        writeln!(
            f,
            "  {} random sets and one set at the quantiles for each size, {:?} asperities",
            self.draws, self.counts
        )
    }
}

/// Reads `[limit]`.
pub(super) fn plan(file: &SpecFile) -> Result<LimitPlan, InputError> {
    let table = file.required_table::<LimitSpec>("limit")?;
    let words = table.get_ref();
    let rough = file.body(words.rough.get_ref(), words.rough.span())?;
    let flat = file.body(words.flat.get_ref(), words.flat.span())?;
    let counts = file.counts(&words.count)?;
    let draws = file.several(&words.draws, "random sets of each size")?;
    file.spheres_only(&words.law, "the asperities of [limit] are spheres of equal radius")?;
    let (rough_name, flat_name) = (words.rough.get_ref(), words.flat.get_ref());
    file.check_laws(&words.law, (rough_name, &rough), &[(flat_name, &flat)])?;
    let laws = file.law_plans(&words.law, (rough_name, &rough), &[(None, Flat::Bare(flat))], flat_name)?;
    Ok(LimitPlan {
        bodies: Bodies { rough: words.rough.get_ref().clone(), flat: words.flat.get_ref().clone() },
        laws,
        population: Population {
            radius: words.radius.value(),
            sigma: words.sigma.value(),
            density: words.density.value(),
            heights: Heights::GAUSSIAN,
        },
        separations: words.separation.0.clone(),
        counts,
        draws,
    })
}
