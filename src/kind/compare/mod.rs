//! `[compare]`: both models on given surfaces.

pub mod answers;
mod attribution;
pub(crate) mod differences;
pub mod findings;
mod implausible;
mod layer_summary;
mod lines;
mod models;
pub mod page;
pub mod plan;
pub mod ranking;
mod reach;
mod readings_summary;
pub mod reference;
pub mod results;
pub mod robustness;
mod run;
mod sampling;
pub mod spec;
pub mod statistical;
mod summary;
pub(crate) mod tables;
mod threshold;

pub(crate) use attribution::attribute;
pub use run::run as run_compare;
pub(crate) use run::{differ, layer_metadata, models_of, run_surface};
pub(crate) use sampling::sampling;
pub use summary::summary;
pub use tables::CurveRow;

use std::path::PathBuf;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, RunContext};
use serde_json::{Map, Value};

use plan::ComparePlan;
use results::CompareResults;

use crate::surface::{inputs, memory};
use asperity::work::Counter;

/// `[compare]`
pub struct Compare;

impl Kind for Compare {
    const NAME: &'static str = "compare";
    type Spec = spec::CompareSpec;
    type Plan = ComparePlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<ComparePlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<tables::CurveRow>(),
            Schema::of::<tables::PairRow>(),
            Schema::of::<differences::DifferenceRow>(),
            Schema::of::<attribution::tables::AttributionRow>(),
            Schema::of::<ranking::tables::RankingRow>(),
            Schema::of::<reference::tables::ReferenceRow>(),
        ]
    }
}

impl Plan for ComparePlan {
    type Outcome = CompareResults;

    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.surfaces)
    }

    fn memory(&self) -> Memory {
        let of_models =
            memory(&self.surfaces, self.depth(), self.is_robustness_examined && self.models.len() > 1);
        let Some(reference) = &self.reference else { return of_models };
        let of_reference = self.surfaces.iter().map(|surface| reference.memory(surface)).max();
        Memory { bytes: of_models.bytes + of_reference.unwrap_or(0), ..of_models }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn check(&self, context: &RunContext) -> Result<(), InputError> {
        reach::check(context, self)
    }

    fn run(&self, context: &RunContext) -> Result<CompareResults, InputError> {
        run::run(context, self, &Counter::default())
    }
}

impl Outcome for CompareResults {
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
        let mut comparison = Table::new(tables::comparison(self));
        if !self.is_attributed() {
            comparison = comparison.without_part(tables::CAUSES);
        }
        if self.reference.is_none() {
            comparison = comparison.without_part(tables::REFERENCE);
        }
        let mut files =
            vec![Table::new(tables::curves(self)), comparison, Table::new(differences::rows(self))];
        if self.is_attributed() {
            files.push(Table::new(attribution::tables::rows(self)));
        }
        if self.surfaces.iter().any(|found| !found.rankings.is_empty()) {
            files.push(Table::new(ranking::tables::rows(self)));
        }
        if self.reference.is_some() {
            files.push(Table::new(reference::tables::rows(self)));
        }
        files
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }

    fn terminal(&self) -> Option<String> {
        self.described.as_ref().map(|_| page::for_terminal(self))
    }
}
