//! `[laws]`: several laws on one asperity and on given surfaces.

mod page;
mod plan;
mod results;
mod run;
mod spec;
mod summary;
mod tables;

use schemars::SchemaGenerator;
use std::path::PathBuf;

use asperity_framework::input::{InputError, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, TableError};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use serde_json::{Map, Value};

use plan::LawsPlan;
pub use results::{LawOnOne, LawsResults, SurfaceInfluence};

use crate::surface::{AnalysisDepth, inputs, memory};

/// `[laws]`
pub struct Laws;

impl Kind for Laws {
    fn name(&self) -> &'static str {
        "laws"
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> schemars::Schema {
        generator.subschema_for::<spec::LawsSpec>()
    }

    fn reads(&self) -> Reads {
        Reads { materials: true, surfaces: true }
    }

    fn plan(&self, spec: &SpecFile, _: bool) -> Result<Box<dyn Plan>, InputError> {
        Ok(Box::new(plan::plan(spec)?))
    }

    fn tables(&self) -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for LawsPlan {
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

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}

impl Outcome for LawsResults {
    fn metadata(&self) -> &Metadata {
        &self.compare.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.compare.warnings()
    }

    fn page(&self) -> Page {
        page::page(self)
    }

    fn tables(&self) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
        tables::tables(self)
    }

    fn summary(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }
}
