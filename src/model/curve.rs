//! A curve of many separations from answers at few of them, to a tolerance that is checked.

use super::{Model, Response, SamplingError};
use crate::contact::ByRegime;

/// A curve within a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The answers, in the order of the separations that were asked for.
    pub responses: Vec<Response>,
    /// The separations at which the model itself answered.
    pub asked: Vec<f64>,
}

/// What is interpolated of a response: the logarithms of what spans decades, and shares.
const QUANTITIES: usize = 12;

/// The first so many hold the tolerance: pressure and area ratio; of an integral the shares of both too. Those of a sum jump
/// at each asperity that changes its regime.
const HELD: [usize; 2] = [2, 8];

/// Below so many separations each is asked for.
const FEWEST: usize = 32;

/// Intervals to begin with.
const INTERVALS: usize = 8;

/// The answers at `separations` (in sigma), of which pressure and area ratio, of an integral also the shares of their regimes
/// (in parts of the whole), are within `tolerance` of the model's own.
///
/// The model is asked at some of the separations, the rest is interpolated: an interval between two answers is asked
/// in its middle and halved, until the answer there is what its neighbours foretold, and of a sum until the asperities
/// between two answers are too few to matter (`Kinks`). What cannot be foretold is asked everywhere. The number of contacts of a sum is counted, not interpolated.
pub fn respond_within(model: &dyn Model, separations: &[f64], tolerance: f64) -> Curve {
    if separations.len() < FEWEST {
        return Curve { responses: model.respond_all(separations), asked: separations.to_vec() };
    }
    let mut order: Vec<usize> = (0..separations.len()).collect();
    order.sort_by(|&a, &b| separations[a].total_cmp(&separations[b]));
    let counted = model.count_contacts(separations);
    let ascending: Vec<f64> = order.iter().map(|&k| separations[k]).collect();
    let kinks = counted
        .as_ref()
        .map(|counted| Kinks::new(&ascending, order.iter().map(|&k| counted.contacts[k]).collect()));
    let mut sketch = Sketch::new(ascending, kinks);
    sketch.settle(model, tolerance);
    let mut responses = vec![None; separations.len()];
    for (place, &k) in order.iter().enumerate() {
        responses[k] =
            sketch.at(model, place, counted.as_ref().map(|counted| counted.contacts[k] * counted.per_area));
    }
    // Next to where nothing touches there is nothing to interpolate.
    let missing: Vec<usize> = (0..responses.len()).filter(|&k| responses[k].is_none()).collect();
    let missing_separations: Vec<f64> = missing.iter().map(|&k| separations[k]).collect();
    let answers = model.respond_all(&missing_separations);
    let mut asked: Vec<f64> = sketch.known.iter().map(|node| node.response.separation_over_sigma).collect();
    asked.extend(missing_separations);
    for (k, answer) in missing.into_iter().zip(answers) {
        responses[k] = Some(answer);
    }
    Curve { responses: responses.into_iter().flatten().collect(), asked }
}

/// Where the model was asked: place and answer, and what is interpolated of it.
#[derive(Debug, Clone, Copy)]
struct Node {
    place: usize,
    response: Response,
    quantities: [f64; QUANTITIES],
}

impl Node {
    fn new(place: usize, response: Response) -> Self {
        let shares = |parts: &ByRegime| parts.shares().unwrap_or_default();
        let sampling = response.sampling.unwrap_or(SamplingError { pressure: 1.0, area_ratio: 1.0 });
        let [p1, p2, p3] = shares(&response.pressure);
        let [a1, a2, a3] = shares(&response.area_ratio);
        let quantities = [
            response.pressure.total().ln(),
            response.area_ratio.total().ln(),
            p1,
            p2,
            p3,
            a1,
            a2,
            a3,
            response.contact_density.ln(),
            response.stiffness.ln(),
            sampling.pressure.ln(),
            sampling.area_ratio.ln(),
        ];
        Self { place, response, quantities }
    }
}

/// What lies between two places that were asked.
struct Interval([usize; 2]);

impl Interval {
    fn middle(&self) -> usize {
        (self.0[0] + self.0[1]) / 2
    }

    fn halves(&self) -> [Self; 2] {
        [Self([self.0[0], self.middle()]), Self([self.middle(), self.0[1]])]
    }
}

/// How much the asperities that come into contact between two separations keep a sum from being foretold.
///
/// With n of them at random over an interval of length l, sum(z - d) over those in contact, which the area follows,
/// differs from a smooth curve through both ends by some n^.5 l/7; it is the integral of the number of contacts.
struct Kinks {
    contacts: Vec<f64>,
    /// Of the contacts, from each separation to the last.
    integral: Vec<f64>,
}

impl Kinks {
    /// Of ascending separations.
    fn new(separations: &[f64], contacts: Vec<f64>) -> Self {
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

/// What is known of a curve.
struct Sketch {
    /// Ascending.
    separations: Vec<f64>,
    /// Ascending.
    known: Vec<Node>,
    /// Of a sum.
    kinks: Option<Kinks>,
    /// Nodes that an interpolation goes through: few where the curve has a kink at every asperity.
    through: usize,
    /// How many quantities hold the tolerance.
    held: usize,
}

impl Sketch {
    fn new(separations: Vec<f64>, kinks: Option<Kinks>) -> Self {
        let (through, held) = if kinks.is_some() { (4, HELD[0]) } else { (10, HELD[1]) };
        Self { separations, known: Vec::new(), kinks, through, held }
    }

    /// Asks the model at `places`, ascending and new.
    fn ask(&mut self, model: &dyn Model, places: &[usize]) {
        let separations: Vec<f64> = places.iter().map(|&place| self.separations[place]).collect();
        let answers = model.respond_all(&separations);
        self.known.extend(places.iter().zip(answers).map(|(&place, response)| Node::new(place, response)));
        self.known.sort_unstable_by_key(|node| node.place);
    }

    /// Asks until every interval between two answers can be interpolated, or holds no place more.
    fn settle(&mut self, model: &dyn Model, tolerance: f64) {
        let last = self.separations.len() - 1;
        let ends: Vec<usize> = (0..=INTERVALS).map(|k| k * last / INTERVALS).collect();
        self.ask(model, &ends);
        let mut open: Vec<Interval> = ends.windows(2).map(|ends| Interval([ends[0], ends[1]])).collect();
        while !open.is_empty() {
            open.retain(|Interval([from, to])| to - from > 1);
            let middles: Vec<usize> = open.iter().map(Interval::middle).collect();
            let foretold: Vec<[f64; QUANTITIES]> =
                middles.iter().map(|&place| self.interpolate(place)).collect();
            self.ask(model, &middles);
            let is_off = |place: usize, foretold: &[f64; QUANTITIES]| {
                let Ok(k) = self.known.binary_search_by_key(&place, |node| node.place) else { return true };
                let found = self.known[k].quantities;
                !(0..self.held).all(|k| (found[k] - foretold[k]).abs() <= tolerance)
            };
            let mut next = Vec::new();
            for (interval, foretold) in open.iter().zip(&foretold) {
                let Interval([from, to]) = *interval;
                let length = self.separations[to] - self.separations[from];
                let is_rough =
                    self.kinks.as_ref().is_some_and(|kinks| kinks.matter(interval, length, tolerance));
                if is_rough || is_off(interval.middle(), foretold) {
                    next.extend(interval.halves());
                }
            }
            open = next;
        }
    }

    /// The quantities at a place, by the polynomial through the nearest nodes; no number where one of them is none.
    fn interpolate(&self, place: usize) -> [f64; QUANTITIES] {
        let after = self.known.partition_point(|node| node.place < place);
        let first = after.saturating_sub(self.through / 2).min(self.known.len().saturating_sub(self.through));
        let nodes = &self.known[first..self.known.len().min(first + self.through)];
        let h = self.separations[place];
        let mut quantities = [0.0; QUANTITIES];
        for node in nodes {
            let at = self.separations[node.place];
            let others = nodes.iter().filter(|other| other.place != node.place);
            let weight: f64 = others
                .map(|other| self.separations[other.place])
                .map(|other| (h - other) / (at - other))
                .product();
            for (quantity, value) in quantities.iter_mut().zip(node.quantities) {
                *quantity += weight * value;
            }
        }
        quantities
    }

    /// The answer at a place, with so many contacts an area if they were counted; `None` where it cannot be interpolated.
    fn at(&self, model: &dyn Model, place: usize, density: Option<f64>) -> Option<Response> {
        if let Ok(k) = self.known.binary_search_by_key(&place, |node| node.place) {
            return Some(self.known[k].response);
        }
        let is_sum = self.known.first()?.response.sampling.is_some();
        let quantities = self.interpolate(place);
        // One asperity has no sampling error, and ln 0 none either.
        if !quantities[..HELD[1]].iter().all(|quantity| quantity.is_finite()) {
            return None;
        }
        let [pressure, area, p1, p2, p3, a1, a2, a3, contacts, stiffness, of_pressure, of_area] = quantities;
        let parts = |total: f64, shares: [f64; 3]| {
            let shares = shares.map(|share| share.max(0.0));
            let all: f64 = shares.iter().sum();
            ByRegime(shares.map(|share| total.exp() * share / all))
        };
        let h = self.separations[place];
        Some(Response {
            separation_over_sigma: h,
            separation: h * model.datum().sigma,
            contact_density: density.unwrap_or(contacts.exp()),
            area_ratio: parts(area, [a1, a2, a3]),
            pressure: parts(pressure, [p1, p2, p3]),
            stiffness: stiffness.exp(),
            sampling: is_sum
                .then(|| SamplingError { pressure: of_pressure.exp(), area_ratio: of_area.exp() }),
        })
    }
}
