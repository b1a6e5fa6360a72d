//! Surfaces that stay in memory between runs, for a program that runs changed specs again and again.

use std::sync::Arc;

use asperity::surface::{Preparation, Surface};
use asperity::topography::Rows;

use super::plan::SurfacePlan;

/// Keeps the first realisations of surfaces. What stands for a surface must hold everything that it is made of: its keys, the seed, and
/// the state of its files.
pub trait SurfaceStore: Sync {
    /// The surface of a plan, if it was made before.
    fn get(&self, plan: &SurfacePlan) -> Option<Arc<StoredSurface>>;

    /// Keeps the surface of a plan.
    fn put(&self, plan: &SurfacePlan, made: StoredSurface);
}

/// A surface with what other runs need of how it was made.
pub struct StoredSurface {
    /// The surface, with its prepared map.
    pub surface: Surface,
    pub(super) raw: Option<Arc<dyn Rows>>,
    pub(super) fitted: Option<Preparation>,
    pub(super) bandwidth: Option<f64>,
}

impl StoredSurface {
    /// About the bytes that it keeps: its maps and asperities.
    pub fn bytes(&self) -> usize {
        /// A height as read, prepared and in the image of a fit; height, radius and curvatures of an asperity.
        const OF_POINT: usize = 16;
        const OF_ASPERITY: usize = 64;
        let points = self.surface.map.as_ref().map_or(0, |map| map.points[0] * map.points[1]);
        OF_POINT * points + OF_ASPERITY * self.surface.set.count()
    }
}
