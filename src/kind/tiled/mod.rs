//! `[tiled]`: both models on a surface that may be larger than a machine.

mod page;
mod plan;
mod results;
mod run;
mod spec;
mod summary;

use std::path::PathBuf;

use asperity::Total;
use asperity_framework::divided::run_undivided;
use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Memory, Outcome, Plan, Planned, RunContext};
use serde_json::{Map, Value};

use super::compare::tables::{Case, CurveRow, PairRow, comparison_of_models};
use crate::surface::inputs;
use plan::TiledPlan;
pub use results::{LawResults, TiledResults, TiledSurface};

/// `[tiled]`
pub struct Tiled;

impl Kind for Tiled {
    const NAME: &'static str = "tiled";
    type Spec = spec::TiledSpec;
    type Plan = TiledPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<TiledPlan, InputError> {
        plan::plan(file, table)
    }

    fn planned(plan: TiledPlan) -> Planned {
        Planned::in_parts(plan)
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<CurveRow>(), Schema::of::<PairRow>()]
    }
}

impl Plan for TiledPlan {
    type Outcome = TiledResults;

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

    fn run(&self, context: &RunContext) -> Result<TiledResults, InputError> {
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

    fn page(&self, _: &Tables) -> Page {
        page::page(self)
    }

    fn tables(&self) -> Vec<Table> {
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
        vec![Table::new(curves), comparison_of_models(pairs)]
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        summary::summary(self)
    }
}
