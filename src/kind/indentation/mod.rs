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

use asperity_framework::input::{InputError, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, TableError};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};

use plan::IndentationPlan;

/// `[indentation]`
pub struct Indentation;

impl Kind for Indentation {
    fn name(&self) -> &'static str {
        "indentation"
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> schemars::Schema {
        generator.subschema_for::<spec::IndentationSpec>()
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

impl Plan for IndentationPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        self.overlay.iter().map(|overlay| overlay.path.clone()).collect()
    }

    fn memory(&self) -> Memory {
        Memory { bytes: self.memory(), key: None }
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}

impl Outcome for IndentationResults {
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
