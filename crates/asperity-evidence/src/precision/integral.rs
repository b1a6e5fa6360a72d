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
use super::{Case, Cost};
use crate::exact::{self, Bodies, Exact, Integral};
use crate::wide::Wide;
use asperity::distribution::Gaussian;
use asperity::{ContactError, HeightDistribution, MicroContact, Model, Shape, Statistical};

const ORDERS: [usize; 13] = [2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];

const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// Gauss-Legendre (gauss-quad) with so many nodes per piece.
    Legendre(usize),
    /// Adaptive Gauss-Kronrod (quad-rs) within a relative tolerance of area and load.
    Kronrod(f64),
    Shipped,
}

impl Rule {
    /// All rules, those of one name together and the fastest first.
    fn all() -> impl Iterator<Item = Self> {
        let (legendre, kronrod) = (ORDERS.map(Self::Legendre), TOLERANCES.map(Self::Kronrod));
        legendre.into_iter().chain(kronrod).chain([Self::Shipped])
    }

    pub const fn name(self) -> &'static str {
        match self {
            Self::Legendre(_) => "gauss-legendre, split and substituted",
            Self::Kronrod(_) => "gauss-kronrod, split and substituted",
            Self::Shipped => "shipped",
        }
    }

    /// Nodes per piece, where they are fixed.
    pub const fn order(self) -> Option<usize> {
        if let Self::Legendre(order) = self { Some(order) } else { None }
    }

    pub const fn tolerance(self) -> Option<f64> {
        if let Self::Kronrod(tolerance) = self { Some(tolerance) } else { None }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct IntegralPoint {
    pub case: &'static str,
    pub rule: Rule,
    /// Contacts evaluated, in the mean of the separations; `None` of the shipped rule, which does not report it.
    pub evaluations: Option<f64>,
    /// Per separation.
    pub cost: Cost,
}

/// Area ratio and pressure, and how many contacts were evaluated.
type Evaluated = ([f64; 2], usize);

/// Nodes and weights on [-1, 1].
type Nodes = Vec<(f64, f64)>;

/// One micro-contact and one population.
struct Problem<'a> {
    contact: &'a dyn MicroContact,
    shape: Shape,
    sigma: f64,
    density: f64,
    /// In units of sigma, ascending.
    breakpoints: Vec<f64>,
}

impl Problem<'_> {
    /// Area and load at the indentation `x` in sigma.
    #[inline]
    fn values(&self, x: f64) -> [f64; 2] {
        let contact = self.contact.contact(x * self.sigma, self.shape);
        [contact.area, contact.load]
    }

    /// Area and load at the indentation `s`^2, times the density relative to that at the flat.
    #[inline]
    fn integrand(&self, h: f64, s: f64) -> [f64; 2] {
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

    fn legendre(&self, nodes: &[(f64, f64)], h: f64) -> Evaluated {
        let (mut sums, mut evaluations) = ([0.0; 2], 0);
        let mut ends = self.ends(h);
        let mut from = ends.next().unwrap_or_default();
        for to in ends {
            let half = 0.5 * (to - from);
            for (x, weight) in nodes {
                let [area, load] = self.integrand(h, from + half * (1.0 + x));
                sums = [sums[0] + half * weight * area, sums[1] + half * weight * load];
            }
            evaluations += nodes.len();
            from = to;
        }
        let scale = self.density * Gaussian.scale(h);
        (sums.map(|sum| sum * scale), evaluations)
    }

    /// By quad-rs; `None` where it gives up.
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
        let output = integrate_real(Above { problem: self, h, unit }, self.ends(h).collect(), config).ok()?;
        let scale = self.density * Gaussian.scale(h);
        let values = [output.integral.re * unit[0] * scale, output.integral.im * unit[1] * scale];
        Some((values, output.evaluations))
    }
}

/// Area and load above the flat, as the integrand of quad-rs.
struct Above<'a> {
    problem: &'a Problem<'a>,
    h: f64,
    unit: [f64; 2],
}

impl Integrable for Above<'_> {
    type Float = f64;
    type Input = f64;
    type Output = Complex<f64>;

    fn integrand(&self, s: &f64) -> Complex<f64> {
        let [area, load] = self.problem.integrand(self.h, *s);
        Complex::new(area / self.unit[0], load / self.unit[1])
    }
}

/// Runs every rule on a population at `separations` (d/sigma, at least one); `None` where the reference does not settle.
pub fn integrals(
    bodies: &Bodies,
    case: &Case,
    separations: &[f64],
) -> Result<Option<Vec<IntegralPoint>>, ContactError> {
    let (contact, population) = (&*bodies.contact()?, case.population());
    let reference = |&separation: &f64| {
        let integral = Integral::new(&population, separation)?;
        let total = Exact::new(bodies).integral(&integral, &exact::Shape::sphere(case.radius))?;
        Some([total.total_area(), total.total_load()])
    };
    let exact: Option<Vec<[Wide; 2]>> = separations.iter().map(reference).collect();
    let Some(exact) = exact else { return Ok(None) };
    let shape = Shape::sphere(case.radius);
    let problem = Problem {
        contact,
        shape,
        sigma: case.sigma,
        density: case.density,
        breakpoints: contact.breakpoints(shape).into_iter().map(|w| w / case.sigma).collect(),
    };
    let shipped = Statistical::new(contact, population.clone());
    let nodes = |rule: Rule| {
        let order = rule.order().and_then(NonZeroUsize::new);
        order.map_or_else(Vec::new, |order| GaussLegendre::new(order).as_node_weight_pairs().to_vec())
    };
    let evaluate = |rule: Rule, nodes: &[(f64, f64)], h: f64| match rule {
        Rule::Legendre(_) => Some(problem.legendre(nodes, h)),
        Rule::Kronrod(tolerance) => problem.kronrod(tolerance, h),
        Rule::Shipped => {
            let response = shipped.respond(h);
            Some(([response.area_ratio.total(), response.pressure.total()], 0))
        }
    };
    // Rules with a result at every separation.
    let mut evaluated: Vec<(Rule, Nodes, Vec<Evaluated>)> = Vec::new();
    for rule in Rule::all() {
        let nodes = nodes(rule);
        let results: Option<_> = separations.iter().map(|&h| evaluate(rule, &nodes, h)).collect();
        evaluated.extend(results.map(|results| (rule, nodes, results)));
    }
    let mut candidates: Vec<Candidate> = Vec::new();
    for (rule, nodes, _) in &evaluated {
        let evaluate = &evaluate;
        candidates.push(Box::new(move || {
            for &h in separations {
                black_box(evaluate(*rule, nodes, black_box(h)));
            }
        }));
    }
    let seconds = medians(&mut candidates);
    let points = evaluated.iter().zip(seconds).map(|((rule, _, results), seconds)| {
        let values: Vec<[f64; 2]> = results.iter().map(|(values, _)| *values).collect();
        let count: usize = results.iter().map(|(_, count)| count).sum();
        IntegralPoint {
            case: case.name,
            rule: *rule,
            evaluations: (count > 0).then(|| count as f64 / separations.len() as f64),
            cost: Cost::new(seconds, &values, &exact),
        }
    });
    Ok(Some(points.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::CoveredLaw;
    use asperity::Material;

    #[test]
    fn rules_are_as_exact_as_they_should_be() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
        let case = Case { name: "one", radius: 2e-5, sigma: 4.8e-8, density: 6e10 };
        let points = integrals(&bodies, &case, &[-1.0, 0.0, 2.0]).unwrap().unwrap();
        let error = |rule: Rule| points.iter().find(|point| point.rule == rule).unwrap().cost.error();
        assert!(error(Rule::Legendre(8)) > 100.0 * error(Rule::Legendre(24)));
        assert!(error(Rule::Legendre(64)) < 1e-13);
        for tolerance in TOLERANCES {
            assert!(error(Rule::Kronrod(tolerance)) < tolerance);
        }
        assert!(error(Rule::Shipped) < 1e-13);
        assert_eq!(points.len(), ORDERS.len() + TOLERANCES.len() + 1);
        assert!(points.iter().all(|point| point.cost.error().is_finite() && point.cost.seconds > 0.0));
        let shipped = points.last().unwrap();
        assert!(shipped.rule == Rule::Shipped && shipped.evaluations.is_none());
    }
}
