//! `[indentation]`: one sphere on a layered flat.

mod page;
mod plan;
mod run;
mod shown;
mod spec;
mod summary;
mod tables;

pub use run::{IndentationResults, LawCurves, LayerResults, OverlayFit};

use std::path::PathBuf;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use serde_json::{Map, Value};

use plan::IndentationPlan;

/// `[indentation]`
pub struct Indentation;

impl Kind for Indentation {
    const NAME: &'static str = "indentation";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::IndentationSpec;
    type Plan = IndentationPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<IndentationPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        tables::schemas()
    }
}

impl Plan for IndentationPlan {
    type Outcome = IndentationResults;

    fn inputs(&self) -> Vec<PathBuf> {
        self.overlay.iter().map(|overlay| overlay.path.clone()).collect()
    }

    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<IndentationResults, InputError> {
        run::run(context, self)
    }
}

impl Outcome for IndentationResults {
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
