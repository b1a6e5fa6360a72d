//! `[limit]`: sets of growing size against the statistical integral.

mod outline;
mod rows;
mod run;

use asperity::compare::LimitSets;
use asperity::{Flat, Heights, Population};
use asperity_contact_framework::contact::Bodies;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Reads};
use rows::{ConvergenceRow, SlopeRow};
use run::LimitPlan;

use crate::model_tables::{CurveRow, PairRow};

pub struct Limit;

impl Kind for Limit {
    const NAME: &'static str = "limit";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = run::LimitSpec;
    type Plan = LimitPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<LimitPlan, InputError> {
        let raw = table.get_ref();
        let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
        let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
        let counts = file.counts(&raw.count)?;
        let draws = file.several(&raw.draws, "random sets of each size")?;
        file.spheres_only(&raw.law, "the asperities of [limit] are spheres of equal radius")?;
        let laws = file.law_plans(&raw.law, (rough, &pair[0]), &[(None, Flat::Bare(pair[1]))], flat)?;
        let (radius, sigma, density) = (raw.radius.value(), raw.sigma.value(), raw.density.value());
        let population = Population { radius, sigma, density, heights: Heights::GAUSSIAN };
        let sets = LimitSets { population, separations: raw.separation.0.clone(), counts, draws };
        Ok(LimitPlan { bodies: Bodies { rough: rough.clone(), flat: flat.clone() }, laws, sets })
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<ConvergenceRow>(),
            Schema::of::<SlopeRow>(),
        ]
    }
}
