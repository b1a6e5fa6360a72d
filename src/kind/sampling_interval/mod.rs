//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters: which results have a limit?

mod figures;
mod findings;
mod outline;
mod plan;
mod quantity;
mod results;
mod rows;
mod run;
mod spec;
mod trend;

use asperity_framework::Kind;
use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;

use plan::IntervalPlan;

/// `[sampling-interval]`
pub struct SamplingInterval;

impl Kind for SamplingInterval {
    const NAME: &'static str = "sampling-interval";
    type Spec = spec::SamplingIntervalSpec;
    type Plan = IntervalPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<IntervalPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}
