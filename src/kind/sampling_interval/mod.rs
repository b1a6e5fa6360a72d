//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters: which results have a limit?

mod findings;
mod page;
mod plan;
mod quantity;
mod results;
mod run;
mod spec;
mod summary;
mod tables;
mod trend;

use std::path::PathBuf;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, RunContext};
use serde_json::{Map, Value};

use plan::IntervalPlan;
pub use results::IntervalResults;

use crate::surface::{AnalysisDepth, SurfacePlan, inputs, memory, warnings};

/// `[sampling-interval]`
pub struct SamplingInterval;

impl Kind for SamplingInterval {
    const NAME: &'static str = "sampling-interval";
    type Spec = spec::SamplingIntervalSpec;
    type Plan = IntervalPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<IntervalPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for IntervalPlan {
    type Outcome = IntervalResults;

    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.compare.surfaces)
    }

    fn memory(&self) -> Memory {
        /// The prepared map and a filtered one.
        const BYTES_PER_POINT: u128 = 16;
        let of_models = memory(&self.compare.surfaces, AnalysisDepth::Comparison, true);
        let points = |surface: &SurfacePlan| surface.map_points().map(|[nx, ny]| nx as u128 * ny as u128);
        let maps = self.compare.surfaces.iter().filter_map(points).max().unwrap_or(0) * BYTES_PER_POINT;
        Memory { bytes: of_models.bytes + maps, ..of_models }
    }

    fn work(&self) -> u128 {
        self.compare.work() * self.scales() as u128
    }

    fn run(&self, context: &RunContext) -> Result<IntervalResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for IntervalResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut lines = warnings(self.surfaces.iter().map(|found| &found.surface));
        lines.extend(self.implausible.iter().cloned());
        lines.extend(self.contact.caveats.iter().cloned());
        lines
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
