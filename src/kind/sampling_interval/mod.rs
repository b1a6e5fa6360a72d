//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters: which results have a limit?

mod figures;
mod outline;
mod plan;
mod quantity;
mod results;
mod rows;
mod run;
mod trend;

use std::path::PathBuf;

use asperity::surface::AnalysisDepth;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, RunContext};
use plan::IntervalPlan;

use crate::surface::{SurfacePlan, inputs, memory};

pub struct SamplingInterval;

impl Kind for SamplingInterval {
    const NAME: &'static str = "sampling-interval";
    type Spec = plan::SamplingIntervalSpec;
    type Plan = IntervalPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<IntervalPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for IntervalPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    fn memory(&self) -> Memory {
        /// The prepared map and a filtered one.
        const BYTES_PER_POINT: u128 = 16;
        let of_models = memory(&self.study.surfaces, AnalysisDepth::Comparison, true);
        let points = |surface: &SurfacePlan| surface.map_points().map(|[nx, ny]| nx as u128 * ny as u128);
        let maps = self.study.surfaces.iter().filter_map(points).max().unwrap_or(0) * BYTES_PER_POINT;
        Memory { bytes: of_models.bytes + maps, ..of_models }
    }

    fn work(&self) -> u128 {
        self.study.work() * self.scales() as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
