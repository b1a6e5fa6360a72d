//! Cost of integrating one micro-contact over the heights, by rule and order.
//!
//! Every rule gives area and load and evaluates the same contact, node by node. Only the rule of
//! the statistical model runs as in production, with all its other results.

use std::hint::black_box;
use std::num::NonZeroUsize;

use asperity_fft::Complex;
use quad_rs::{Integrable, IntegratorConfig, integrate_real};

use super::Cost;
use super::rules::{self, Node};
use super::timing::{Candidate, medians};
use crate::stability::exact::Integral;
use crate::stability::exact::{self, Exact};
use crate::stability::wide::{Wide, relative_error};
use asperity::distribution::Gaussian;
use asperity::{HeightDistribution, Heights, MicroContact, Model, Population, Shape, Statistical};

pub use super::rules::Family;

/// E-foldings of the density over one panel of [`Family::Panels`]; where the density also rises, fewer.
const FOLDINGS: [f64; 2] = [20.0, 8.0];

/// Order of the shipped rule in each of its panels.
const SHIPPED_ORDER: usize = 24;

/// Orders of Gauss rules.
const ORDERS: [usize; 13] = [2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128];

/// Orders of rules of equal steps, and of Gauss rules where the integrand is not smooth.
const MANY: [usize; 6] = [8, 16, 32, 64, 128, 256];

/// A rule and how it is used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    /// The family.
    pub family: Family,
    /// Whether the integral is split where the law changes.
    pub split: bool,
    /// Whether the variable is w^.5 (Laguerre: up to the last breakpoint).
    pub substituted: bool,
    /// Its order or tolerance.
    pub effort: Effort,
}

/// Order or tolerance of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effort {
    /// Nodes or steps of each panel.
    Order(usize),
    /// A relative tolerance.
    Tolerance(f64),
    /// As it is.
    Fixed,
}

/// One rule on one population.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegralPoint {
    /// The rule.
    pub rule: Rule,
    /// Contacts evaluated, in the mean of the separations; `None` where the rule does not report it.
    pub evaluations: Option<f64>,
    /// The largest relative error of the area over the separations.
    pub area_error: f64,
    /// The same of the load.
    pub load_error: f64,
    /// Both.
    pub cost: Cost,
}

/// All rules on one population.
#[derive(Debug, Clone, PartialEq)]
pub struct IntegralFindings {
    /// Rule by rule.
    pub points: Vec<IntegralPoint>,
}

impl IntegralFindings {
    /// The rule of the statistical model.
    pub fn shipped(&self) -> Option<&IntegralPoint> {
        self.points.iter().find(|point| point.rule.family == Family::Shipped)
    }

    /// The nodes of the shipped rule in the loop of all others.
    pub fn shipped_nodes(&self) -> Option<&IntegralPoint> {
        let is_it =
            |rule: &Rule| rule.family == Family::Panels && rule.effort == Effort::Order(SHIPPED_ORDER);
        self.points.iter().find(|point| is_it(&point.rule))
    }
}

/// The rules compared: those that can integrate from the flat upwards.
fn rules() -> Vec<Rule> {
    let of = |family, [split, substituted]: [bool; 2], orders: &[usize]| {
        let rule = move |order: &usize| Rule { family, split, substituted, effort: Effort::Order(*order) };
        orders.iter().map(rule).collect::<Vec<_>>()
    };
    let mut all = Vec::new();
    for use_of in [[false, false], [false, true], [true, false], [true, true]] {
        all.extend(of(Family::Legendre, use_of, &ORDERS));
    }
    all.extend(of(Family::Panels, [true, true], &ORDERS[..11]));
    all.extend(of(Family::Jacobi, [true, false], &ORDERS[..11]));
    for family in [Family::ChebyshevFirst, Family::ChebyshevSecond] {
        all.extend(of(family, [true, true], &MANY));
    }
    all.extend(of(Family::Laguerre, [false, false], &MANY[..5]));
    all.extend(of(Family::Laguerre, [true, true], &MANY[..5]));
    all.extend(of(Family::Hermite, [false, false], &MANY));
    for family in [Family::Midpoint, Family::Trapezoid, Family::Simpson] {
        for use_of in [[false, false], [true, true]] {
            all.extend(of(family, use_of, &MANY));
        }
    }
    for [split, substituted] in [[false, false], [true, false], [true, true]] {
        let tolerances = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(Effort::Tolerance);
        all.extend(tolerances.map(|effort| Rule { family: Family::Kronrod, split, substituted, effort }));
    }
    all.push(Rule { family: Family::Shipped, split: true, substituted: true, effort: Effort::Fixed });
    all
}

/// A rule with its nodes.
struct Prepared {
    rule: Rule,
    /// Of the segment that begins at w = 0, and of any other.
    segments: [Vec<Node>; 2],
    /// Of all that follows the last breakpoint, in the variable t = rate x.
    tail: Option<Vec<Node>>,
    /// Of all heights.
    heights: Option<Vec<Node>>,
}

impl Prepared {
    fn new(rule: Rule) -> Self {
        let order = match rule.effort {
            Effort::Order(order) => NonZeroUsize::new(order),
            _ => None,
        };
        let family = rule.family;
        let segments = order.map(|order| rules::on_segments(family, order)).unwrap_or_default();
        let tail = order.filter(|_| family == Family::Laguerre).map(rules::laguerre);
        let heights = order.filter(|_| family == Family::Hermite).map(rules::hermite);
        Self { rule, segments, tail, heights }
    }
}

/// Area ratio and pressure, and how many contacts were evaluated.
type Answer = ([f64; 2], usize);

/// One micro-contact and one population.
struct Problem<'a> {
    contact: &'a dyn MicroContact,
    population: &'a Population,
    shape: Shape,
    /// In units of sigma, ascending.
    breakpoints: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(contact: &'a dyn MicroContact, population: &'a Population) -> Self {
        let shape = Shape::sphere(population.radius);
        let breakpoints = contact.breakpoints(shape).into_iter().map(|w| w / population.sigma).collect();
        Self { contact, population, shape, breakpoints }
    }

    /// Area and load at the indentation `x` in sigma.
    #[inline]
    fn values(&self, x: f64) -> [f64; 2] {
        let contact = self.contact.contact(x * self.population.sigma, self.shape);
        [contact.area, contact.load]
    }

    /// The ends of the segments: those of the window and, if it is split, the breakpoints between.
    fn ends(&self, h: f64, split: bool) -> impl Iterator<Item = f64> {
        let [start, end] = Gaussian.window(h);
        let between = self.breakpoints.iter().copied().filter(move |x| split && start < *x && *x < end);
        [start].into_iter().chain(between).chain([end])
    }

    /// Result of a rule with nodes at `h` = d/sigma.
    fn answer(&self, rule: &Prepared, h: f64) -> Answer {
        let (mut sums, mut count) = ([0.0; 2], 0);
        if let Some(nodes) = &rule.heights {
            // Relative to its scale, the density is exp(-exponent); the weights hold it.
            for node in nodes.iter().filter(|node| node.at > h) {
                add(&mut sums, node.weights, self.values(node.at - h));
                count += 1;
            }
            return (sums.map(|sum| sum * self.population.density), count);
        }
        let mut ends = self.ends(h, rule.rule.split).peekable();
        let mut from = ends.next().unwrap_or_default();
        while let Some(to) = ends.next() {
            if let Some(nodes) = rule.tail.as_ref().filter(|_| ends.peek().is_none()) {
                // Mean indentation of a Gaussian excess, nearly.
                let rate = 0.5 * (h + (h * h + std::f64::consts::TAU).sqrt());
                for node in nodes {
                    let x = from + node.at / rate;
                    let density = (node.exponent - Gaussian.exponent(h, x)).exp() / rate;
                    add(&mut sums, node.weights.map(|weight| weight * density), self.values(x));
                }
                count += nodes.len();
                continue;
            }
            let nodes = &rule.segments[usize::from(from > 0.0)];
            let panels = match rule.rule.family {
                Family::Panels => {
                    let foldings = FOLDINGS[usize::from(Gaussian.contains_peak(h, from, to))];
                    (Gaussian.e_foldings(h, from, to) / foldings).ceil().max(1.0) as usize
                }
                _ => 1,
            };
            let [low, high] = if rule.rule.substituted { [from.sqrt(), to.sqrt()] } else { [from, to] };
            let width = (high - low) / panels as f64;
            for panel in 0..panels {
                let begin = low + width * panel as f64;
                for node in nodes {
                    let s = begin + width * node.at;
                    let (x, stretch) =
                        if rule.rule.substituted { (s * s, 2.0 * s * width) } else { (s, width) };
                    // An end of a closed rule may lie on the flat.
                    if x > 0.0 {
                        let density = stretch * (-Gaussian.exponent(h, x)).exp();
                        add(&mut sums, node.weights.map(|weight| weight * density), self.values(x));
                    }
                }
                count += nodes.len();
            }
            from = to;
        }
        let scale = self.population.density * Gaussian.scale(h);
        (sums.map(|sum| sum * scale), count)
    }

    /// The same by quad-rs; `None` where it gives up.
    fn adaptive(&self, rule: &Rule, tolerance: f64, h: f64) -> Option<Answer> {
        /// Evaluations before it gives up.
        const MOST: usize = 100_000;
        let ends = self.ends(h, rule.split).map(|x| if rule.substituted { x.sqrt() } else { x }).collect();
        // Area and load are scaled to near 1; the tolerance applies to the norm of both.
        let unit = self.values(1.0);
        let problem = Above { problem: self, h, substituted: rule.substituted, unit };
        let config = IntegratorConfig::default()
            .with_relative_tolerance(tolerance)
            .with_absolute_tolerance(0.0)
            .with_minimum_segment_width(f64::MIN_POSITIVE)
            .with_max_function_evalutions(MOST)
            .with_tolerance_window(1);
        let found = integrate_real(problem, ends, config).ok()?;
        let scale = self.population.density * Gaussian.scale(h);
        Some(([found.integral.re * unit[0] * scale, found.integral.im * unit[1] * scale], found.evaluations))
    }
}

#[inline]
fn add(sums: &mut [f64; 2], weights: [f64; 2], values: [f64; 2]) {
    sums[0] += weights[0] * values[0];
    sums[1] += weights[1] * values[1];
}

/// Area and load above the flat, as the integrand of quad-rs.
struct Above<'a> {
    problem: &'a Problem<'a>,
    h: f64,
    substituted: bool,
    unit: [f64; 2],
}

impl Integrable for Above<'_> {
    type Float = f64;
    type Input = f64;
    type Output = Complex<f64>;

    fn integrand(&self, s: &f64) -> Complex<f64> {
        let (x, stretch) = if self.substituted { (s * s, 2.0 * s) } else { (*s, 1.0) };
        let density = stretch * (-Gaussian.exponent(self.h, x)).exp();
        let [area, load] = self.problem.values(x);
        Complex::new(density * area / self.unit[0], density * load / self.unit[1])
    }
}

/// Runs every rule on a Gaussian population at `separations` (d/sigma, at least one); `None` for other heights, and where the
/// reference does not settle.
/// `exact` is what `contact` should be.
pub fn rules_on(
    contact: &dyn MicroContact,
    exact: &Exact,
    population: &Population,
    separations: &[f64],
) -> Option<IntegralFindings> {
    if population.heights != Heights::GAUSSIAN {
        return None;
    }
    let reference = |&separation: &f64| {
        let integral = Integral::of(population, separation)?;
        let total = exact.integral(&integral, &exact::Shape::sphere(population.radius))?;
        Some([total.total_area(), total.total_load()])
    };
    let exact: Vec<[Wide; 2]> = separations.iter().map(reference).collect::<Option<_>>()?;
    let problem = Problem::new(contact, population);
    let shipped = Statistical::new(contact, population.clone());
    let rules: Vec<Prepared> = rules().into_iter().map(Prepared::new).collect();
    let answer = |rule: &Prepared, h: f64| match (rule.rule.family, rule.rule.effort) {
        (Family::Shipped, _) => {
            let response = shipped.respond(h);
            Some(([response.area_ratio.total(), response.pressure.total()], 0))
        }
        (_, Effort::Tolerance(tolerance)) => problem.adaptive(&rule.rule, tolerance, h),
        _ => Some(problem.answer(rule, h)),
    };
    // Rules with a result at every separation.
    let answered: Vec<(&Prepared, Vec<Answer>)> = rules
        .iter()
        .filter_map(|rule| Some((rule, separations.iter().map(|&h| answer(rule, h)).collect::<Option<_>>()?)))
        .collect();
    let mut candidates: Vec<Candidate> = answered
        .iter()
        .map(|(rule, _)| -> Candidate {
            Box::new(|| {
                for &h in separations {
                    black_box(answer(rule, black_box(h)));
                }
            })
        })
        .collect();
    let seconds = medians(&mut candidates);
    let points = answered.iter().zip(seconds).map(|((rule, answers), seconds)| {
        let error = |which: usize| {
            let pairs = answers.iter().zip(&exact);
            let errors = pairs.map(|((found, _), exact)| relative_error(found[which], exact[which]));
            errors.fold(0.0, f64::max)
        };
        let (area_error, load_error) = (error(0), error(1));
        let count: usize = answers.iter().map(|(_, count)| count).sum();
        let count = count as f64 / separations.len() as f64;
        let seconds = seconds / separations.len() as f64;
        IntegralPoint {
            rule: rule.rule,
            evaluations: (count > 0.0).then_some(count),
            area_error,
            load_error,
            cost: Cost { seconds, error: area_error.max(load_error) },
        }
    });
    Some(IntegralFindings { points: points.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::{LEVELS, fastest};
    use crate::stability::Bodies;
    use asperity::{Interface, Material, Zmc};

    fn findings() -> IntegralFindings {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let law = crate::stability::CoveredLaw::zmc();
        let exact = Exact::new(&Bodies { law, rough: steel, flat: steel, layer: None });
        rules_on(&contact, &exact, &case, &[-1.0, 0.0, 2.0]).unwrap()
    }

    #[test]
    fn rules_are_as_exact_as_they_should_be() {
        let found = findings();
        let error = |family, split, substituted, effort| {
            let rule = Rule { family, split, substituted, effort };
            found.points.iter().find(|point| point.rule == rule).unwrap().cost.error
        };
        let legendre =
            |split, substituted, order| error(Family::Legendre, split, substituted, Effort::Order(order));
        assert!(legendre(true, true, 8) > 100.0 * legendre(true, true, 24));
        assert!(legendre(true, true, 64) < 1e-13);
        assert!(legendre(false, true, 64) > 1e3 * legendre(true, true, 64));
        assert!(legendre(true, false, 64) > 1e2 * legendre(true, true, 64));
        assert!(error(Family::Panels, true, true, Effort::Order(24)) < 1e-13);
        assert!(error(Family::Jacobi, true, false, Effort::Order(64)) < 1e-12);
        assert!(error(Family::Laguerre, true, true, Effort::Order(64)) < 1e-6);
        assert!(error(Family::Hermite, false, false, Effort::Order(256)) < 0.05);
        assert!(error(Family::Simpson, true, true, Effort::Order(256)) < 1e-5);
        assert!(error(Family::Kronrod, true, true, Effort::Tolerance(1e-8)) < 1e-8);
        assert!(found.shipped().unwrap().cost.error < 1e-13);
        assert!(found.points.iter().all(|point| point.cost.error.is_finite() && point.cost.seconds > 0.0));
        let costs = || found.points.iter().map(|point| &point.cost);
        assert!(LEVELS.into_iter().all(|level| fastest(costs(), level).is_some()));
    }
}
