//! `[causes]`: why the models differ, and which is nearer to the reference, over a grid of generated surfaces.

mod figures;
mod findings;
mod outline;
mod plan;
mod process;
mod results;
mod rows;
mod run;

use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Group, Kind, Memory, Outcome, Plan, Reads, RunContext};
use plan::CausesPlan;

pub struct Causes;

impl Kind for Causes {
    const NAME: &'static str = "causes";
    const GROUP: Option<Group> = Some(Group::Why);
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = plan::CausesSpec;
    type Plan = CausesPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<CausesPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<rows::LeadRow>(), Schema::of::<rows::CauseRow>()]
    }
}

impl Plan for CausesPlan {
    fn memory(&self) -> Memory {
        Plan::memory(&self.compare)
    }

    fn work(&self) -> u128 {
        self.compare.study.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
