//! `[limit]`: sets of growing size against the statistical integral.

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

use plan::LimitPlan;
pub use run::LimitResults;

use asperity_framework::set_memory;

/// `[limit]`
pub struct Limit;

impl Kind for Limit {
    fn name(&self) -> &'static str {
        "limit"
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> schemars::Schema {
        generator.subschema_for::<spec::LimitSpec>()
    }

    fn reads(&self) -> Reads {
        Reads { materials: true, surfaces: false }
    }

    fn plan(&self, spec: &SpecFile, _: bool) -> Result<Box<dyn Plan>, InputError> {
        Ok(Box::new(plan::plan(spec)?))
    }

    fn tables(&self) -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for LimitPlan {
    fn memory(&self) -> Memory {
        let largest = self.counts.iter().copied().max().unwrap_or(0);
        Memory { bytes: set_memory(largest as u128), key: None }
    }

    fn work(&self) -> u128 {
        let asperities: u128 = self.counts.iter().map(|&count| count as u128).sum();
        asperities * ((self.draws + 1) * self.laws.len() * self.separations.len()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}

impl Outcome for LimitResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.caveats.clone()
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
