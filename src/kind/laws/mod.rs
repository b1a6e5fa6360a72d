//! `[laws]`: several laws on one asperity and on given surfaces.

mod page;
mod plan;
mod results;
mod run;
mod spec;
mod summary;
mod tables;

use std::path::PathBuf;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, RunContext};
use serde_json::{Map, Value};

use plan::LawsPlan;
pub use results::{LawOnOne, LawsResults, SurfaceInfluence};

use crate::surface::{AnalysisDepth, inputs, memory};

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
        tables::schemas()
    }
}

impl Plan for LawsPlan {
    type Outcome = LawsResults;

    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.compare.surfaces)
    }

    fn memory(&self) -> Memory {
        memory(&self.compare.surfaces, AnalysisDepth::Comparison, self.compare.is_robustness_examined)
    }

    fn work(&self) -> u128 {
        self.compare.work() + self.points()
    }

    fn check(&self, context: &RunContext) -> Result<(), InputError> {
        self.compare.check(context)
    }

    fn run(&self, context: &RunContext) -> Result<LawsResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for LawsResults {
    fn metadata(&self) -> &Metadata {
        &self.compare.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.compare.warnings()
    }

    fn page(&self, tables: &Tables) -> Page {
        page::page(self, tables)
    }

    fn tables(&self) -> Vec<Table> {
        tables::tables(self)
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }
}
