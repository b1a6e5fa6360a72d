//! `[causes]`: why the models differ, over a grid of skewness and bandwidth of generated surfaces.

mod figures;
mod findings;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Reads};

use plan::CausesPlan;

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
