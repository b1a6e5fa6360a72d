//! Where the model is evaluated for a curve, until all that lies between can be predicted.

use std::f64::consts::PI;
use std::ops::Range;

use super::interpolation::{Interpolation, MOST_THROUGH, Node, Scale};
use super::quantities::{Quantities, Row};
use crate::model::Model;
use crate::numeric::lanes::run;

/// The places between two that were evaluated.
struct Interval([usize; 2]);

impl Interval {
    fn middle(&self) -> usize {
        (self.0[0] + self.0[1]) / 2
    }

    /// Whether a place lies between its ends.
    fn holds_a_place(&self) -> bool {
        self.0[1] - self.0[0] > 1
    }

    fn halves(&self) -> [Self; 2] {
        [Self([self.0[0], self.middle()]), Self([self.middle(), self.0[1]])]
    }
}

/// How much the asperities that come into contact between two separations keep a sum from being predicted.
///
/// With n of them at random over an interval of length l, sum(z - d) over those in contact, which the area follows,
/// differs from a smooth curve through both ends by some n^.5 l/7; it is the integral of the number of contacts.
pub struct DiscretisationBound {
    contacts: Vec<f64>,
    /// Of the contacts, from each separation to the last.
    integral: Vec<f64>,
}

impl DiscretisationBound {
    /// From the numbers of contacts at ascending separations.
    pub fn new(separations: &[f64], contacts: Vec<f64>) -> Self {
        let mut integral = vec![0.0; contacts.len()];
        for k in (1..contacts.len()).rev() {
            let step = separations[k] - separations[k - 1];
            integral[k - 1] = integral[k] + 0.5 * step * (contacts[k - 1] + contacts[k]);
        }
        Self { contacts, integral }
    }

    /// Whether they may be worth `tolerance` of the area in either half of an interval of `length`.
    fn matter(&self, &Interval([from, to]): &Interval, length: f64, tolerance: f64) -> bool {
        /// Deviations that count, of 1/7 each.
        const DEVIATIONS: f64 = 3.0 / 7.0;
        let halves = (0.5 * (self.contacts[from] - self.contacts[to])).sqrt() * (0.5 * length);
        let is_safe = DEVIATIONS * halves <= tolerance * self.integral[to];
        !is_safe
    }
}

/// Chooses the places at which a curve is evaluated.
pub struct AdaptiveSampler {
    /// All separations, ascending, in sigma.
    separations: Vec<f64>,
    /// Evaluated places, ascending.
    pub known: Vec<Node>,
    /// What limits the intervals of a sum.
    bound: Option<DiscretisationBound>,
}

impl AdaptiveSampler {
    /// A sampler that has evaluated no place yet.
    pub fn new(separations: Vec<f64>, bound: Option<DiscretisationBound>) -> Self {
        Self { separations, known: Vec::new(), bound }
    }

    fn ask(&self, model: &dyn Model, places: &[usize]) -> Vec<Node> {
        let separations: Vec<f64> = places.iter().map(|&place| self.separations[place]).collect();
        let answers = model.respond_all(&separations);
        places.iter().zip(answers).map(|(&place, response)| Node::new(place, response)).collect()
    }

    fn learn(&mut self, nodes: Vec<Node>) {
        self.known.extend(nodes);
        self.known.sort_unstable_by_key(|node| node.place);
    }

    /// Intervals, ascending, that are no longer than the bound allows.
    fn intervals(&self, tolerance: f64) -> Vec<Interval> {
        /// Below this an integral needs the more intervals in the end.
        const TIGHT: f64 = 1e-6;
        let coarsest = match self.bound {
            Some(_) => 8,
            None if tolerance < TIGHT => 12,
            None => 6,
        };
        let last = self.separations.len() - 1;
        // Half way between equal intervals and Chebyshev's, which are shorter where an interpolation has nodes to one side.
        let end = |k: usize| {
            let equal = k as f64 / coarsest as f64;
            let chebyshev = 0.5 * (1.0 - (PI * equal).cos());
            (0.5 * (equal + chebyshev) * last as f64).round() as usize
        };
        let mut rough: Vec<Interval> = (0..coarsest).rev().map(|k| Interval([end(k), end(k + 1)])).collect();
        let mut all = Vec::new();
        while let Some(interval) = rough.pop() {
            let Interval([from, to]) = interval;
            let length = self.separations[to] - self.separations[from];
            let matters = |bound: &DiscretisationBound| bound.matter(&interval, length, tolerance);
            if interval.holds_a_place() && self.bound.as_ref().is_some_and(matters) {
                let [below, above] = interval.halves();
                rough.extend([above, below]);
            } else {
                all.push(interval);
            }
        }
        all
    }

    /// Evaluates the model until every interval between two responses can be interpolated, or holds no place more.
    pub fn refine(&mut self, model: &dyn Model, tolerance: f64) {
        let mut open = self.intervals(tolerance);
        let mut ends: Vec<usize> = open.iter().map(|Interval([from, _])| *from).collect();
        ends.push(self.separations.len() - 1);
        open.retain(Interval::holds_a_place);
        // The places that the bound needs are evaluated at once: a sum visits all asperities each time.
        let middles = open.iter().map(Interval::middle);
        let mut nodes = self.ask(model, &ends.iter().copied().chain(middles).collect::<Vec<_>>());
        let mut found = nodes.split_off(ends.len());
        self.learn(nodes);
        while !open.is_empty() {
            let mut predicted = Vec::new();
            let gaps = open.iter().map(|interval| interval.middle()..interval.middle() + 1);
            self.interpolate(gaps, Scale::Logarithms, |_, row| predicted.push(row.quantities()));
            // The shares of a sum jump at each asperity that changes its regime.
            let is_within = |(found, predicted): (&Node, &Quantities)| {
                let found = found.row.quantities();
                let holds = |off: f64| off.abs() <= tolerance;
                let shares_hold = |found: [f64; 2], predicted: [f64; 2]| {
                    let [second, third] = [found[0] - predicted[0], found[1] - predicted[1]];
                    holds(second) && holds(third) && holds(second + third)
                };
                holds(found.pressure - predicted.pressure)
                    && holds(found.area_ratio - predicted.area_ratio)
                    && (self.bound.is_some()
                        || shares_hold(found.pressure_shares, predicted.pressure_shares)
                            && shares_hold(found.area_shares, predicted.area_shares))
            };
            let is_off: Vec<bool> = found.iter().zip(&predicted).map(|pair| !is_within(pair)).collect();
            self.learn(found);
            let off = open.iter().zip(is_off).filter(|(_, is_off)| *is_off);
            open = off.flat_map(|(interval, _)| interval.halves()).filter(Interval::holds_a_place).collect();
            found = self.ask(model, &open.iter().map(Interval::middle).collect::<Vec<_>>());
        }
    }

    /// Hands on each place of the ascending `gaps` between nodes with the quantities there, by the polynomial through the
    /// nearest nodes; no number where one of them is none.
    pub fn interpolate(
        &self,
        gaps: impl Iterator<Item = Range<usize>>,
        scale: Scale,
        take: impl FnMut(usize, &Row),
    ) {
        // A sum has a kink at every asperity: few nodes.
        let (through, places) = match self.bound {
            Some(_) => (4, Row::OF_A_SUM),
            None => (MOST_THROUGH, Row::OF_AN_INTEGRAL),
        };
        let through = through.min(self.known.len());
        let (known, separations) = (&*self.known, &*self.separations);
        run(Interpolation { known, through, places, separations, gaps, scale, take });
    }
}
