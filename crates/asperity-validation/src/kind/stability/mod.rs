//! `[stability]`: how far `f64` is off over the range of inputs.

mod findings;
mod page;
mod plan;
mod run;
mod spec;
mod summary;
mod tables;

use asperity_framework::input::{InputError, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, TableError};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};

use plan::StabilityPlan;
use run::StabilityResults;

/// `[stability]`
pub struct Stability;

impl Kind for Stability {
    fn name(&self) -> &'static str {
        "stability"
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> schemars::Schema {
        generator.subschema_for::<spec::StabilitySpec>()
    }

    fn reads(&self) -> Reads {
        Reads { materials: false, surfaces: false }
    }

    fn plan(&self, spec: &SpecFile, _: bool) -> Result<Box<dyn Plan>, InputError> {
        Ok(Box::new(plan::plan(spec)?))
    }

    fn tables(&self) -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for StabilityPlan {
    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)))
    }
}

impl Outcome for StabilityResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings()
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
