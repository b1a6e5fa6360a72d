//! What many micro-contacts add up to.

use crate::contact::{ByRegime, Contact, Contacts, Regime};
use crate::numeric::lanes::{Mask, Real};
use crate::numeric::sum::{LaneSum, Sum, Sums};

/// What many micro-contacts add up to, by regime. Totals of parts merge into the total of the whole; the order of merging
/// is the caller's to fix.
#[derive(Debug, Clone, Copy, Default)]
pub struct Total {
    contacts: Sum,
    area: [Sum; 3],
    load: [Sum; 3],
    stiffness: Sum,
    area_squared: Sum,
    load_squared: Sum,
}

impl Total {
    /// Adds the total of another part.
    pub fn merge(&mut self, other: &Self) {
        self.contacts.merge(&other.contacts);
        for regime in 0..3 {
            self.area[regime].merge(&other.area[regime]);
            self.load[regime].merge(&other.load[regime]);
        }
        self.stiffness.merge(&other.stiffness);
        self.area_squared.merge(&other.area_squared);
        self.load_squared.merge(&other.load_squared);
    }

    /// Number of contacts.
    pub fn contacts(&self) -> f64 {
        self.contacts.value()
    }

    /// Area by regime, m^2.
    pub fn area(&self) -> ByRegime {
        ByRegime(self.area.map(|sum| sum.value()))
    }

    /// Load by regime, N.
    pub fn load(&self) -> ByRegime {
        ByRegime(self.load.map(|sum| sum.value()))
    }

    /// Sum of dP/dw, N/m.
    pub fn stiffness(&self) -> f64 {
        self.stiffness.value()
    }

    /// Standard error of the total area, m^2, `count` asperities (in contact or not) taken as
    /// independent draws: sqrt(sum a_i^2 - (sum a_i)^2/n).
    pub fn area_error(&self, count: usize) -> f64 {
        sampling_error(self.area_squared.value(), self.area().total(), count)
    }

    /// Standard error of the total load, N; see [`Total::area_error`].
    pub fn load_error(&self, count: usize) -> f64 {
        sampling_error(self.load_squared.value(), self.load().total(), count)
    }
}

/// Equal terms leave a difference of pure rounding, possibly below zero: that is no scatter.
fn sampling_error(squares: f64, total: f64, count: usize) -> f64 {
    let scatter = squares - total * total / count as f64;
    if scatter > 16.0 * f64::EPSILON * squares { scatter.sqrt() } else { 0.0 }
}

/// A total in the making: every sum in as many parts as a machine has lanes.
#[derive(Debug, Clone, Copy, Default)]
pub struct Accumulator {
    contacts: LaneSum,
    area: [LaneSum; 3],
    load: [LaneSum; 3],
    stiffness: LaneSum,
    area_squared: LaneSum,
    load_squared: LaneSum,
}

impl Accumulator {
    /// Adds `weight` contacts of one kind (a quadrature weight, in the statistical model).
    #[inline]
    pub fn accumulate_weighted(&mut self, contact: &Contact, weight: f64) {
        let regime = contact.regime as usize;
        self.contacts.add(weight);
        self.area[regime].add(weight * contact.area);
        self.load[regime].add(weight * contact.load);
        self.stiffness.add(weight * contact.stiffness);
    }

    /// Adds one real contact, squares included: they give the sampling error.
    #[inline]
    pub fn add(&mut self, contact: &Contact) {
        self.accumulate_weighted(contact, 1.0);
        self.area_squared.add(contact.area * contact.area);
        self.load_squared.add(contact.load * contact.load);
    }

    /// Adds a load that appears at once, where a law jumps, to the stiffness.
    pub fn add_jump(&mut self, stiffness: f64) {
        self.stiffness.add(stiffness);
    }

    /// Adds what was accumulated side by side.
    #[inline(always)]
    pub fn add_lanes<N: Real>(&mut self, lanes: &LaneBatch<N>) {
        self.contacts.add(lanes.count as f64);
        self.contacts.add_lanes(&lanes.weights);
        for (regime, _) in lanes.holds.iter().enumerate().filter(|(_, holds)| **holds) {
            self.area[regime].add_lanes(&lanes.area[regime]);
            self.load[regime].add_lanes(&lanes.load[regime]);
        }
        self.stiffness.add_lanes(&lanes.stiffness);
        self.area_squared.add_lanes(&lanes.area_squared);
        self.load_squared.add_lanes(&lanes.load_squared);
    }

    /// What it adds up to.
    pub fn total(&self) -> Total {
        Total {
            contacts: self.contacts.total(),
            area: self.area.map(|sum| sum.total()),
            load: self.load.map(|sum| sum.total()),
            stiffness: self.stiffness.total(),
            area_squared: self.area_squared.total(),
            load_squared: self.load_squared.total(),
        }
    }
}

/// A accumulator of contacts side by side.
pub struct LaneBatch<N> {
    zero: N,
    /// How many real contacts.
    count: usize,
    /// Weights of others.
    weights: Sums<N>,
    /// Regimes of which there was a contact.
    holds: [bool; 3],
    area: [Sums<N>; 3],
    load: [Sums<N>; 3],
    stiffness: Sums<N>,
    area_squared: Sums<N>,
    load_squared: Sums<N>,
}

/// Few contacts, added plainly: a sum of [`FEW`] positive terms is off by 15 roundings at the most.
pub struct LaneAccumulator<N> {
    zero: N,
    count: usize,
    holds: [bool; 3],
    area: [N; 3],
    load: [N; 3],
    stiffness: N,
    area_squared: N,
    load_squared: N,
}

/// How many contacts a lane adds before what its sum loses to rounding is kept.
pub const FEW: usize = 16;

impl<N: Real> LaneBatch<N> {
    /// Of nothing, with the lanes of `zero`.
    #[inline(always)]
    pub fn new(zero: N) -> Self {
        let sums = Sums::new(zero);
        Self {
            zero,
            count: 0,
            weights: sums,
            holds: [false; 3],
            area: [sums; 3],
            load: [sums; 3],
            stiffness: sums,
            area_squared: sums,
            load_squared: sums,
        }
    }

    /// Adds real contacts of all lanes.
    #[inline(always)]
    pub fn add(&mut self, few: &LaneAccumulator<N>) {
        self.count += few.count;
        self.add_few(few);
    }

    /// Adds the real contacts of some lanes, `count` of them.
    #[inline(always)]
    pub fn add_part(&mut self, contact: &Contacts<N>, present: N::Mask, count: usize) {
        let mut few = LaneAccumulator::new(self.zero);
        few.add(&Contacts {
            area: N::select(present, contact.area, self.zero),
            load: N::select(present, contact.load, self.zero),
            stiffness: N::select(present, contact.stiffness, self.zero),
            elastic: contact.elastic | !present,
            plastic: contact.plastic & present,
        });
        self.count += count;
        self.add_few(&few);
    }

    #[inline(always)]
    fn add_few(&mut self, few: &LaneAccumulator<N>) {
        self.add_weighted(few);
        self.area_squared.add(few.area_squared);
        self.load_squared.add(few.load_squared);
    }

    /// Adds all but the squares, of which weighed contacts have none.
    #[inline(always)]
    pub fn add_weighted(&mut self, few: &LaneAccumulator<N>) {
        for regime in 0..3 {
            if few.holds[regime] {
                self.holds[regime] = true;
                self.area[regime].add(few.area[regime]);
                self.load[regime].add(few.load[regime]);
            }
        }
        self.stiffness.add(few.stiffness);
    }

    /// Adds to `few` `weights` contacts of each kind (quadrature weights, in the statistical model); the weights themselves
    /// are kept here, each to its last digit.
    #[inline(always)]
    pub fn accumulate_weighted(&mut self, few: &mut LaneAccumulator<N>, contact: &Contacts<N>, weights: N) {
        self.weights.add(weights);
        few.add_contacts(&contact.times(weights));
    }
}

impl<N: Real> LaneAccumulator<N> {
    /// None, with the lanes of `zero`.
    #[inline(always)]
    pub fn new(zero: N) -> Self {
        Self {
            zero,
            count: 0,
            holds: [false; 3],
            area: [zero; 3],
            load: [zero; 3],
            stiffness: zero,
            area_squared: zero,
            load_squared: zero,
        }
    }

    /// Adds the contacts of all lanes, up to [`FEW`] times.
    #[inline(always)]
    pub fn add(&mut self, contact: &Contacts<N>) {
        self.count += N::LANES;
        self.add_contacts(contact);
    }

    #[inline(always)]
    fn add_contacts(&mut self, contact: &Contacts<N>) {
        let &Contacts { area, load, stiffness, elastic, plastic } = contact;
        self.stiffness = self.stiffness + stiffness;
        self.area_squared = area.mul_add(area, self.area_squared);
        self.load_squared = load.mul_add(load, self.load_squared);
        let flowing = !(elastic | plastic);
        // Most often all are of one regime.
        let of_one = self.add_if_all(Regime::Elastic, elastic, area, load)
            || self.add_if_all(Regime::ElasticPlastic, flowing, area, load)
            || self.add_if_all(Regime::Plastic, plastic, area, load);
        if !of_one {
            self.add_some(Regime::Elastic, elastic, area, load);
            self.add_some(Regime::ElasticPlastic, flowing, area, load);
            self.add_some(Regime::Plastic, plastic, area, load);
        }
    }

    #[inline(always)]
    fn add_if_all(&mut self, regime: Regime, mask: N::Mask, area: N, load: N) -> bool {
        let all = mask.all();
        if all {
            self.add_to(regime, area, load);
        }
        all
    }

    #[inline(always)]
    fn add_some(&mut self, regime: Regime, mask: N::Mask, area: N, load: N) {
        if mask.any() {
            self.add_to(regime, N::select(mask, area, self.zero), N::select(mask, load, self.zero));
        }
    }

    #[inline(always)]
    fn add_to(&mut self, regime: Regime, area: N, load: N) {
        let regime = regime as usize;
        self.holds[regime] = true;
        self.area[regime] = self.area[regime] + area;
        self.load[regime] = self.load[regime] + load;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_parts_of_the_total_in_the_order_of_the_regimes() {
        let mut accumulator = Accumulator::default();
        for (regime, load) in Regime::ALL.into_iter().zip([1.0, 2.0, 5.0]) {
            accumulator.add(&Contact { area: 2.0 * load, load, stiffness: 0.0, regime });
        }
        let total = accumulator.total();
        assert_eq!(total.load().shares(), Some([0.125, 0.25, 0.625]));
        assert_eq!(total.area().0, [2.0, 4.0, 10.0]);
        assert_eq!(ByRegime::default().shares(), None);
    }
}
