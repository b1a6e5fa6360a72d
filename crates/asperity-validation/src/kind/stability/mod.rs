//! `[stability]`: how far `f64` is off over the range of inputs.

mod findings;
mod page;
mod plan;
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

use plan::StabilityPlan;
use run::StabilityResults;

/// `[stability]`
pub struct Stability;

impl Kind for Stability {
    const NAME: &'static str = "stability";
    const READS: Reads = Reads { materials: false, surfaces: false };
    type Spec = spec::StabilitySpec;
    type Plan = StabilityPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<StabilityPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for StabilityPlan {
    type Outcome = StabilityResults;

    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<StabilityResults, InputError> {
        Ok(run::run(context, self))
    }
}

impl Outcome for StabilityResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings()
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
