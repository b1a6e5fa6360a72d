//! `[limit]`: sets of growing size against the statistical integral.

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

use plan::LimitPlan;
pub use run::LimitResults;

use asperity_framework::set_memory;

/// `[limit]`
pub struct Limit;

impl Kind for Limit {
    const NAME: &'static str = "limit";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::LimitSpec;
    type Plan = LimitPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<LimitPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for LimitPlan {
    type Outcome = LimitResults;

    fn memory(&self) -> Memory {
        let largest = self.counts.iter().copied().max().unwrap_or(0);
        Memory { bytes: set_memory(largest as u128), key: None }
    }

    fn work(&self) -> u128 {
        let asperities: u128 = self.counts.iter().map(|&count| count as u128).sum();
        asperities * ((self.draws + 1) * self.laws.len() * self.separations.len()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<LimitResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for LimitResults {
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
