//! `[tiled]`: both models on a surface that may be larger than a machine.

mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use std::path::PathBuf;

use asperity::Total;
use asperity_contact_framework::divided::run_undivided;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Planned};
use asperity_contact_framework::{Memory, Plan, RunContext};

use crate::model_tables::{CurveRow, PairRow};
use crate::surface::inputs;
use crate::surface::rows::SurfaceRow;
use plan::TiledPlan;
pub use results::{LawResults, TiledResults, TiledSurface};

/// `[tiled]`
pub struct Tiled;

impl Kind for Tiled {
    const NAME: &'static str = "tiled";
    type Spec = spec::TiledSpec;
    type Plan = TiledPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<TiledPlan, InputError> {
        plan::plan(file, table)
    }

    fn planned(plan: TiledPlan) -> Planned {
        Planned::in_parts(plan)
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
    type Outcome = TiledResults;

    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    /// Of any part: tiles are done one after the other.
    fn memory(&self) -> Memory {
        /// The sums over a tile at a separation, as a file holds them and as read.
        const BYTES_PER_TOTAL: u128 = 1000;
        let totals = self.separations().len() * self.study.laws.len();
        let of_blocks = self.tiles.most_blocks() * totals * size_of::<Total>();
        let of_tiles = (self.tiles.count * totals) as u128 * BYTES_PER_TOTAL;
        let bytes = self.tiles.memory(self.surface()) + of_blocks as u128 + of_tiles;
        Memory { bytes, key: Some(self.surface().size_key.clone()) }
    }

    fn work(&self) -> u128 {
        self.study.work()
    }

    fn run(&self, context: &RunContext) -> Result<TiledResults, InputError> {
        run_undivided(self, context)
    }
}
