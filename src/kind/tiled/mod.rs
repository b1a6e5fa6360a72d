//! `[tiled]`: both models on a surface that may be larger than a machine.

mod outline;
mod plan;
mod results;
mod rows;
mod run;

use std::path::PathBuf;

use asperity::Total;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Divided, Kind, Memory, Outcome, Plan, RunContext};
use plan::TiledPlan;

use crate::model_tables::{CurveRow, PairRow};
use crate::surface::inputs;
use crate::surface::rows::SurfaceRow;

pub struct Tiled;

impl Kind for Tiled {
    const NAME: &'static str = "tiled";
    type Spec = plan::TiledSpec;
    type Plan = TiledPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<TiledPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<rows::SeparationRow>(),
            Schema::of::<SurfaceRow>(),
        ]
    }
}

impl Plan for TiledPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    /// Of any task too: tiles are done one after the other.
    fn memory(&self) -> Memory {
        // Over each block of the tiles that are under way, and over each tile.
        let sums = self.tiles.most_blocks() + self.tiles.count;
        let totals = sums * self.separations().len() * self.study.laws.len() * size_of::<Total>();
        let bytes = self.tiles.memory(self.surface()) + totals as u128;
        Memory { bytes, key: Some(self.surface().size_key.clone()) }
    }

    fn work(&self) -> u128 {
        self.study.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(self.run_here(context)?))
    }

    fn divided(&self) -> Option<&dyn Divided> {
        Some(self)
    }
}
