//! Which way is the fastest that is good enough, and how far the shipped one is off.

use crate::kind::precision::run::CasePrecision;
use crate::precision::integral::Family;
use crate::precision::integral::{Effort, Rule};
use crate::precision::sum::{SumPoint, Sweep, Way};
use crate::precision::{Cost, LEVELS, fastest};
use asperity_framework::report::format::number;

/// 4 units in the last place: what sums are held to.
pub const FOUR_ULP: f64 = 4.0 * f64::EPSILON;

/// What is added up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// One contact over the heights.
    Integral,
    /// Asperities.
    Sum,
}

impl Of {
    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Integral => "integral",
            Self::Sum => "sum",
        }
    }
}

/// The fastest way within one error.
pub struct Winner<'a> {
    /// The population.
    pub case: &'a str,
    /// What is added up.
    pub of: Of,
    /// Of a sum, in the set.
    pub asperities: Option<usize>,
    /// The largest error that is allowed.
    pub level: f64,
    /// Its name and its cost; `None` where no way is good enough.
    pub fastest: Option<(String, Cost)>,
    /// Seconds of the shipped way over those of the fastest; `None` where the shipped one is not good enough.
    pub shipped_over_fastest: Option<f64>,
}

impl Winner<'_> {
    /// Whether the shipped way is the fastest.
    pub fn is_shipped(&self) -> bool {
        self.shipped_over_fastest == Some(1.0)
    }
}

/// A rule with its effort, in words.
pub fn rule_words(rule: &Rule) -> String {
    let family = match (rule.family, rule.split) {
        (Family::Laguerre, true) => "gauss-laguerre behind gauss-legendre",
        (family, _) => family.name(),
    };
    let effort = match rule.effort {
        Effort::Order(order) => format!(", order {order}"),
        Effort::Tolerance(tolerance) => format!(", tolerance {}", number(tolerance)),
        Effort::Fixed => String::new(),
    };
    let used = match (rule.family, rule.split, rule.substituted) {
        (Family::Shipped | Family::Panels | Family::Jacobi | Family::Laguerre | Family::Hermite, ..) => "",
        (_, true, true) => ", split and substituted",
        (_, true, false) => ", split",
        (_, false, true) => ", substituted",
        (_, false, false) => ", as it is",
    };
    format!("{family}{used}{effort}")
}

/// The sums of the largest set on one thread.
pub fn largest_sums(case: &CasePrecision) -> Vec<&SumPoint> {
    let of_sweep = || case.sums.iter().filter(|point| point.sweep == Sweep::Asperities);
    let largest = of_sweep().map(|point| point.asperities).max();
    of_sweep().filter(|point| Some(point.asperities) == largest).collect()
}

/// Level by level, of the integral and of the sum of the largest set.
pub fn winners(case: &CasePrecision) -> Vec<Winner<'_>> {
    let mut all = Vec::new();
    if let Some(integral) = &case.integral {
        let ways: Vec<(String, Cost, bool)> = integral
            .points
            .iter()
            .map(|point| (rule_words(&point.rule), point.cost, point.rule.family == Family::Shipped))
            .collect();
        all.extend(LEVELS.map(|level| winner(&case.name, Of::Integral, None, level, &ways)));
    }
    let sums = largest_sums(case);
    if let Some(first) = sums.first() {
        let ways: Vec<(String, Cost, bool)> = sums
            .iter()
            .map(|point| (point.way.name().to_owned(), point.cost, point.way == Way::SHIPPED))
            .collect();
        let levels = LEVELS.into_iter().chain([FOUR_ULP]);
        all.extend(levels.map(|level| winner(&case.name, Of::Sum, Some(first.asperities), level, &ways)));
    }
    all
}

fn winner<'a>(
    case: &'a str,
    of: Of,
    asperities: Option<usize>,
    level: f64,
    ways: &[(String, Cost, bool)],
) -> Winner<'a> {
    let best = fastest(ways.iter().map(|(_, cost, _)| cost), level).map(|place| &ways[place]);
    let shipped = ways.iter().find(|(_, cost, is_shipped)| *is_shipped && cost.error <= level);
    Winner {
        case,
        of,
        asperities,
        level,
        fastest: best.map(|(name, cost, _)| (name.clone(), *cost)),
        shipped_over_fastest: shipped.zip(best).map(|(shipped, best)| shipped.1.seconds / best.1.seconds),
    }
}
