//! The statistical model with the mean radius of the asperities that touch.

use super::load_control::{LOWEST_SEPARATION, search_missing};
use super::{Model, ReferencePlane, Response, Statistical, descent};
use crate::asperity::{Population, RadiiAbove};
use crate::interface::MicroContact;
use crate::numeric::parallel;
use crate::numeric::root::last_reaching;
use crate::shape::Shape;

/// The statistical model whose mean radius at a separation is that of the asperities above it: the correlation of height and
/// radius enters through it. Above all asperities it is the radius of the highest one.
///
/// The pressure need not increase on approach where few asperities touch; a load is reached at the largest separation that
/// a search in steps of a quarter of sigma finds, of sigma above 6 sigma. The stiffness is that at a fixed radius.
pub struct RadiusInContact<'a> {
    contact: &'a dyn MicroContact,
    population: Population,
    /// The mean shape at the population's radius.
    mean_shape: Shape,
    /// Where separations are measured from, relative to the mean height of the population.
    plane: ReferencePlane,
    /// The same in the frame of the set's heights, m.
    origin: f64,
    radii: RadiiAbove<'a>,
}

impl<'a> RadiusInContact<'a> {
    /// Of a set with these `radii` that the `population` describes, with separations measured from `plane`, which is relative to
    /// the population's mean height and at the height `origin` (m) in the frame of the set.
    pub fn new(
        contact: &'a dyn MicroContact,
        radii: RadiiAbove<'a>,
        population: Population,
        mean_shape: Shape,
        plane: ReferencePlane,
        origin: f64,
    ) -> Self {
        Self { contact, population, mean_shape, plane, origin, radii }
    }

    /// The mean radius of the asperities above the reported separation `h`, m.
    pub fn radius(&self, h: f64) -> f64 {
        self.radii.mean(self.origin + h * self.plane.sigma)
    }

    fn at(&self, h: f64) -> Statistical<'a> {
        let radius = self.radius(h);
        let scale = radius / self.population.radius;
        let shape = Shape { radius: self.mean_shape.radius * scale, ..self.mean_shape };
        let population = Population { radius, ..self.population.clone() };
        Statistical::of_shape(self.contact, population, shape).reported_from(self.plane)
    }
}

impl Model for RadiusInContact<'_> {
    fn plane(&self) -> ReferencePlane {
        self.plane
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        parallel::map(separations.len(), |k| self.at(separations[k]).respond(separations[k]))
    }

    fn may_decrease(&self) -> bool {
        true
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        let highest = self.at(0.0).highest_separation().max(LOWEST_SEPARATION);
        let grid = descent(LOWEST_SEPARATION, highest);
        let reached: Vec<f64> =
            self.respond_all(&grid).iter().map(|response| response.pressure.total()).collect();
        let pressure = |h: f64| self.at(h).respond(h).pressure.total();
        let mut found = vec![None; pressures.len()];
        search_missing(&mut found, pressures, |wanted| {
            let first = reached.iter().position(|pressure| *pressure >= wanted)?;
            if first == 0 {
                Some(grid[0])
            } else {
                last_reaching(pressure, wanted, grid[first], grid[first - 1])
            }
        });
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asperity::AsperitySet;
    use crate::distribution::Heights;
    use crate::interface::Interface;
    use crate::law::Zmc;
    use crate::material::Material;

    #[test]
    fn the_radius_is_that_of_the_asperities_above() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let set = AsperitySet::new(vec![3e-8, -1e-8, 1e-8], vec![1e-6, 4e-6, 2e-6], 1e-10).unwrap();
        let population =
            Population { radius: 7e-6 / 3.0, sigma: 1e-8, density: 3e10, heights: Heights::GAUSSIAN };
        let shape = Shape::sphere(population.radius);
        let plane = ReferencePlane { mean: 0.0, sigma: 1e-8 };
        let model = RadiusInContact::new(&contact, set.radii_above(), population.clone(), shape, plane, 0.0);
        for (h, radius) in [(4.0, 1e-6), (2.0, 1e-6), (0.5, 1.5e-6), (-2.0, 7e-6 / 3.0)] {
            assert!((model.radius(h) / radius - 1.0).abs() < 1e-14, "{h}");
            let of_radius = Statistical::new(&contact, Population { radius, ..population.clone() });
            assert_eq!(model.respond(h).pressure, of_radius.respond(h).pressure);
        }
        let pressure = model.respond(1.7).pressure.total();
        let found = model.separation_at(pressure).unwrap();
        assert!(found >= 1.7 - 1e-12 && model.respond(found).pressure.total() >= pressure * (1.0 - 1e-12));
        assert_eq!(model.separation_at(1e30), None);
        // A heavy tail reaches separations of many thousand sigma.
        let heavy = Heights::new(crate::distribution::Weibull::new(0.5).unwrap());
        let population = Population { heights: heavy, ..population };
        let model = RadiusInContact::new(&contact, set.radii_above(), population, shape, plane, 0.0);
        let found = model.separation_at(pressure).unwrap();
        assert!((model.respond(found).pressure.total() / pressure - 1.0).abs() < 1e-9);
    }
}
