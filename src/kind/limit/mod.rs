//! `[limit]`: sets of growing size against the statistical integral.

mod outline;
mod plan;
mod rows;
mod run;
mod spec;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Reads};

use super::compare::tables::{CurveRow, PairRow};
use plan::LimitPlan;

/// `[limit]`
pub struct Limit;

impl Kind for Limit {
    const NAME: &'static str = "limit";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::LimitSpec;
    type Plan = LimitPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<LimitPlan, InputError> {
        LimitPlan::new(file, table.get_ref())
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<rows::ConvergenceRow>(),
            Schema::of::<rows::SlopeRow>(),
        ]
    }
}
