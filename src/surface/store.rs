//! Surfaces that stay in memory between runs, for a program that runs changed specs again and again.

use std::sync::Arc;

use asperity::surface::{Preparation, Surface};
use asperity::topography::Rows;

use super::plan::SurfacePlan;

/// Keeps the first realisations of surfaces.
pub trait SurfaceStore: Sync {
    /// Everything that a surface is made of: its keys, the seed, and the present state of its files.
    fn identity(&self, plan: &SurfacePlan) -> String;

    /// The surface of this identity, if it was made before.
    fn get(&self, identity: &str) -> Option<Arc<StoredSurface>>;

    /// Keeps a surface.
    fn put(&self, identity: String, made: StoredSurface);
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
