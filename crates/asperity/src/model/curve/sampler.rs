//! Adaptive choice of the separations at which the model is evaluated for a curve.

use std::f64::consts::PI;
use std::ops::Range;

use super::interpolation::{Interpolation, MOST_THROUGH, Node, Scale};
use super::quantities::{Quantities, Row};
use crate::model::Model;
use crate::numeric::lanes::run;

/// The places between two evaluated ones.
struct Interval([usize; 2]);

impl Interval {
    fn middle(&self) -> usize {
        (self.0[0] + self.0[1]) / 2
    }

    /// Whether there is a place strictly between the ends.
    fn has_interior(&self) -> bool {
        self.0[1] - self.0[0] > 1
    }

    fn halves(&self) -> [Self; 2] {
        [Self([self.0[0], self.middle()]), Self([self.middle(), self.0[1]])]
    }
}

/// A bound on the interpolation error of a sum due to its discrete asperities.
///
/// The area follows sum(z - d) over the asperities in contact, which is the integral of the number of contacts. For n
/// random asperities in an interval of length l it differs from a smooth curve through both ends by about n^.5 l/7.
pub struct DiscretisationBound {
    contacts: Vec<f64>,
    /// Integral of the number of contacts from each separation to the last.
    integral: Vec<f64>,
}

impl DiscretisationBound {
    /// A bound from the numbers of contacts at ascending separations.
    pub fn new(separations: &[f64], contacts: Vec<f64>) -> Self {
        let mut integral = vec![0.0; contacts.len()];
        for k in (1..contacts.len()).rev() {
            let step = separations[k] - separations[k - 1];
            integral[k - 1] = integral[k] + 0.5 * step * (contacts[k - 1] + contacts[k]);
        }
        Self { contacts, integral }
    }

    /// Whether the deviation may exceed `tolerance` times the area in either half of an interval of `length`.
    fn exceeds(&self, &Interval([from, to]): &Interval, length: f64, tolerance: f64) -> bool {
        /// Three standard deviations of 1/7 each.
        const DEVIATIONS: f64 = 3.0 / 7.0;
        let halves = (0.5 * (self.contacts[from] - self.contacts[to])).sqrt() * (0.5 * length);
        let is_safe = DEVIATIONS * halves <= tolerance * self.integral[to];
        !is_safe
    }
}

/// Chooses the separations at which the model is evaluated.
pub struct AdaptiveSampler {
    /// All separations, ascending, in sigma.
    separations: Vec<f64>,
    /// Evaluated places, ascending.
    pub known: Vec<Node>,
    /// Limits the intervals of a sum.
    bound: Option<DiscretisationBound>,
}

impl AdaptiveSampler {
    /// A sampler without evaluated places.
    pub fn new(separations: Vec<f64>, bound: Option<DiscretisationBound>) -> Self {
        Self { separations, known: Vec::new(), bound }
    }

    fn evaluate(&self, model: &dyn Model, places: &[usize]) -> Vec<Node> {
        let separations: Vec<f64> = places.iter().map(|&place| self.separations[place]).collect();
        let responses = model.respond_all(&separations);
        places.iter().zip(responses).map(|(&place, response)| Node::new(place, response)).collect()
    }

    fn insert(&mut self, nodes: Vec<Node>) {
        self.known.extend(nodes);
        self.known.sort_unstable_by_key(|node| node.place);
    }

    /// Intervals, ascending, that are no longer than the bound allows.
    fn intervals(&self, tolerance: f64) -> Vec<Interval> {
        /// Below this tolerance an integral starts with more intervals.
        const TIGHT: f64 = 1e-6;
        let coarsest = match self.bound {
            Some(_) => 8,
            None if tolerance < TIGHT => 12,
            None => 6,
        };
        let last = self.separations.len() - 1;
        // The mean of equal intervals and Chebyshev's, which are shorter towards the ends.
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
            let matters = |bound: &DiscretisationBound| bound.exceeds(&interval, length, tolerance);
            if interval.has_interior() && self.bound.as_ref().is_some_and(matters) {
                let [below, above] = interval.halves();
                rough.extend([above, below]);
            } else {
                all.push(interval);
            }
        }
        all
    }

    /// Evaluates the model until each interval can be interpolated or has no interior place.
    pub fn refine(&mut self, model: &dyn Model, tolerance: f64) {
        let mut open = self.intervals(tolerance);
        let mut ends: Vec<usize> = open.iter().map(|Interval([from, _])| *from).collect();
        ends.push(self.separations.len() - 1);
        open.retain(Interval::has_interior);
        // The places that the bound requires are evaluated together, since each evaluation of a sum visits all
        // asperities.
        let middles = open.iter().map(Interval::middle);
        let mut nodes = self.evaluate(model, &ends.iter().copied().chain(middles).collect::<Vec<_>>());
        let mut found = nodes.split_off(ends.len());
        self.insert(nodes);
        while !open.is_empty() {
            let mut predicted = Vec::new();
            let gaps = open.iter().map(|interval| interval.middle()..interval.middle() + 1);
            self.interpolate(gaps, Scale::Logarithms, |_, row| predicted.push(row.quantities()));
            // The shares of a sum jump when an asperity changes its regime.
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
            self.insert(found);
            let off = open.iter().zip(is_off).filter(|(_, is_off)| *is_off);
            open = off.flat_map(|(interval, _)| interval.halves()).filter(Interval::has_interior).collect();
            found = self.evaluate(model, &open.iter().map(Interval::middle).collect::<Vec<_>>());
        }
    }

    /// Calls `take` with each place of the ascending `gaps` between nodes and the quantities interpolated there; NaN if
    /// one of the nearest nodes is NaN.
    pub fn interpolate(
        &self,
        gaps: impl Iterator<Item = Range<usize>>,
        scale: Scale,
        take: impl FnMut(usize, &Row),
    ) {
        // A sum has a discontinuous slope at every asperity: low order.
        let (through, places) = match self.bound {
            Some(_) => (4, Row::OF_A_SUM),
            None => (MOST_THROUGH, Row::OF_AN_INTEGRAL),
        };
        let through = through.min(self.known.len());
        let (known, separations) = (&*self.known, &*self.separations);
        run(Interpolation { known, through, places, separations, gaps, scale, take });
    }
}
