//! What one micro-contact answers, and what many of them add up to.

use crate::numeric::Sum;

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

impl Contact {
    /// What `count` of them answer side by side.
    #[inline(always)]
    pub fn times(self, count: f64) -> Self {
        Self {
            area: count * self.area,
            load: count * self.load,
            stiffness: count * self.stiffness,
            regime: self.regime,
        }
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
    contacts: Sum,
    area: [Sum; 3],
    load: [Sum; 3],
    stiffness: Sum,
    area_squared: Sum,
    load_squared: Sum,
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

    /// Standard error of the total load, N; see [`Tally::area_error`].
    pub fn load_error(&self, count: usize) -> f64 {
        sampling_error(self.load_squared.value(), self.load().total(), count)
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
