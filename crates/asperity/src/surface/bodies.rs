//! The asperities of both bodies whose sum is a surface.

use crate::{Heights, MeanRadius, Population};

/// The asperities of one of two rough bodies, taken as Gaussian.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyAsperities {
    /// The name of its surface.
    pub name: String,
    /// Mean radius and radius of the mean curvature, m.
    pub radii: [f64; 2],
    /// Standard deviation of their heights, m; 0 where these do not scatter.
    pub sigma: f64,
    /// Asperities per area, 1/m^2.
    pub density: f64,
}

impl BodyAsperities {
    /// Those of a surface.
    pub fn of(surface: &super::Surface) -> Self {
        let [arithmetic, inverse] = [MeanRadius::Arithmetic, MeanRadius::InverseMeanCurvature]
            .map(|radius| radius.radius(&surface.statistics));
        Self {
            name: surface.name.clone(),
            radii: [arithmetic, inverse],
            sigma: if surface.unscattered.is_some() { 0.0 } else { surface.statistics.sigma },
            density: surface.set.density(),
        }
    }

    /// Those of a population.
    pub fn nominal(name: &str, population: &Population) -> Self {
        let &Population { radius, sigma, density, .. } = population;
        Self { name: name.to_owned(), radii: [radius; 2], sigma, density }
    }

    /// As the statistical model has them.
    pub fn population(&self, mean_radius: MeanRadius) -> Population {
        let &Self { radii: [arithmetic, inverse], sigma, density, .. } = self;
        let radius = match mean_radius {
            MeanRadius::Arithmetic | MeanRadius::InContact => arithmetic,
            MeanRadius::InverseMeanCurvature => inverse,
        };
        Population { radius, sigma, density, heights: Heights::GAUSSIAN }
    }
}
