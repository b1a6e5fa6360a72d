//! `[laws]`: several laws on one asperity and on given surfaces.

mod figures;
mod outline;
mod plan;
mod rows;
mod run;

use std::path::PathBuf;

use asperity::surface::AnalysisDepth;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, RunContext};
use plan::LawsPlan;

use crate::surface::{inputs, memory};

pub struct Laws;

impl Kind for Laws {
    const NAME: &'static str = "laws";
    type Spec = plan::LawsSpec;
    type Plan = LawsPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<LawsPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for LawsPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.compare.study.surfaces)
    }

    fn memory(&self) -> Memory {
        memory(&self.compare.study.surfaces, AnalysisDepth::Comparison, self.compare.is_robustness_examined)
    }

    fn work(&self) -> u128 {
        self.compare.study.work() + (self.ratios.len() * self.compare.study.laws.len()) as u128
    }

    fn check(&self, context: &RunContext) -> Result<(), InputError> {
        self.compare.check(context)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
