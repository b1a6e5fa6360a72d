//! `[indentation]`: one sphere on a layered flat.

mod figures;
mod outline;
mod overlay;
mod plan;
mod rows;
mod run;
mod spec;

pub use run::{IndentationResults, LawCurves, LayerResults};

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Reads};

use plan::IndentationPlan;

/// `[indentation]`
pub struct Indentation;

impl Kind for Indentation {
    const NAME: &'static str = "indentation";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::IndentationSpec;
    type Plan = IndentationPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<IndentationPlan, InputError> {
        plan::plan(file, table.get_ref())
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}
