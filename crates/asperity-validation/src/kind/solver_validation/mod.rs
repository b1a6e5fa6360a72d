//! `[solver-validation]`: the boundary element solver against closed forms, exact solutions and a published ensemble.

mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;
mod words;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Reads};

use plan::SolverPlan;

/// `[solver-validation]`
pub struct SolverValidation;

impl Kind for SolverValidation {
    const NAME: &'static str = "solver-validation";
    const READS: Reads = Reads { materials: false, surfaces: false };
    type Spec = spec::SolverSpec;
    type Plan = SolverPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<SolverPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}
