//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

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

use plan::CoveragePlan;
use run::CoverageResults;

/// `[coverage]`
pub struct IntervalCoverage;

impl Kind for IntervalCoverage {
    const NAME: &'static str = "coverage";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::CoverageSpec;
    type Plan = CoveragePlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<CoveragePlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for CoveragePlan {
    type Outcome = CoverageResults;

    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<CoverageResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for CoverageResults {
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
