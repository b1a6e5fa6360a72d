//! `[compare]`: both models on given surfaces.

pub(crate) mod card;
mod contact_map;
mod correlations;
pub mod figures;
pub mod outline;
pub mod readings;
pub mod reference;
pub mod results;
pub(crate) mod rows;
mod run;
mod series;
pub mod spec;

use std::path::PathBuf;

use asperity::work::Counter;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, RunContext};
pub(crate) use figures::main_figure;
pub(crate) use rows::swept_name;
pub use run::{each_surface, run as run_compare, run_within};
use spec::ComparePlan;
pub use spec::{Extent, Samplings, Scope};

use crate::surface::{inputs, memory};

pub struct Compare;

impl Kind for Compare {
    const NAME: &'static str = "compare";
    type Spec = spec::CompareSpec;
    type Plan = ComparePlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<ComparePlan, InputError> {
        spec::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }

    fn swept() -> Option<Schema> {
        Some(Schema::of::<rows::SweptRow>())
    }
}

impl Plan for ComparePlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    fn memory(&self) -> Memory {
        let of_models =
            memory(&self.study.surfaces, self.depth(), self.is_robustness_examined && self.models.len() > 1);
        let Some(reference) = &self.reference else { return of_models };
        let of_reference = self.study.surfaces.iter().map(|surface| reference.memory(surface)).max();
        Memory { bytes: of_models.bytes + of_reference.unwrap_or(0), ..of_models }
    }

    fn work(&self) -> u128 {
        self.study.work()
    }

    fn check(&self, context: &RunContext) -> Result<(), InputError> {
        run::check(context, self)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self, &Counter::default())?))
    }
}
