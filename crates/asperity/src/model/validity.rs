//! The range in which a result holds: enough contacts carry the load, none dominates, asperities do not interact, strains
//! are small.

use super::Response;
use crate::accumulator::Total;
use crate::named_enum;

/// The smallest number of effective contacts: with fewer, the sum depends on a few of the highest asperities.
pub const MIN_CONTACTS: f64 = 30.0;

/// The largest share of the load in one contact.
pub const LARGEST_LOAD_SHARE: f64 = 0.1;

/// The area ratio beyond which neighbouring asperities interact and asperity models do not hold.
pub const INTERACTION: f64 = 0.05;

/// The largest share of the load in contacts at large strain.
pub const LARGE_STRAIN_SHARE: f64 = 0.1;

/// How the contacts of a sum share its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadSharing {
    /// Effective number of contacts, 1 over the sum of the squared load shares: n for n equally loaded contacts.
    pub effective_contacts: f64,
    /// Share of the load in the most heavily loaded contact.
    pub largest_share: f64,
    /// Share of the load in contacts whose a/R exceeds [`LARGEST_SLOPE`](crate::sphere::LARGEST_SLOPE), a being the
    /// radius of a circle of the contact's area.
    pub large_strain_share: f64,
}

impl LoadSharing {
    /// `None` without a load.
    pub(super) fn new(total: &Total) -> Option<Self> {
        let load = total.load().total();
        (load > 0.0).then(|| Self {
            // Squares of tiny loads round to zero.
            effective_contacts: ((load / total.load_squared()) * load).min(total.contacts()),
            largest_share: total.largest_load() / load,
            large_strain_share: total.large_strain_load() / load,
        })
    }
}

named_enum! {
    /// A limit of admissible loads.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Limit {
        /// At least [`MIN_CONTACTS`] effective contacts.
        FewContacts = "few-contacts",
        /// At most [`LARGEST_LOAD_SHARE`] of the load in one contact.
        DominantContact = "dominant-contact",
        /// An area ratio of at most [`INTERACTION`].
        Interaction = "interaction",
        /// At most [`LARGE_STRAIN_SHARE`] of the load in contacts at large strain.
        LargeStrain = "large-strain",
    }
}

/// The limits that a result exceeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Exceeded([bool; 4]);

impl Exceeded {
    /// Whether the result is within all limits.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// Whether the result is within all limits but, perhaps, this one.
    pub fn is_at_most(self, limit: Limit) -> bool {
        self.limits().all(|exceeded| exceeded == limit)
    }

    /// The limits exceeded.
    pub fn limits(self) -> impl Iterator<Item = Limit> {
        Limit::ALL.into_iter().filter(move |limit| self.0[*limit as usize])
    }

    /// The limits that one or the other exceeds.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(Limit::ALL.map(|limit| self.0[limit as usize] || other.0[limit as usize]))
    }

    /// Those of the given sharing of the load and area ratio.
    pub fn new(sharing: Option<&LoadSharing>, area_ratio: f64) -> Self {
        let beyond = |limit: fn(&LoadSharing) -> bool| sharing.is_some_and(limit);
        Self([
            // Equal loads give a whole number but for rounding.
            beyond(|sharing| sharing.effective_contacts < MIN_CONTACTS * (1.0 - 1e-12)),
            beyond(|sharing| sharing.largest_share > LARGEST_LOAD_SHARE),
            area_ratio > INTERACTION,
            beyond(|sharing| sharing.large_strain_share > LARGE_STRAIN_SHARE),
        ])
    }
}

impl Response {
    /// The limits that the response exceeds; of an integral, which has no single contacts, only the area ratio is known.
    pub fn exceeded(&self) -> Exceeded {
        Exceeded::new(self.sharing.as_ref(), self.area_ratio.total())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accumulator::Accumulator;
    use crate::contact::{Contact, Regime};
    use crate::shape::Shape;

    fn sharing(loads: &[f64]) -> Option<LoadSharing> {
        let mut accumulator = Accumulator::default();
        for &load in loads {
            let contact = Contact { area: 1e-20, load, stiffness: 1.0, regime: Regime::Elastic };
            accumulator.add(&contact, Shape::sphere(1.0));
        }
        LoadSharing::new(&accumulator.total())
    }

    fn names(exceeded: Exceeded) -> Vec<&'static str> {
        exceeded.limits().map(Limit::name).collect()
    }

    #[test]
    fn equal_loads_count_as_many_as_they_are() {
        let equal = sharing(&[3.0; 30]).unwrap();
        assert!((equal.effective_contacts - 30.0).abs() < 1e-12);
        assert!((equal.largest_share - 1.0 / 30.0).abs() < 1e-15);
        assert!(Exceeded::new(Some(&equal), 0.05).is_none());
        assert_eq!(names(Exceeded::new(sharing(&[3.0; 29]).as_ref(), 0.05)), ["few-contacts"]);
        assert_eq!(sharing(&[]), None);
        assert!(Exceeded::new(None, 0.01).is_none());
        // The square of such a load is zero.
        assert!((sharing(&[1e-170; 40]).unwrap().effective_contacts - 40.0).abs() < 1e-9);
    }

    /// 115 equal contacts and one that carries twice as much as all of them.
    #[test]
    fn one_spike_among_many_contacts_is_found() {
        let mut loads = vec![1.0; 115];
        loads.push(230.0);
        let spiked = sharing(&loads).unwrap();
        assert!(spiked.effective_contacts < 2.3 && (spiked.largest_share - 2.0 / 3.0).abs() < 1e-15);
        assert_eq!(names(Exceeded::new(Some(&spiked), 0.01)), ["few-contacts", "dominant-contact"]);
    }

    #[test]
    fn limits_are_those_of_either_model() {
        let strained =
            LoadSharing { effective_contacts: 100.0, largest_share: 0.02, large_strain_share: 0.11 };
        let both = Exceeded::new(Some(&strained), 0.05).union(Exceeded::new(None, 0.051));
        assert_eq!(names(both), ["interaction", "large-strain"]);
        let small = LoadSharing { large_strain_share: 0.1, ..strained };
        assert!(Exceeded::new(Some(&small), 0.05).is_none());
    }
}
