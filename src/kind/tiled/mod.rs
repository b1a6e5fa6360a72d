//! `[tiled]`: both models on a surface that may be larger than a machine.

mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::report::table::Schema;
use asperity_framework::{Kind, Planned};

use crate::model_tables::{CurveRow, PairRow};
use crate::surface::rows::SurfaceRow;
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
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<rows::SeparationRow>(),
            Schema::of::<SurfaceRow>(),
        ]
    }
}
