//! Cost of integrating one micro-contact over the heights, by rule and order or tolerance.
//!
//! Every rule gives area and load and evaluates the same contact, node by node. Only the rule of the statistical model runs as in
//! production, with all its other results. The integral is split where the law changes, and its variable is the square root of the
//! indentation, in which the load is smooth.

use std::hint::black_box;
use std::iter::once;
use std::num::NonZeroUsize;

use asperity_fft::Complex;
use gauss_quad::GaussLegendre;
use quad_rs::{Integrable, IntegratorConfig, integrate_real};

use super::timing::{Candidate, medians};
use super::{Cost, Point, Problem, SHIPPED};
use crate::Failed;
use crate::exact::{self, Bodies, Exact, Integral};
use crate::wide::Wide;
use asperity::distribution::Gaussian;
use asperity::{HeightDistribution, MicroContact, Model, Population, Shape, Statistical};

/// Gauss-Legendre (gauss-quad) with so many nodes per piece.
const LEGENDRE: &str = "gauss-legendre";
const ORDERS: [usize; 13] = [2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];

/// Adaptive Gauss-Kronrod (quad-rs) within a relative tolerance of area and load.
const KRONROD: &str = "gauss-kronrod";
const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Area ratio and pressure, and how many contacts were evaluated.
type Evaluated = ([f64; 2], usize);

/// One micro-contact over one population.
struct Integrand<'a> {
    contact: &'a dyn MicroContact,
    population: &'a Population,
    /// In units of sigma, ascending.
    breakpoints: Vec<f64>,
}

impl Integrand<'_> {
    /// Area and load at the indentation `x` in sigma.
    #[inline]
    fn values(&self, x: f64) -> [f64; 2] {
        let Population { radius, sigma, .. } = *self.population;
        let contact = self.contact.contact(x * sigma, Shape::sphere(radius));
        [contact.area, contact.load]
    }

    /// Area and load at the indentation `s`^2, times the density relative to that at the flat.
    #[inline]
    fn at(&self, h: f64, s: f64) -> [f64; 2] {
        let x = s * s;
        let density = 2.0 * s * (-Gaussian.exponent(h, x)).exp();
        self.values(x).map(|value| density * value)
    }

    /// The ends of the pieces at `h` = d/sigma.
    fn ends(&self, h: f64) -> impl Iterator<Item = f64> {
        let [start, end] = Gaussian.window(h);
        let between = self.breakpoints.iter().copied().filter(move |x| start < *x && *x < end);
        once(start).chain(between).chain(once(end)).map(f64::sqrt)
    }

    fn scale(&self, h: f64) -> f64 {
        self.population.density * Gaussian.scale(h)
    }

    /// By nodes and weights on [-1, 1].
    fn legendre(&self, nodes: &[(f64, f64)], h: f64) -> Evaluated {
        let (mut sums, mut evaluations) = ([0.0; 2], 0);
        let mut ends = self.ends(h);
        let mut from = ends.next().unwrap_or_default();
        for to in ends {
            let half = 0.5 * (to - from);
            for (x, weight) in nodes {
                let [area, load] = self.at(h, from + half * (1.0 + x));
                sums = [sums[0] + half * weight * area, sums[1] + half * weight * load];
            }
            evaluations += nodes.len();
            from = to;
        }
        (sums.map(|sum| sum * self.scale(h)), evaluations)
    }

    fn kronrod(&self, tolerance: f64, h: f64) -> Option<Evaluated> {
        /// Evaluations before it gives up.
        const MOST: usize = 100_000;
        // Area and load are scaled to near 1; the tolerance applies to the norm of both.
        let unit = self.values(1.0);
        let config = IntegratorConfig::default()
            .with_relative_tolerance(tolerance)
            .with_absolute_tolerance(0.0)
            .with_minimum_segment_width(f64::MIN_POSITIVE)
            .with_max_function_evalutions(MOST)
            .with_tolerance_window(1);
        let above = Above { integrand: self, h, unit };
        let output = integrate_real(above, self.ends(h).collect(), config).ok()?;
        let values = [output.integral.re * unit[0], output.integral.im * unit[1]];
        Some((values.map(|value| value * self.scale(h)), output.evaluations))
    }
}

/// Area and load above the flat, as the integrand of quad-rs.
struct Above<'a> {
    integrand: &'a Integrand<'a>,
    h: f64,
    unit: [f64; 2],
}

impl Integrable for Above<'_> {
    type Float = f64;
    type Input = f64;
    type Output = Complex<f64>;

    fn integrand(&self, s: &f64) -> Complex<f64> {
        let [area, load] = self.integrand.at(self.h, *s);
        Complex::new(area / self.unit[0], load / self.unit[1])
    }
}

/// A rule at all separations; `None` where it gives up.
fn over<'a>(
    separations: &'a [f64],
    rule: impl Fn(f64) -> Option<Evaluated> + 'a,
) -> Candidate<'a, Option<Vec<Evaluated>>> {
    Box::new(move || separations.iter().map(|&h| rule(black_box(h))).collect())
}

/// Runs every rule on a population at `separations` (d/sigma, at least one).
pub fn integrals(
    bodies: &Bodies,
    case: &'static str,
    population: &Population,
    separations: &[f64],
) -> Result<Vec<Point>, Failed> {
    let contact = &*bodies.contact()?;
    let (exact, sphere) = (Exact::new(bodies), exact::Shape::sphere(population.radius));
    let reference = |&separation: &f64| {
        let total = exact.integral(&Integral::new(population, separation)?, &sphere)?;
        Some([total.total_area(), total.total_load()])
    };
    let exact: Option<Vec<[Wide; 2]>> = separations.iter().map(reference).collect();
    let exact = exact.ok_or("the reference integral does not settle in 32 digits")?;
    let breakpoints = contact.breakpoints(Shape::sphere(population.radius));
    let breakpoints = breakpoints.into_iter().map(|w| w / population.sigma).collect();
    let integrand = &Integrand { contact, population, breakpoints };
    let shipped = Statistical::new(contact, population.clone());
    // Those of one name together and the fastest first.
    let (mut rules, mut candidates) = (Vec::new(), Vec::new());
    for order in ORDERS.into_iter().filter_map(NonZeroUsize::new) {
        let nodes = GaussLegendre::new(order).as_node_weight_pairs().to_vec();
        rules.push((LEGENDRE, Some(order.get() as f64)));
        candidates.push(over(separations, move |h| Some(integrand.legendre(&nodes, h))));
    }
    for tolerance in TOLERANCES {
        rules.push((KRONROD, Some(tolerance)));
        candidates.push(over(separations, move |h| integrand.kronrod(tolerance, h)));
    }
    rules.push((SHIPPED, None));
    candidates.push(over(separations, |h| {
        let response = shipped.respond(h);
        Some(([response.area_ratio.total(), response.pressure.total()], 0))
    }));
    let measured = medians(&candidates);
    let points = rules.into_iter().zip(measured).filter_map(|((method, effort), (results, seconds))| {
        let results = results?;
        let values: Vec<[f64; 2]> = results.iter().map(|(values, _)| *values).collect();
        let count: usize = results.iter().map(|(_, count)| count).sum();
        let evaluations = (count > 0).then(|| count as f64 / separations.len() as f64);
        let cost = Cost::new(seconds, &values, &exact);
        Some(Point { problem: Problem::Integral, case, method, effort, evaluations, cost })
    });
    Ok(points.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::CoveredLaw;
    use crate::precision::CASES;
    use asperity::Material;

    #[test]
    fn rules_are_as_exact_as_they_should_be() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
        let (case, population) = &CASES[0];
        let points = integrals(&bodies, case, population, &[-1.0, 0.0, 2.0]).unwrap();
        let error = |method: &str, effort: Option<f64>| {
            let point = points.iter().find(|point| point.method == method && point.effort == effort);
            point.unwrap().cost.error()
        };
        assert!(error(LEGENDRE, Some(8.0)) > 100.0 * error(LEGENDRE, Some(24.0)));
        assert!(error(LEGENDRE, Some(64.0)) < 1e-13);
        for tolerance in TOLERANCES {
            assert!(error(KRONROD, Some(tolerance)) < tolerance);
        }
        assert!(error(SHIPPED, None) < 1e-13);
        assert_eq!(points.len(), ORDERS.len() + TOLERANCES.len() + 1);
        assert!(points.iter().all(|point| point.cost.error().is_finite() && point.cost.seconds > 0.0));
        let shipped = points.last().unwrap();
        assert!(shipped.method == SHIPPED && shipped.evaluations.is_none());
    }
}
