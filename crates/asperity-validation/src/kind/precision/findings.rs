//! Findings on one population: the fastest method at each error, the effect of ordering and of threads.

use crate::precision::integral::{Family, IntegralFindings, Rule};
use crate::precision::sum::{Adding, SumPoint, Sweep, Way};
use crate::precision::{Cost, LEVELS, fastest};

/// 4 units in the last place: the bound of sums.
pub const FOUR_ULP: f64 = 4.0 * f64::EPSILON;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// One contact over the heights.
    Integral,
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

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Candidate {
    /// A rule of quadrature.
    Rule(Rule),
    Way(Way),
}

/// The fastest method within one error.
#[derive(Debug, Clone)]
pub struct Winner {
    pub of: Of,
    /// Of a sum, in the set.
    pub asperities: Option<usize>,
    /// The largest permitted error.
    pub level: f64,
    /// The method and its cost; `None` where none is accurate enough.
    pub fastest: Option<(Candidate, Cost)>,
    /// Time of the shipped method over that of the fastest; `None` where the shipped one is not accurate enough.
    pub shipped_over_fastest: Option<f64>,
}

impl Winner {
    /// Whether the shipped method is the fastest.
    pub fn is_shipped(&self) -> bool {
        self.shipped_over_fastest == Some(1.0)
    }
}

/// Effect of ordering the asperities by height first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ordering {
    /// Asperities in the set.
    pub asperities: usize,
    /// The fewest separations by which it is paid back, of those that were tried; `None` where it is by none.
    pub paid_back_by: Option<usize>,
}

/// What more threads do to the shipped sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speedup {
    /// Asperities in the set.
    pub asperities: usize,
    pub from: usize,
    pub to: usize,
    /// Time on the most over time on the fewest.
    pub time: f64,
}

/// Findings on one population.
#[derive(Debug, Clone)]
pub struct CaseFindings {
    /// Level by level, of the integral and of the sum of the largest set.
    pub winners: Vec<Winner>,
    /// What ordering does, where the number of separations was varied.
    pub ordering: Option<Ordering>,
    /// What more threads do, where their number was varied.
    pub speedup: Option<Speedup>,
}

impl CaseFindings {
    /// Of the rules and sums of one population.
    pub fn of(integral: Option<&IntegralFindings>, sums: &[SumPoint]) -> Self {
        Self { winners: winners(integral, sums), ordering: ordering(sums), speedup: speedup(sums) }
    }
}

/// The sums of the largest set on one thread.
pub fn largest_sums(sums: &[SumPoint]) -> Vec<&SumPoint> {
    let of_sweep = || sums.iter().filter(|point| point.sweep == Sweep::Asperities);
    let largest = of_sweep().map(|point| point.asperities).max();
    of_sweep().filter(|point| Some(point.asperities) == largest).collect()
}

fn winners(integral: Option<&IntegralFindings>, sums: &[SumPoint]) -> Vec<Winner> {
    let mut all = Vec::new();
    if let Some(integral) = integral {
        let rules = integral.points.iter();
        let ways: Vec<(Candidate, Cost, bool)> = rules
            .map(|point| (Candidate::Rule(point.rule), point.cost, point.rule.family == Family::Shipped))
            .collect();
        all.extend(LEVELS.map(|level| winner(Of::Integral, None, level, &ways)));
    }
    let sums = largest_sums(sums);
    if let Some(first) = sums.first() {
        let ways: Vec<(Candidate, Cost, bool)> = sums
            .iter()
            .map(|point| (Candidate::Way(point.way), point.cost, point.way == Way::SHIPPED))
            .collect();
        let levels = LEVELS.into_iter().chain([FOUR_ULP]);
        all.extend(levels.map(|level| winner(Of::Sum, Some(first.asperities), level, &ways)));
    }
    all
}

fn winner(of: Of, asperities: Option<usize>, level: f64, ways: &[(Candidate, Cost, bool)]) -> Winner {
    let best = fastest(ways.iter().map(|(_, cost, _)| cost), level).map(|place| &ways[place]);
    let shipped = ways.iter().find(|(_, cost, is_shipped)| *is_shipped && cost.error <= level);
    Winner {
        of,
        asperities,
        level,
        fastest: best.map(|&(candidate, cost, _)| (candidate, cost)),
        shipped_over_fastest: shipped.zip(best).map(|(shipped, best)| shipped.1.seconds / best.1.seconds),
    }
}

/// With compensated sums, from the times by the number of separations.
fn ordering(sums: &[SumPoint]) -> Option<Ordering> {
    let of = |ordered: bool| {
        let way = Way { adding: Adding::Compensated, ordered };
        let is_it = move |point: &&SumPoint| point.sweep == Sweep::Separations && point.way == way;
        sums.iter().filter(is_it)
    };
    let asperities = of(true).next()?.asperities;
    let pays = of(true).zip(of(false)).find(|(with, without)| with.cost.seconds < without.cost.seconds);
    Some(Ordering { asperities, paid_back_by: pays.map(|(point, _)| point.separations) })
}

fn speedup(sums: &[SumPoint]) -> Option<Speedup> {
    let shipped = || sums.iter().filter(|point| point.sweep == Sweep::Threads && point.way == Way::SHIPPED);
    let least = shipped().min_by_key(|point| point.threads)?;
    let most = shipped().max_by_key(|point| point.threads).filter(|most| most.threads > least.threads)?;
    Some(Speedup {
        asperities: most.asperities,
        from: least.threads,
        to: most.threads,
        time: most.cost.seconds / least.cost.seconds,
    })
}
