//! `[causes]`: why the models differ, over a grid of skewness and bandwidth of generated surfaces.

mod figures;
mod findings;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Reads};
use asperity_contact_framework::{Memory, Plan, RunContext};

use plan::CausesPlan;
use results::CausesResults;

/// `[causes]`
pub struct Causes;

impl Kind for Causes {
    const NAME: &'static str = "causes";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::CausesSpec;
    type Plan = CausesPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<CausesPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<rows::LeadRow>(), Schema::of::<rows::CauseRow>()]
    }
}

impl Plan for CausesPlan {
    type Outcome = CausesResults;

    fn memory(&self) -> Memory {
        /// The map, its transform, and the asperities in several orders.
        const BYTES_PER_POINT: u128 = 64;
        let points = self.points.first().map_or(0, |point| point.generator.points[0]) as u128;
        Memory { bytes: points * points * BYTES_PER_POINT, key: None }
    }

    fn work(&self) -> u128 {
        /// Of one surface at one load: the search of the sum over its asperities and the states in between.
        const EVALUATIONS: u128 = 200_000;
        (self.points.len() * self.realisations * self.loads.len()) as u128 * EVALUATIONS
    }

    fn run(&self, context: &RunContext) -> Result<CausesResults, InputError> {
        run::run(context, self)
    }
}
