//! `[causes]`: why the models differ, over a grid of skewness and bandwidth of generated surfaces.

mod findings;
mod page;
mod plan;
mod results;
mod run;
mod spec;
mod summary;
mod tables;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use serde_json::{Map, Value};

use plan::CausesPlan;
use results::CausesResults;

/// `[causes]`
pub struct Causes;

impl Kind for Causes {
    const NAME: &'static str = "causes";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::CausesSpec;
    type Plan = CausesPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<CausesPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for CausesPlan {
    type Outcome = CausesResults;

    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<CausesResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for CausesResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.caveats.clone()
    }

    fn page(&self, _: &Tables) -> Page {
        page::page(self)
    }

    fn tables(&self) -> Vec<Table> {
        tables::tables(self)
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }
}
