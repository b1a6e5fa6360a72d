//! `[laws]`: several laws on one asperity and on given surfaces.

mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_framework::Kind;
use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;

use plan::LawsPlan;

/// `[laws]`
pub struct Laws;

impl Kind for Laws {
    const NAME: &'static str = "laws";
    type Spec = spec::LawsSpec;
    type Plan = LawsPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<LawsPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}
