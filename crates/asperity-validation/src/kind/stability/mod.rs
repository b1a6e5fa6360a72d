//! `[stability]`: how far `f64` is off over the range of inputs.

mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Reads};

use crate::stability::GroupResults;
use plan::StabilityPlan;

/// `[stability]`
pub struct Stability;

impl Kind for Stability {
    const NAME: &'static str = "stability";
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
