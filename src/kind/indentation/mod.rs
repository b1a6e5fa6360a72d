//! `[indentation]`: one sphere on a layered flat.

mod figures;
mod outline;
mod plan;
mod rows;
mod run;

use std::path::PathBuf;

use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use plan::IndentationPlan;
pub use run::{IndentationResults, LawCurves, LayerResults};

pub struct Indentation;

impl Kind for Indentation {
    const NAME: &'static str = "indentation";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = plan::IndentationSpec;
    type Plan = IndentationPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<IndentationPlan, InputError> {
        plan::plan(file, table.get_ref())
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for IndentationPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        self.overlay.iter().map(|overlay| overlay.path.clone()).collect()
    }

    fn memory(&self) -> Memory {
        const BYTES_PER_POINT: u128 = 64;
        Memory { bytes: self.work() * BYTES_PER_POINT, key: None }
    }

    /// Each exact contact counts as one.
    fn work(&self) -> u128 {
        /// Uncoated, coated, all layer; plus the exact contact and both effective-modulus models.
        const CURVES: usize = 3;
        (CURVES * (self.laws.len() + 1) * self.indentations.len() * self.cases()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
