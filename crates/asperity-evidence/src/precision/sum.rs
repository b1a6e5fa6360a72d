//! Cost and error of summing asperities, by method.
//!
//! All methods add area and load of every asperity above the flat. Only the deterministic model runs as in production, with all its other
//! results.

use super::timing::{Candidate, medians};
use super::{Cost, Point, Problem, SHIPPED};
use crate::wide::Wide;
use asperity::numeric::Sum;
use asperity::{
    AsperitySet, Deterministic, Draw, MicroContact, Model, Population, ReferencePlane, Response, SetError,
    Shape,
};

/// Separations are spread evenly from the first to the last of these, d/sigma.
const SEPARATIONS: [f64; 2] = [4.0, 0.0];

/// Number of separations, which the shipped sum evaluates together.
const POINTS: usize = 10;

/// A random set and the contact that its asperities make.
struct RandomSet<'a> {
    contact: &'a dyn MicroContact,
    set: AsperitySet,
    sigma: f64,
}

impl RandomSet<'_> {
    /// Hands over area and load of each asperity above the flat at `h` = d/sigma.
    #[inline]
    fn each(&self, h: f64, mut add: impl FnMut([f64; 2])) {
        let separation = h * self.sigma;
        for (z, b) in self.set.heights().iter().zip(self.set.radii()) {
            if *z > separation {
                let contact = self.contact.contact(z - separation, Shape::sphere(*b));
                add([contact.area, contact.load]);
            }
        }
    }

    /// Area (m^2) and load (N) at one separation, one term after the other.
    fn naive(&self, h: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        self.each(h, |[area, load]| sums = [sums[0] + area, sums[1] + load]);
        sums
    }

    /// The same with the rounding error of every addition kept.
    fn compensated(&self, h: f64) -> [f64; 2] {
        let mut sums = [Sum::default(); 2];
        self.each(h, |[area, load]| {
            sums[0] += area;
            sums[1] += load;
        });
        sums.map(|sum| sum.value())
    }

    /// The deterministic model: compensated, in vector registers, all separations at once.
    fn shipped(&self, separations: &[f64]) -> Vec<[f64; 2]> {
        let plane = ReferencePlane { mean: 0.0, sigma: self.sigma };
        let model = Deterministic::new(self.contact, self.set.spheres(), plane);
        let area = self.set.nominal_area();
        let values =
            |response: Response| [response.area_ratio.total() * area, response.pressure.total() * area];
        model.respond_all(separations).into_iter().map(values).collect()
    }

    /// The sum of the same terms in about 32 digits.
    fn exact(&self, h: f64) -> [Wide; 2] {
        let mut sums = [Wide::ZERO; 2];
        self.each(h, |[area, load]| sums = [sums[0] + area, sums[1] + load]);
        sums
    }
}

/// Runs every method on a random set of `count` asperities, the shipped one on the threads of the pool that it is called in.
pub fn sums(
    contact: &dyn MicroContact,
    case: &'static str,
    population: &Population,
    count: usize,
    seed: [u8; 32],
) -> Result<Vec<Point>, SetError> {
    let set = RandomSet { contact, set: population.set(count, Draw::Random(seed))?, sigma: population.sigma };
    let [from, to] = SEPARATIONS;
    let separation = |k: usize| from + (to - from) * k as f64 / (POINTS - 1) as f64;
    let separations: Vec<f64> = (0..POINTS).map(separation).collect();
    let exact: Vec<[Wide; 2]> = separations.iter().map(|&h| set.exact(h)).collect();
    let methods: [Candidate<Vec<[f64; 2]>>; 3] = [
        Box::new(|| separations.iter().map(|&h| set.naive(h)).collect()),
        Box::new(|| separations.iter().map(|&h| set.compensated(h)).collect()),
        Box::new(|| set.shipped(&separations)),
    ];
    let point = |(method, (values, seconds)): (&'static str, (Vec<[f64; 2]>, f64))| Point {
        problem: Problem::Sum,
        case,
        method,
        effort: Some(count as f64),
        evaluations: None,
        cost: Cost::new(seconds, &values, &exact),
    };
    Ok(["naive", "compensated", SHIPPED].into_iter().zip(medians(&methods)).map(point).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::CASES;
    use asperity::{Interface, Material, Zmc};

    #[test]
    fn what_loses_digits_and_what_does_not() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let (case, population) = &CASES[0];
        let points = sums(&contact, case, population, 30_000, [5; 32]).unwrap();
        let [naive, compensated, shipped] = &points[..] else { panic!("{points:?}") };
        let error = |point: &Point| point.cost.error();
        assert!(error(compensated) < 3e-16 && error(shipped) < 1e-15);
        assert!(error(naive) > 3.0 * error(compensated) && error(naive) < 1e-12);
        assert!(points.iter().all(|point| point.cost.seconds > 0.0 && point.effort == Some(30_000.0)));
    }
}
