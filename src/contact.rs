//! What one micro-contact answers, and what many of them add up to.

use crate::numeric::lanes::{Mask, Real, Work, run};
use crate::numeric::sum::{Parted, Sums};

/// How an asperity carries its load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Regime {
    /// Fully recoverable.
    Elastic,
    /// Contained plastic flow.
    ElasticPlastic,
    /// The mean pressure has reached the hardness.
    Plastic,
}

impl Regime {
    /// All regimes, in the order in which a growing indentation passes them.
    pub const ALL: [Self; 3] = [Self::Elastic, Self::ElasticPlastic, Self::Plastic];

    /// The regime's name as reports and tables write it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Elastic => "elastic",
            Self::ElasticPlastic => "elastic-plastic",
            Self::Plastic => "plastic",
        }
    }
}

/// The answer of one asperity pressed by `w > 0` into the flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Real contact area, m^2.
    pub area: f64,
    /// Normal load, N.
    pub load: f64,
    /// dP/dw on the side of the indentation's own regime, N/m.
    pub stiffness: f64,
    /// Elastic, elastic-plastic or plastic.
    pub regime: Regime,
}

/// The answers of asperities side by side.
#[derive(Debug, Clone, Copy)]
pub struct Contacts<N: Real> {
    /// Real contact areas, m^2.
    pub area: N,
    /// Normal loads, N.
    pub load: N,
    /// dP/dw, N/m.
    pub stiffness: N,
    /// Which are elastic.
    pub elastic: N::Mask,
    /// Which are plastic.
    pub plastic: N::Mask,
}

impl<N: Real> Contacts<N> {
    /// Those of `yes` where `mask` is, those of `no` elsewhere.
    #[inline(always)]
    pub fn choose(mask: N::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            area: N::choose(mask, yes.area, no.area),
            load: N::choose(mask, yes.load, no.load),
            stiffness: N::choose(mask, yes.stiffness, no.stiffness),
            elastic: (mask & yes.elastic) | (!mask & no.elastic),
            plastic: (mask & yes.plastic) | (!mask & no.plastic),
        }
    }

    /// What `count` of each answer side by side.
    #[inline(always)]
    pub fn times(self, count: N) -> Self {
        Self { area: self.area * count, load: self.load * count, stiffness: self.stiffness * count, ..self }
    }
}

impl From<Contacts<f64>> for Contact {
    #[inline(always)]
    fn from(one: Contacts<f64>) -> Self {
        let regime = match one {
            Contacts { elastic: true, .. } => Regime::Elastic,
            Contacts { plastic: true, .. } => Regime::Plastic,
            _ => Regime::ElasticPlastic,
        };
        Self { area: one.area, load: one.load, stiffness: one.stiffness, regime }
    }
}

/// One quantity split by regime; its total is the sum of the parts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByRegime(pub [f64; 3]);

impl ByRegime {
    /// Sum over the regimes.
    pub fn total(&self) -> f64 {
        self.0[0] + self.0[1] + self.0[2]
    }

    /// Each regime's part of the total; `None` where there is nothing to share.
    pub fn shares(&self) -> Option<[f64; 3]> {
        let total = self.total();
        (total > 0.0).then(|| self.0.map(|part| part / total))
    }
}

/// What many micro-contacts add up to, by regime. Tallies of parts merge into the tally of the
/// whole; the order of merging is the caller's to fix.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    contacts: Parted,
    area: [Parted; 3],
    load: [Parted; 3],
    stiffness: Parted,
    area_squared: Parted,
    load_squared: Parted,
}

impl Tally {
    /// Adds `weight` contacts of one kind (a quadrature weight, in the statistical model).
    #[inline]
    pub fn weigh(&mut self, contact: &Contact, weight: f64) {
        let regime = contact.regime as usize;
        self.contacts.add(weight);
        self.area[regime].add(weight * contact.area);
        self.load[regime].add(weight * contact.load);
        self.stiffness.add(weight * contact.stiffness);
    }

    /// Adds one real contact, squares included: they give the sampling error.
    #[inline]
    pub fn add(&mut self, contact: &Contact) {
        let regime = contact.regime as usize;
        self.contacts.add(1.0);
        self.area[regime].add(contact.area);
        self.load[regime].add(contact.load);
        self.stiffness.add(contact.stiffness);
        self.area_squared.add(contact.area * contact.area);
        self.load_squared.add(contact.load * contact.load);
    }

    /// Adds a load that appears at once, where a law jumps, to the stiffness.
    pub fn add_jump(&mut self, stiffness: f64) {
        self.stiffness.add(stiffness);
    }

    /// Adds the tally of another part.
    pub fn merge(&mut self, other: &Self) {
        run(Merge(self, other));
    }

    /// Adds what was tallied side by side.
    #[inline(always)]
    pub fn add_lanes<N: Real>(&mut self, lanes: &SideBySide<N>) {
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

    /// Standard error of the total load, N; see [`Tally::area_error`].
    pub fn load_error(&self, count: usize) -> f64 {
        sampling_error(self.load_squared.value(), self.load().total(), count)
    }
}

struct Merge<'a>(&'a mut Tally, &'a Tally);

impl Work for Merge<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self(all, part) = self;
        all.contacts.merge(&part.contacts, zero);
        for regime in 0..3 {
            all.area[regime].merge(&part.area[regime], zero);
            all.load[regime].merge(&part.load[regime], zero);
        }
        all.stiffness.merge(&part.stiffness, zero);
        all.area_squared.merge(&part.area_squared, zero);
        all.load_squared.merge(&part.load_squared, zero);
    }
}

/// A tally of contacts side by side.
pub struct SideBySide<N> {
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

/// Few contacts, added plainly: a sum of [`FEW`] positive terms is off by three roundings at the most.
pub struct Handful<N> {
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
pub const FEW: usize = 4;

impl<N: Real> SideBySide<N> {
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
    pub fn add(&mut self, few: &Handful<N>) {
        self.count += few.count;
        self.add_few(few);
    }

    /// Adds the real contacts of some lanes, `count` of them.
    #[inline(always)]
    pub fn add_part(&mut self, contact: &Contacts<N>, present: N::Mask, count: usize) {
        let mut few = Handful::new(self.zero);
        few.add(&Contacts {
            area: N::choose(present, contact.area, self.zero),
            load: N::choose(present, contact.load, self.zero),
            stiffness: N::choose(present, contact.stiffness, self.zero),
            elastic: contact.elastic | !present,
            plastic: contact.plastic & present,
        });
        self.count += count;
        self.add_few(&few);
    }

    #[inline(always)]
    fn add_few(&mut self, few: &Handful<N>) {
        self.add_plain(few);
        self.area_squared.add(few.area_squared);
        self.load_squared.add(few.load_squared);
    }

    /// All but the squares.
    #[inline(always)]
    fn add_plain(&mut self, few: &Handful<N>) {
        for regime in 0..3 {
            if few.holds[regime] {
                self.holds[regime] = true;
                self.area[regime].add(few.area[regime]);
                self.load[regime].add(few.load[regime]);
            }
        }
        self.stiffness.add(few.stiffness);
    }

    /// Adds `weights` contacts of each kind (quadrature weights, in the statistical model).
    #[inline(always)]
    pub fn weigh(&mut self, contact: Contacts<N>, weights: N) {
        let mut few = Handful::new(self.zero);
        few.add(&contact.times(weights));
        self.weights.add(weights);
        self.add_plain(&few);
    }
}

impl<N: Real> Handful<N> {
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
        let &Contacts { area, load, stiffness, elastic, plastic } = contact;
        self.count += N::LANES;
        self.stiffness = self.stiffness + stiffness;
        self.area_squared = area.times_plus(area, self.area_squared);
        self.load_squared = load.times_plus(load, self.load_squared);
        if elastic.all() {
            self.add_to(Regime::Elastic, area, load);
            return;
        }
        self.add_some(Regime::Elastic, elastic, area, load);
        self.add_some(Regime::ElasticPlastic, !(elastic | plastic), area, load);
        self.add_some(Regime::Plastic, plastic, area, load);
    }

    #[inline(always)]
    fn add_some(&mut self, regime: Regime, mask: N::Mask, area: N, load: N) {
        if mask.any() {
            self.add_to(regime, N::choose(mask, area, self.zero), N::choose(mask, load, self.zero));
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

/// Equal terms leave a difference of pure rounding, possibly below zero: that is no scatter.
fn sampling_error(squares: f64, total: f64, count: usize) -> f64 {
    let scatter = squares - total * total / count as f64;
    if scatter > 16.0 * f64::EPSILON * squares { scatter.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_parts_of_the_total_in_the_order_of_the_regimes() {
        let mut tally = Tally::default();
        for (regime, load) in Regime::ALL.into_iter().zip([1.0, 2.0, 5.0]) {
            tally.add(&Contact { area: 2.0 * load, load, stiffness: 0.0, regime });
        }
        assert_eq!(tally.load().shares(), Some([0.125, 0.25, 0.625]));
        assert_eq!(tally.area().0, [2.0, 4.0, 10.0]);
        assert_eq!(ByRegime::default().shares(), None);
    }
}
