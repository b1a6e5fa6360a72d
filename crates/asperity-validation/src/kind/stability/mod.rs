//! `[stability]`: how far `f64` is off over the range of inputs.

mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Group, Kind, Outcome, Reads};
use asperity_contact_framework::{Memory, Plan, RunContext};

use crate::stability::Counts;
use crate::stability::GroupResults;
use plan::StabilityPlan;

/// `[stability]`
pub struct Stability;

impl Kind for Stability {
    const NAME: &'static str = "stability";
    const GROUP: Option<Group> = Some(Group::Trust);
    const READS: Reads = Reads { materials: false, surfaces: false };
    type Spec = spec::StabilitySpec;
    type Plan = StabilityPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<StabilityPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<&GroupResults>(), Schema::of::<rows::WorstRow>(), Schema::of::<rows::CellRow>()]
    }
}

impl Plan for StabilityPlan {
    /// The largest set and its ordered copy, on each thread.
    fn memory(&self) -> Memory {
        let largest: u128 = if self.counts.millions > 0 { 1_000_000 } else { 1000 };
        Memory { bytes: 100 * largest * rayon::current_num_threads() as u128, key: None }
    }

    /// A micro-contact in 32 digits counts a hundredfold.
    fn work(&self) -> u128 {
        let Counts { contacts, sums, integrals, loads, millions } = self.counts;
        let work = 100 * contacts + 30_000 * sums + 100_000 * (integrals + 3 * loads) + 1_000_000 * millions;
        u128::from(work)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)))
    }
}
