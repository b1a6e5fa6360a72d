//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

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

use plan::CoveragePlan;

/// `[coverage]`
pub struct IntervalCoverage;

impl Kind for IntervalCoverage {
    const NAME: &'static str = "coverage";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::CoverageSpec;
    type Plan = CoveragePlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<CoveragePlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<rows::ProcessRow>(), Schema::of::<rows::CoverageRow>()]
    }
}
