//! The surfaces of a spec: read, planned, made, and described in a report.

mod description;
mod factory;
mod files;
mod fit;
pub mod fitness;
mod generation;
mod memory;
mod options;
mod pair;
mod plan;
pub mod reading;
pub mod rows;
pub mod section;
mod spec;
mod tiles;

use asperity::surface::Surface;
use asperity::work::Counter;
pub use description::{SurfacesPlan, described_file};
pub use factory::SurfaceFactory;
pub use files::{Files, OfSpec, StoredSurface, SurfaceStore, Surfaces};
pub use fit::{by_hand, fit_records, keys};
pub use generation::{Generation, TargetSpec, Way};
pub use memory::memory;
pub use options::{ContactOptions, FileOptions, file_name};
pub use plan::{SurfacePlan, beside, curvature_ratio, describe, inputs, points_per_wave_on, surfaces};
pub use spec::SurfaceSpec;
pub use tiles::{OpenTiles, SurfaceTiles};

pub fn warnings<'a>(surfaces: impl IntoIterator<Item = &'a Surface>) -> Vec<String> {
    let of = |surface: &'a Surface| {
        surface.warnings.iter().map(|warning| format!("surface {}: {warning}", surface.name))
    };
    surfaces.into_iter().flat_map(of).collect()
}

/// The files of surfaces that are made one after the other.
pub fn files_of<'a>(surfaces: &[SurfacePlan], counter: &'a Counter) -> Files<'a> {
    Files::new(surfaces.iter().flat_map(SurfacePlan::readings).collect(), counter)
}
