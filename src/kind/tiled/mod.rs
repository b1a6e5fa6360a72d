//! `[tiled]`: both models on a surface that may be larger than a machine.

mod page;
mod plan;
mod results;
mod run;
mod spec;
mod summary;

use std::path::PathBuf;

use asperity::Total;
use asperity_framework::divided::{Divided, run_undivided};
use asperity_framework::input::{InputError, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, TableError, csv_file};
use asperity_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext};
use schemars::SchemaGenerator;
use serde_json::{Map, Value};

use super::compare::tables::{Case, CurveRow, Extras, PairRow, comparison_file};
use crate::surface::inputs;
use plan::TiledPlan;
pub use results::{LawResults, TiledResults, TiledSurface};

/// `[tiled]`
pub struct Tiled;

impl Kind for Tiled {
    fn name(&self) -> &'static str {
        "tiled"
    }

    fn schema(&self, generator: &mut SchemaGenerator) -> schemars::Schema {
        generator.subschema_for::<spec::TiledSpec>()
    }

    fn reads(&self) -> Reads {
        Reads { materials: true, surfaces: true }
    }

    fn plan(&self, spec: &SpecFile, _: bool) -> Result<Box<dyn Plan>, InputError> {
        Ok(Box::new(plan::plan(spec)?))
    }

    fn tables(&self) -> Vec<Schema> {
        vec![Schema::of::<CurveRow>(), Schema::of::<PairRow>()]
    }
}

impl Plan for TiledPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.compare.surfaces)
    }

    /// Of any part: tiles are done one after the other.
    fn memory(&self) -> Memory {
        /// The sums over a tile at a separation, as a file holds them and as read.
        const BYTES_PER_TOTAL: u128 = 1000;
        let totals = self.separations().len() * self.compare.laws.len();
        let of_blocks = self.tiles.most_blocks() * totals * size_of::<Total>();
        let of_tiles = (self.tiles.count * totals) as u128 * BYTES_PER_TOTAL;
        let bytes = self.tiles.memory(self.surface()) + of_blocks as u128 + of_tiles;
        Memory { bytes, key: Some(self.surface().size_key.clone()) }
    }

    fn work(&self) -> u128 {
        self.compare.work()
    }

    fn divided(&self) -> Option<&dyn Divided> {
        Some(self)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        run_undivided(self, context)
    }
}

impl Outcome for TiledResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.implausible.iter().chain(&self.contact.caveats).cloned().collect()
    }

    fn page(&self) -> Page {
        page::page(self)
    }

    fn tables(&self) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
        let case = |law: &LawResults| Case::layered(&self.surface.name, &law.law, law.thickness);
        let curves = self
            .laws
            .iter()
            .flat_map(|law| CurveRow::of_case(&case(law), &law.comparison, self.contact.reduced_modulus));
        let pairs = self.laws.iter().flat_map(|law| {
            let case = case(law);
            law.comparison.pairs.iter().map(move |&pair| PairRow {
                case: case.clone(),
                pair,
                nominal_area: self.surface.nominal_area,
                plasticity_index: None,
                attribution: None,
                reference: None,
            })
        });
        Ok(vec![csv_file(curves)?, comparison_file(pairs, Extras::default())?])
    }

    fn summary(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }
}
