//! A curve of many separations from answers at few of them, to a tolerance that is checked.

use super::{Model, Response, SamplingError};
use crate::contact::ByRegime;
use crate::numeric::lanes::{Mask, Real, Work, run};

/// A curve within a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The answers, in the order of the separations that were asked for.
    pub responses: Vec<Response>,
    /// The separations at which the model itself answered.
    pub asked: Vec<f64>,
}

/// What is interpolated of a response: the logarithms of what spans decades, then shares. Both fill whole registers.
const QUANTITIES: usize = 2 * LOGARITHMS;

/// Pressure, area ratio, contacts, stiffness and sampling errors, and two places that are free.
const LOGARITHMS: usize = 8;

/// Places of the quantities that hold the tolerance: the logarithms of pressure and area ratio.
const TOTALS: std::ops::Range<usize> = 0..2;

/// Those of an integral that hold it besides: the shares of both. Those of a sum jump at each asperity that changes its
/// regime.
const SHARES: std::ops::Range<usize> = LOGARITHMS..LOGARITHMS + 6;

/// Below so many separations each is asked for.
const FEWEST: usize = 32;

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
    for node in &sketch.known {
        responses[order[node.place]] = Some(node.response);
    }
    let between: Vec<usize> = (0..order.len()).filter(|&place| responses[order[place]].is_none()).collect();
    let sigma = model.datum().sigma;
    sketch.interpolate(&between, Scale::Plain, |place, quantities| {
        let k = order[place];
        let density = counted.as_ref().map(|counted| counted.contacts[k] * counted.per_area);
        responses[k] = response(separations[k], sigma, quantities, density);
    });
    // Next to where nothing touches there is nothing to interpolate.
    let missing: Vec<usize> = (0..responses.len()).filter(|&k| responses[k].is_none()).collect();
    let missing_separations: Vec<f64> = missing.iter().map(|&k| separations[k]).collect();
    let answers = model.respond_all(&missing_separations);
    let mut asked: Vec<f64> = sketch.known.iter().map(|node| node.response.separation_over_sigma).collect();
    asked.extend(missing_separations);
    for (k, answer) in missing.into_iter().zip(answers) {
        responses[k] = Some(answer);
    }
    // None is missing now: they stay where they are.
    Curve { responses: responses.into_iter().collect::<Option<_>>().unwrap_or_default(), asked }
}

/// The response at `h`, in units of `sigma` (m), that has these quantities, with so many contacts an area if they were counted;
/// `None` where they are none.
fn response(
    h: f64,
    sigma: f64,
    quantities: &[f64; QUANTITIES],
    counted_density: Option<f64>,
) -> Option<Response> {
    let [pressure, area, contacts, stiffness, of_pressure, of_area, _, _, p1, p2, p3, a1, a2, a3, ..] =
        *quantities;
    let is_positive = |value: &f64| *value > 0.0 && *value < f64::INFINITY;
    if !(quantities[TOTALS].iter().all(is_positive)
        && quantities[SHARES].iter().all(|share| share.is_finite()))
    {
        return None;
    }
    let parts = |total: f64, shares: [f64; 3]| {
        let shares = shares.map(|share| share.max(0.0));
        let part = total / (shares[0] + shares[1] + shares[2]);
        ByRegime(shares.map(|share| share * part))
    };
    Some(Response {
        separation_over_sigma: h,
        separation: h * sigma,
        contact_density: counted_density.unwrap_or(contacts),
        area_ratio: parts(area, [a1, a2, a3]),
        pressure: parts(pressure, [p1, p2, p3]),
        stiffness,
        // Only a sum has its contacts counted.
        sampling: counted_density.map(|_| SamplingError { pressure: of_pressure, area_ratio: of_area }),
    })
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
        /// Shares below this are none: their differences would be denormal, which is slow.
        const NEGLIGIBLE: f64 = 1e-100;
        let shares = |parts: &ByRegime| {
            parts.shares().unwrap_or_default().map(|share| if share < NEGLIGIBLE { 0.0 } else { share })
        };
        let sampling = response.sampling.unwrap_or(SamplingError { pressure: 1.0, area_ratio: 1.0 });
        let [p1, p2, p3] = shares(&response.pressure);
        let [a1, a2, a3] = shares(&response.area_ratio);
        let ln = [
            response.pressure.total(),
            response.area_ratio.total(),
            response.contact_density,
            response.stiffness,
            sampling.pressure,
            sampling.area_ratio,
        ]
        .map(f64::ln);
        let mut quantities = [0.0; QUANTITIES];
        quantities[..ln.len()].copy_from_slice(&ln);
        quantities[SHARES].copy_from_slice(&[p1, p2, p3, a1, a2, a3]);
        Self { place, response, quantities }
    }
}

/// What lies between two places that were asked.
struct Interval([usize; 2]);

impl Interval {
    fn middle(&self) -> usize {
        (self.0[0] + self.0[1]) / 2
    }

    /// Whether one lies between its ends.
    fn holds_a_place(&self) -> bool {
        self.0[1] - self.0[0] > 1
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
    /// Intervals to begin with.
    coarsest: usize,
    /// Nodes that an interpolation goes through: few where the curve has a kink at every asperity.
    through: usize,
}

/// Nodes that any interpolation goes through at the most.
const MOST_THROUGH: usize = 12;

impl Sketch {
    fn new(separations: Vec<f64>, kinks: Option<Kinks>) -> Self {
        let (coarsest, through) = if kinks.is_some() { (8, 4) } else { (6, MOST_THROUGH) };
        Self { separations, known: Vec::new(), kinks, coarsest, through }
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

    /// Intervals, ascending, that are no longer than the kinks allow.
    fn intervals(&self, tolerance: f64) -> Vec<Interval> {
        let last = self.separations.len() - 1;
        let end = |k: usize| k * last / self.coarsest;
        let mut rough: Vec<Interval> =
            (0..self.coarsest).rev().map(|k| Interval([end(k), end(k + 1)])).collect();
        let mut all = Vec::new();
        while let Some(interval) = rough.pop() {
            let Interval([from, to]) = interval;
            let length = self.separations[to] - self.separations[from];
            let matters = |kinks: &Kinks| kinks.matter(&interval, length, tolerance);
            if interval.holds_a_place() && self.kinks.as_ref().is_some_and(matters) {
                let [below, above] = interval.halves();
                rough.extend([above, below]);
            } else {
                all.push(interval);
            }
        }
        all
    }

    /// Asks until every interval between two answers can be interpolated, or holds no place more.
    fn settle(&mut self, model: &dyn Model, tolerance: f64) {
        let mut open = self.intervals(tolerance);
        let mut ends: Vec<usize> = open.iter().map(|Interval([from, _])| *from).collect();
        ends.push(self.separations.len() - 1);
        open.retain(Interval::holds_a_place);
        // What the kinks ask for is asked at once: a sum looks at all asperities each time.
        let middles = open.iter().map(Interval::middle);
        let mut nodes = self.ask(model, &ends.iter().copied().chain(middles).collect::<Vec<_>>());
        let mut found = nodes.split_off(ends.len());
        self.learn(nodes);
        while !open.is_empty() {
            let middles: Vec<usize> = open.iter().map(Interval::middle).collect();
            let mut foretold = Vec::new();
            self.interpolate(&middles, Scale::Logarithms, |_, quantities| foretold.push(*quantities));
            let is_within = |(found, foretold): (&Node, &[f64; QUANTITIES])| {
                let holds = |k: usize| (found.quantities[k] - foretold[k]).abs() <= tolerance;
                TOTALS.into_iter().all(holds) && (self.kinks.is_some() || SHARES.into_iter().all(holds))
            };
            let is_off: Vec<bool> = found.iter().zip(&foretold).map(|pair| !is_within(pair)).collect();
            self.learn(found);
            let off = open.iter().zip(is_off).filter(|(_, is_off)| *is_off);
            open = off.flat_map(|(interval, _)| interval.halves()).filter(Interval::holds_a_place).collect();
            found = self.ask(model, &open.iter().map(Interval::middle).collect::<Vec<_>>());
        }
    }

    /// Hands on each of the ascending `places` with the quantities there, by the polynomial through the nearest nodes; no number
    /// where one of them is none.
    fn interpolate(&self, places: &[usize], scale: Scale, take: impl FnMut(usize, &[f64; QUANTITIES])) {
        run(Interpolation { sketch: self, places, scale, take });
    }
}

/// How logarithms are answered.
#[derive(Clone, Copy, PartialEq)]
enum Scale {
    /// As they are.
    Logarithms,
    /// As what they are the logarithms of.
    Plain,
}

/// Newton's polynomials through the nearest nodes (DLMF 3.3.38), of all quantities side by side.
struct Interpolation<'a, F> {
    sketch: &'a Sketch,
    places: &'a [usize],
    scale: Scale,
    take: F,
}

impl<F: FnMut(usize, &[f64; QUANTITIES])> Work for Interpolation<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        /// Places that are worked on together, so that no sum waits for another.
        const TOGETHER: usize = 32;
        let Self { sketch: Sketch { separations, known, through, .. }, places, scale, mut take } = self;
        let count = known.len().min(*through);
        let mut nodes = [0.0; MOST_THROUGH];
        let mut differences = [[0.0; QUANTITIES]; MOST_THROUGH];
        let mut found = [[0.0; QUANTITIES]; TOGETHER];
        let (mut after, mut begin) = (0, usize::MAX);
        let mut rest = places;
        while let [place, ..] = rest {
            while known.get(after).is_some_and(|node| node.place < *place) {
                after += 1;
            }
            let first = after.saturating_sub(through / 2).min(known.len() - count);
            if first != begin {
                begin = first;
                for (k, node) in known[first..first + count].iter().enumerate() {
                    (nodes[k], differences[k]) = (separations[node.place], node.quantities);
                }
                divide_differences(&nodes[..count], &mut differences[..count], zero);
            }
            // As far as the next node all go through the same ones.
            let end = known.get(after).map_or(usize::MAX, |node| node.place);
            let together = rest.iter().take(TOGETHER).take_while(|&&place| place < end).count().max(1);
            let (these, others) = rest.split_at(together);
            for (&place, quantities) in these.iter().zip(&mut found) {
                let h = separations[place];
                for k in (0..QUANTITIES).step_by(N::LANES) {
                    let mut value = zero;
                    for (node, difference) in nodes[..count].iter().zip(&differences[..count]).rev() {
                        value = value.times_plus(zero.splat(h - node), zero.load(&difference[k..]));
                    }
                    value.store(&mut quantities[k..]);
                }
            }
            if scale == Scale::Plain {
                for quantities in &mut found[..together] {
                    for k in (0..LOGARITHMS).step_by(N::LANES) {
                        exponential(zero.load(&quantities[k..])).store(&mut quantities[k..]);
                    }
                }
            }
            these.iter().zip(&found).for_each(|(&place, quantities)| take(place, quantities));
            rest = others;
        }
    }
}

/// Makes the values at `nodes` the divided differences of a polynomial through them.
#[inline(always)]
fn divide_differences<N: Real>(nodes: &[f64], values: &mut [[f64; QUANTITIES]], zero: N) {
    for order in 1..nodes.len() {
        for j in (order..nodes.len()).rev() {
            let per_length = (nodes[j] - nodes[j - order]).recip();
            for k in (0..QUANTITIES).step_by(N::LANES) {
                let difference = zero.load(&values[j][k..]) - zero.load(&values[j - 1][k..]);
                (difference * per_length).store(&mut values[j][k..]);
            }
        }
    }
}

/// e to the power of any number.
#[inline(always)]
fn exponential<N: Real>(x: N) -> N {
    /// That of lanes is good up to here.
    const LARGEST: f64 = 700.0;
    let largest = x.splat(LARGEST);
    if (x.at_most(largest) & (-largest).at_most(x)).all() {
        return x.exp();
    }
    let [powers] = x.each(|x| [x.exp()]);
    powers
}
