//! `[limit]` resolved: laws on their bodies, sizes checked.

use std::fmt;

use asperity::study::LawContact;
use asperity::{Flat, Heights, Population};
use asperity_framework::contact::Bodies;
use asperity_framework::input::{InputError, Spanned, SpecFile};

use super::spec::LimitSpec;

/// Sets of growing size against their limit.
pub struct LimitPlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    pub laws: Vec<LawContact>,
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
pub(super) fn plan(file: &SpecFile, table: &Spanned<LimitSpec>) -> Result<LimitPlan, InputError> {
    let raw = table.get_ref();
    let rough = file.body(raw.rough.get_ref(), raw.rough.span())?;
    let flat = file.body(raw.flat.get_ref(), raw.flat.span())?;
    let counts = file.counts(&raw.count)?;
    let draws = file.several(&raw.draws, "random sets of each size")?;
    file.spheres_only(&raw.law, "the asperities of [limit] are spheres of equal radius")?;
    let (rough_name, flat_name) = (raw.rough.get_ref(), raw.flat.get_ref());
    file.check_laws(&raw.law, (rough_name, &rough), &[(flat_name, &flat)])?;
    let laws = file.law_plans(&raw.law, (rough_name, &rough), &[(None, Flat::Bare(flat))], flat_name)?;
    Ok(LimitPlan {
        bodies: Bodies { rough: raw.rough.get_ref().clone(), flat: raw.flat.get_ref().clone() },
        laws,
        population: Population {
            radius: raw.radius.value(),
            sigma: raw.sigma.value(),
            density: raw.density.value(),
            heights: Heights::GAUSSIAN,
        },
        separations: raw.separation.0.clone(),
        counts,
        draws,
    })
}
