//! A micro-contact with what its spots conduct and bear in shear.

use super::{LoadBounds, MicroContact, Shapes};
use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns};
use crate::literature::Paper;
use crate::numeric::interval::Interval;
use crate::shape::Shape;
use crate::spot::{SpotProperties, SpotValues};

/// A micro-contact that also gives the values of its spots. Where an [`Accumulator`] wants them, each contact is evaluated a second
/// time; a search for a load does not.
pub struct WithSpots {
    contact: Box<dyn MicroContact>,
    properties: SpotProperties,
}

impl WithSpots {
    /// `contact` with what is asked of its spots.
    pub fn new(contact: Box<dyn MicroContact>, properties: SpotProperties) -> Self {
        Self { contact, properties }
    }

    fn values(&self, w: f64, shape: Shape) -> SpotValues {
        self.properties.values(w, &self.contact.contact(w, shape), shape)
    }
}

impl MicroContact for WithSpots {
    forward! { contact:
        fn contact(&self, w: f64, shape: Shape) -> Contact;
        fn regime_changes(&self, shape: Shape) -> Vec<f64>;
        fn may_decrease(&self, shapes: Shapes) -> Vec<Interval>;
        fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds;
        fn reference_modulus(&self) -> f64;
        fn reference_hardness(&self) -> f64;
        fn caveat(&self) -> Option<String>;
        fn is_layered(&self) -> bool;
    }

    fn spot_values(&self, w: f64, shape: Shape) -> Option<SpotValues> {
        Some(self.values(w, shape))
    }

    fn spot_properties(&self) -> Option<&SpotProperties> {
        Some(&self.properties)
    }

    fn contacts(&self, indentations: &[f64], shape: Shape) -> ContactColumns {
        self.contact.contacts(indentations, shape)
    }

    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        self.contact.accumulate_weighted(indentations, weights, shape, accumulator);
        if accumulator.wants_spots() {
            for (&w, &weight) in indentations.iter().zip(weights) {
                accumulator.add_spot(self.values(w, shape), weight);
            }
        }
    }

    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        self.contact.accumulate(asperities, separation, accumulator);
        if accumulator.wants_spots() {
            for (z, shape) in asperities.each() {
                accumulator.add_spot(self.values(z - separation, shape), 1.0);
            }
        }
    }

    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        let mut all = self.contact.breakpoints(shape);
        all.extend(self.properties.jumps());
        all.sort_unstable_by(f64::total_cmp);
        all
    }

    fn papers(&self) -> Vec<Paper> {
        [self.contact.papers(), self.properties.papers()].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asperity::{Draw, Population, Statistics};
    use crate::distribution::Heights;
    use crate::interface::Flat;
    use crate::law::{Hertz, Zmc};
    use crate::material::tests::steel;
    use crate::model::{Deterministic, Model, ReferencePlane, Response, Statistical, at_pressure};
    use crate::reduced_modulus;
    use crate::spot::{BrokenFilm, Conduction, Shear, ShearStrength};

    fn with_spots(law: impl crate::ScalableLaw, properties: SpotProperties) -> WithSpots {
        WithSpots::new(Flat::Bare(steel()).under(law, &steel()).unwrap(), properties)
    }

    fn population(heights: Heights) -> Population {
        Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights }
    }

    /// Both models at the separations 0 to 3 sigma.
    fn responses(contact: &dyn MicroContact, heights: Heights) -> Vec<[Response; 2]> {
        let population = population(heights);
        let set = population.set(5000, Draw::Random([3; 32])).unwrap();
        let plane = ReferencePlane::from(&Statistics::new(&set));
        let sum = Deterministic::new(contact, set.spheres(), plane);
        let integral = Statistical::new(contact, population);
        let at = |h: f64| [integral.respond(h), sum.respond(h)];
        [0.0, 1.0, 2.0, 3.0].map(at).to_vec()
    }

    fn conduction() -> Conduction {
        Conduction::new([1.7e-8, 1.43e-7]).unwrap()
    }

    /// Of exponential heights conductance and load are proportional under any law: p/(E* s sigma) under Hertz.
    #[test]
    fn exponential_heights_conduct_in_proportion_to_the_load() {
        let properties = SpotProperties { thermal: Some(conduction()), ..SpotProperties::default() };
        let elastic = responses(&with_spots(Hertz, properties.clone()), Heights::EXPONENTIAL);
        let expected = (reduced_modulus(&steel(), &steel()) * conduction().resistivity() * 4.8e-8).recip();
        for [integral, _] in &elastic {
            let ratio = integral.spots[1] / integral.pressure.total();
            assert!((ratio / expected - 1.0).abs() < 1e-12);
        }
        let yielding = responses(&with_spots(Zmc::default(), properties), Heights::EXPONENTIAL);
        let ratio = |[integral, _]: &[Response; 2]| integral.spots[1] / integral.pressure.total();
        assert!(yielding.iter().all(|one| (ratio(one) / ratio(&yielding[0]) - 1.0).abs() < 1e-12));
    }

    /// A film that is broken at once, or never; between them the integral has a jump, which its pieces end at.
    #[test]
    fn a_broken_film_shears_as_the_bodies() {
        let (film, bodies) =
            (ShearStrength { tau0: 20e6, alpha: 0.0 }, ShearStrength { tau0: 800e6, alpha: 0.0 });
        let of = |from: f64| {
            let shear = Some(Shear { strength: film, broken: Some(BrokenFilm { from, strength: bodies }) });
            let contact = with_spots(Hertz, SpotProperties { shear, ..SpotProperties::default() });
            responses(&contact, Heights::GAUSSIAN)[1]
                .map(|response| response.spots[2] / response.area_ratio.total())
        };
        for (found, expected) in [(of(1e-30), 800e6), (of(1.0), 20e6)] {
            assert!(found.iter().all(|tau| (tau / expected - 1.0).abs() < 1e-12), "{found:?}");
        }
        // Contacts deeper than d: pi R sigma int_(h + d)^inf (x - h) phi(x) dx of pi R sigma int_h^inf.
        let (h, from) = (1.0, 0.5 * 4.8e-8);
        let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
        let tail = |x: f64| 0.5 * libm::erfc(x / std::f64::consts::SQRT_2);
        let area = |from: f64| density(from) - h * tail(from);
        let share = area(h + 0.5) / area(h);
        let expected = 20e6 + share * 780e6;
        assert!((of(from)[0] / expected - 1.0).abs() < 1e-12);
    }

    /// A search for a load does not look at spots, a response does.
    #[test]
    fn spots_are_evaluated_where_they_are_wanted() {
        let properties = SpotProperties { electrical: Some(conduction()), ..SpotProperties::default() };
        let contact = with_spots(Zmc::default(), properties);
        let integral = Statistical::new(&contact, population(Heights::GAUSSIAN));
        let found = at_pressure(&integral, 1e7).unwrap().response;
        let again = integral.respond(found.separation_over_sigma);
        assert_eq!(found, again);
        assert!(found.spots[0] > 0.0 && integral.respond_without_spots(&[1.0])[0].spots == [0.0; 4]);
    }
}
