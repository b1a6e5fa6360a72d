//! Convergence of the deterministic model to the statistical one as the number of asperities grows, for equal radii and
//! heights drawn from the density of the integral.

use std::f64::consts::PI;

use super::Pair;
use crate::asperity::{AsperitySet, Draw, Population, SetError};
use crate::contact::Contact;
use crate::contact_law::ContactLaw;
use crate::distribution::gaussian_moment;
use crate::interface::MicroContact;
use crate::model::{Deterministic, MIN_CONTACTS, Model, ReferencePlane, Response, Statistical};
use crate::named_enum;
use crate::shape::Shape;

/// Sets of asperities of growing size.
#[derive(Debug, Clone)]
pub struct LimitSets {
    /// What they are drawn from.
    pub population: Population,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Asperities in a set.
    pub counts: Vec<usize>,
    /// Random sets of each size; one more has its heights at the quantiles.
    pub draws: usize,
}

impl LimitSets {
    /// Asperities in all sets.
    pub fn asperities(&self) -> usize {
        self.counts.iter().sum::<usize>() * (self.draws + 1)
    }
}

/// One law with its exact responses.
pub struct LimitCase<'a> {
    /// The law, as tables name it.
    pub law: String,
    /// The micro-contact.
    pub contact: &'a dyn MicroContact,
    /// The limit of the sum at each separation.
    pub exact: Vec<Exact>,
}

impl<'a> LimitCase<'a> {
    /// The limit of sets with Gaussian heights: Greenwood and Williamson's closed form for Hertz's law, else the integral.
    pub fn new(law: &ContactLaw, contact: &'a dyn MicroContact, sets: &LimitSets) -> Self {
        let limit = |integral| match law.is_greenwood_williamson() {
            true => Exact::greenwood_williamson(integral, &sets.population, contact.reference_modulus()),
            false => Exact::of_integral(integral, sets.population.density),
        };
        let integrals = Statistical::new(contact, sets.population.clone()).respond_all(&sets.separations);
        Self { law: law.label(), contact, exact: integrals.into_iter().map(limit).collect() }
    }
}

/// The limit at one separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exact {
    /// Response of the statistical model.
    pub statistical: Response,
    /// Fraction of asperities in contact.
    pub contact_fraction: f64,
    /// Real over nominal area.
    pub area_ratio: f64,
    /// Nominal pressure, Pa.
    pub pressure: f64,
}

impl Exact {
    /// The integral itself as the limit, with `density` asperities per nominal area (1/m^2).
    pub fn of_integral(statistical: Response, density: f64) -> Self {
        Self {
            statistical,
            contact_fraction: statistical.contact_density / density,
            area_ratio: statistical.area_ratio.total(),
            pressure: statistical.pressure.total(),
        }
    }

    /// Greenwood and Williamson's closed form as the limit: Hertz's law on Gaussian heights of `population`, with the reduced
    /// `modulus` (Pa).
    pub fn greenwood_williamson(statistical: Response, population: &Population, modulus: f64) -> Self {
        let &Population { radius, sigma, density, .. } = population;
        let moment = |n| gaussian_moment(n, statistical.separation_over_sigma);
        Self {
            area_ratio: PI * density * radius * sigma * moment(1.0),
            pressure: 4.0 / 3.0 * density * modulus * radius.sqrt() * sigma.powf(1.5) * moment(1.5),
            ..Self::of_integral(statistical, density)
        }
    }
}

/// Sets of one size at one separation under one law.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitPoint {
    /// The law, as tables name it.
    pub law: String,
    /// The limit of the sets' responses.
    pub exact: Exact,
    /// Asperities in a set.
    pub count: usize,
    /// Response of each random set.
    pub random: Vec<Response>,
    /// Response of the set with heights at the quantiles.
    pub quantiles: Response,
    /// Its expected errors; see [`Self::expected_quantile_error`].
    expected_quantile_errors: [f64; 2],
}

named_enum! {
    /// A quantity whose error is evaluated.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum LimitQuantity {
        /// Real contact area.
        Area = "area",
        /// Load.
        Load = "load",
    }
}

named_enum! {
    /// How the heights of a set are taken from their density.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum HeightSampling {
        /// Independent draws.
        Random = "random",
        /// At the quantiles.
        Quantiles = "quantiles",
    }
}

impl LimitPoint {
    /// d/sigma.
    pub fn separation_over_sigma(&self) -> f64 {
        self.exact.statistical.separation_over_sigma
    }

    /// Expected number of contacts.
    pub fn expected_contacts(&self) -> f64 {
        self.exact.contact_fraction * self.count as f64
    }

    /// Whether enough contacts are expected for the errors to follow their power law.
    pub fn is_fitted(&self) -> bool {
        self.expected_contacts() > MIN_CONTACTS
    }

    /// Signed relative error of one response.
    pub fn error(&self, response: &Response, quantity: LimitQuantity) -> f64 {
        match quantity {
            LimitQuantity::Area => response.area_ratio.total() / self.exact.area_ratio - 1.0,
            LimitQuantity::Load => response.pressure.total() / self.exact.pressure - 1.0,
        }
    }

    /// Mean and root mean square of the random sets' relative errors.
    pub fn scatter(&self, quantity: LimitQuantity) -> (f64, f64) {
        let count = self.random.len() as f64;
        let errors = || self.random.iter().map(|response| self.error(response, quantity));
        (errors().sum::<f64>() / count, (errors().map(|error| error * error).sum::<f64>() / count).sqrt())
    }

    /// Magnitude of the relative error of the set with heights at the quantiles.
    pub fn quantile_error(&self, quantity: LimitQuantity) -> f64 {
        self.error(&self.quantiles, quantity).abs()
    }

    /// Relative error of the sets: root mean square of the random ones, or magnitude of that at the quantiles.
    pub fn error_of_sets(&self, sampling: HeightSampling, quantity: LimitQuantity) -> f64 {
        match sampling {
            HeightSampling::Random => self.scatter(quantity).1,
            HeightSampling::Quantiles => self.quantile_error(quantity),
        }
    }

    /// The integral with each set: way to take the heights, number of the set from 1, and both responses.
    pub fn pairs(&self) -> impl Iterator<Item = (HeightSampling, usize, Pair)> {
        let random = (1..).zip(&self.random).map(|(draw, sum)| (HeightSampling::Random, draw, sum));
        let sets = random.chain([(HeightSampling::Quantiles, 1, &self.quantiles)]);
        let integral = self.exact.statistical;
        sets.map(move |(sampling, draw, sum)| (sampling, draw, Pair::at_separation(integral, *sum)))
    }

    /// Leading term of [`Self::quantile_error`] for many asperities.
    ///
    /// Heights at the middles of n equally probable strata are a midpoint rule in the probability u of a greater height,
    /// on [0, 1]. Its integrand g(u), the area or load of an asperity, has a logarithmic singularity at u = 0. There
    /// g = -ln u gives an error of -ln 2/(2n), and -dg/d ln u varies so slowly that it may be taken at
    /// 1/(2^1.5 pi n), which makes (ln u)^2 exact too. With a difference over u = 1/2 to 2 times that one, the error is
    /// -[g(1/2) - g(2)]/(4n). What is neglected decreases as n^-2, by the start of contact and changes of regime.
    pub fn expected_quantile_error(&self, quantity: LimitQuantity) -> f64 {
        self.expected_quantile_errors[quantity as usize]
    }
}

/// Responses of all sets under every law at every separation. `seed(count, draw)` is the seed of a random set; `done` is called
/// after each set.
///
/// # Errors
/// See [`Population::set`].
pub fn convergence(
    cases: &[LimitCase],
    sets: &LimitSets,
    seed: impl Fn(usize, usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<Vec<LimitPoint>, SetError> {
    let &LimitSets { ref population, ref counts, draws, .. } = sets;
    let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
    let mut points = Vec::new();
    for &count in counts {
        let random = (0..draws).map(|k| Draw::Random(seed(count, k)));
        // One set at a time, under every law at every separation.
        let mut responses = Vec::with_capacity(draws + 1);
        for draw in random.chain([Draw::Quantiles]) {
            let set = population.set(count, draw)?;
            responses
                .push(cases.iter().flat_map(|case| respond_to_set(case, &set, plane)).collect::<Vec<_>>());
            done(count);
        }
        let Some(quantiles) = responses.pop() else { continue };
        let limits = cases.iter().flat_map(|case| case.exact.iter().map(move |exact| (case, exact)));
        for (k, (&LimitCase { ref law, contact, .. }, exact)) in limits.enumerate() {
            points.push(LimitPoint {
                law: law.clone(),
                exact: *exact,
                count,
                expected_quantile_errors: expected_quantile_errors(contact, population, exact, count),
                random: responses.iter().map(|set| set[k]).collect(),
                quantiles: quantiles[k],
            });
        }
    }
    Ok(points)
}

/// See [`LimitPoint::expected_quantile_error`]: of the area and of the load.
fn expected_quantile_errors(
    contact: &dyn MicroContact,
    population: &Population,
    exact: &Exact,
    count: usize,
) -> [f64; 2] {
    let share = 1.0 / (2f64.powf(1.5) * PI * count as f64);
    let at = |times: f64| {
        let height = population.sigma * population.heights.quantile(1.0 - times * share);
        let indentation = height - exact.statistical.separation;
        if indentation <= 0.0 {
            return [0.0; 2];
        }
        let Contact { area, load, .. } = contact.contact(indentation, Shape::sphere(population.radius));
        [area, load]
    };
    let (higher, lower) = (at(0.5), at(2.0));
    let per_area = population.density / (4.0 * count as f64);
    let limits = [exact.area_ratio, exact.pressure];
    [0, 1].map(|k| ((higher[k] - lower[k]) * per_area / limits[k]).abs())
}

fn respond_to_set(case: &LimitCase, set: &AsperitySet, plane: ReferencePlane) -> Vec<Response> {
    let separations: Vec<f64> =
        case.exact.iter().map(|exact| exact.statistical.separation_over_sigma).collect();
    Deterministic::new(case.contact, set.spheres(), plane).respond_all(&separations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{ErrorSlope, SlopeFit};
    use crate::contact_law::named;
    use crate::distribution::Heights;
    use crate::interface::{Flat, Interface};
    use crate::law::Hertz;
    use crate::material::Material;

    const COUNTS: [usize; 6] = [100, 1_000, 10_000, 100_000, 300_000, 1_000_000];

    /// Case 1 of Table 1 under Hertz, with heights of one distribution.
    fn points(heights: Heights, separations: &[f64]) -> Vec<LimitPoint> {
        let steel = Material::new(210e9, 0.3, None, None).unwrap();
        let contact = Interface::bare(Hertz, &steel, &steel).unwrap();
        let population = Population { radius: 20e-6, sigma: 48e-9, density: 6e10, heights };
        let responses = Statistical::new(&contact, population.clone()).respond_all(separations);
        let exact =
            responses.into_iter().map(|response| Exact::of_integral(response, population.density)).collect();
        let case = LimitCase { law: String::new(), contact: &contact, exact };
        let separations = separations.to_vec();
        let sets = LimitSets { population, separations, counts: COUNTS.to_vec(), draws: 0 };
        convergence(&[case], &sets, |_, _| [0; 32], |_| ()).unwrap()
    }

    /// Two independent evaluations of the limit under Hertz's law, to the accuracy of the closed form (see
    /// [`gaussian_moment`]); another law has the integral.
    #[test]
    fn the_closed_form_of_greenwood_and_williamson_is_the_integral() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let population =
            Population { radius: 20e-6, sigma: 48e-9, density: 6e10, heights: Heights::GAUSSIAN };
        let sets = LimitSets { population, separations: vec![0.0, 1.0, 3.0], counts: vec![10], draws: 0 };
        for (name, is_closed) in [("hertz", true), ("zmc", false)] {
            let law = named(name).unwrap();
            assert_eq!(law.is_greenwood_williamson(), is_closed);
            let contact = law.interface(&steel, &Flat::Bare(steel)).unwrap();
            for exact in LimitCase::new(&law, &*contact, &sets).exact {
                let integral = Exact::of_integral(exact.statistical, sets.population.density);
                assert_eq!(exact.contact_fraction, integral.contact_fraction);
                for (limit, integral) in
                    [(exact.area_ratio, integral.area_ratio), (exact.pressure, integral.pressure)]
                {
                    let off = (limit / integral - 1.0).abs();
                    assert!(if is_closed { off < 3e-11 } else { off == 0.0 }, "{name}: {off:e}");
                }
            }
        }
    }

    #[test]
    fn slopes_are_in_the_order_of_laws_separations_quantities_and_heights() {
        let slopes = ErrorSlope::all(&points(Heights::GAUSSIAN, &[0.0, 1.0]));
        let quantiles: Vec<_> =
            slopes.iter().filter(|slope| slope.sampling == HeightSampling::Quantiles).collect();
        let order: Vec<_> = quantiles.iter().map(|slope| (slope.separation, slope.quantity)).collect();
        let [area, load] = LimitQuantity::ALL;
        assert_eq!(order, [(0.0, area), (0.0, load), (1.0, area), (1.0, load)]);
        for slope in quantiles {
            assert!(slope.deviation() < 0.01 && slope.expected < -1.0, "{slope:?}");
            assert_eq!(slope.errors.len(), slope.fit.points);
        }
    }

    #[test]
    fn sums_over_quantiles_have_the_expected_error() {
        for point in points(Heights::GAUSSIAN, &[0.0, 1.0, 2.0, 3.0]) {
            for quantity in LimitQuantity::ALL {
                let [found, expected] =
                    [point.quantile_error(quantity), point.expected_quantile_error(quantity)];
                let off = (found / expected - 1.0).abs();
                if point.is_fitted() {
                    assert!(off < 0.01, "{quantity:?}, {} asperities: {found} and {expected}", point.count);
                } else if point.expected_contacts() < 1.0 {
                    assert!(off > 0.1, "without a contact there is no leading term");
                }
            }
        }
    }

    /// The area of exponential heights above zero separation is exactly the logarithm.
    #[test]
    fn exponential_heights_have_the_error_of_the_logarithm() {
        // Heights are about their mean: the lowest is at -1 sigma.
        for point in points(Heights::EXPONENTIAL, &[-1.0]) {
            let expected = 0.5 * std::f64::consts::LN_2 / point.count as f64;
            assert!((point.expected_quantile_error(LimitQuantity::Area) / expected - 1.0).abs() < 1e-8);
            // The next term is that of the lowest heights.
            let next = 0.2 / point.count as f64;
            assert!((point.quantile_error(LimitQuantity::Area) / expected - 1.0).abs() < next);
        }
    }

    /// The local slope is -1 - 1/(2 ln n) for the area, and less steep for the load.
    #[test]
    fn the_expected_slope_is_steeper_than_that_of_a_midpoint_rule_by_a_logarithm() {
        let points = points(Heights::GAUSSIAN, &[0.0]);
        let slope = |quantity| {
            let errors =
                points.iter().map(|point| (point.count as f64, point.expected_quantile_error(quantity)));
            SlopeFit::through(errors).unwrap().slope
        };
        assert!((slope(LimitQuantity::Area) + 1.05).abs() < 0.005, "{}", slope(LimitQuantity::Area));
        assert!((slope(LimitQuantity::Load) + 1.025).abs() < 0.005, "{}", slope(LimitQuantity::Load));
    }
}
