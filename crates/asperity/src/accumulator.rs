//! Sums over micro-contacts: number, area, load and stiffness.

use std::f64::consts::PI;
use std::ops::AddAssign;

use crate::contact::{ByRegime, Contact, Contacts, LARGEST_SLOPE, Regime};
use crate::numeric::lanes::{MOST, Mask, Real};
use crate::numeric::sum::{LaneSum, Sum};
use crate::shape::Shape;
use crate::spot::{SpotQuantity, SpotValues};

/// Number of quantities of a spot.
const SPOTS: usize = SpotQuantity::ALL.len();

/// The sums over contacts, area and load by regime. `S` is the type of each sum: see [`Total`] and [`Accumulator`];
/// within a vector register, plain numbers for up to 16 contacts and compensated sums for more.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactSums<S> {
    contacts: S,
    /// Whether there was a contact of each regime; where there was none, its sums are zero.
    occurs: [bool; 3],
    area: [S; 3],
    load: [S; 3],
    stiffness: S,
    area_squared: S,
    load_squared: S,
    /// Load of the contacts at large strain.
    large_strain_load: S,
    /// Largest load of a contact, N; of sums in registers only once they are complete.
    largest_load: f64,
    /// By [`SpotQuantity`](crate::spot::SpotQuantity); `None` where they are not wanted.
    spots: Option<[S; SPOTS]>,
}

/// The area (m^2) above which strains are not small in the contact of `spheres` spheres of `radius` (m): a/R, with a of the
/// law's own area, exceeds [`LARGEST_SLOPE`].
#[inline(always)]
pub(crate) fn small_strain_area<N: Real>(radius: N, spheres: N) -> N {
    radius * radius * spheres * (PI * LARGEST_SLOPE * LARGEST_SLOPE)
}

/// The sums over a part of the contacts. Parts are added with [`ContactSums::merge`], in an order that the caller
/// fixes; with the feature `serde` they pass between machines, so that a sum can be divided among many.
pub type Total = ContactSums<Sum>;

/// Running sums, to which contacts are added one by one or a register at a time.
pub type Accumulator = ContactSums<LaneSum>;

impl<S: Default> ContactSums<S> {
    /// Empty sums that take those over spots, too, where `wants_spots`.
    pub fn empty(wants_spots: bool) -> Self {
        Self { spots: wants_spots.then(Default::default), ..Self::default() }
    }
}

/// The largest number of contacts that a lane adds without compensation: at most 15 rounding errors.
pub(crate) const PLAIN_TERMS: usize = 16;

impl<S: Copy> ContactSums<S> {
    /// Empty sums with the lanes of `zero`.
    #[inline(always)]
    pub(crate) fn new(zero: S) -> Self {
        Self {
            contacts: zero,
            occurs: [false; 3],
            area: [zero; 3],
            load: [zero; 3],
            stiffness: zero,
            area_squared: zero,
            load_squared: zero,
            large_strain_load: zero,
            largest_load: 0.0,
            spots: None,
        }
    }

    /// Adds the sums over another part.
    #[inline(always)]
    pub fn merge<T: Copy>(&mut self, part: &ContactSums<T>)
    where
        S: AddAssign<T>,
    {
        self.contacts += part.contacts;
        self.merge_weighted(part);
        self.area_squared += part.area_squared;
        self.load_squared += part.load_squared;
        self.large_strain_load += part.large_strain_load;
        self.largest_load = self.largest_load.max(part.largest_load);
    }

    /// Like [`Self::merge`], without the number of contacts and without what has no meaning for weighted contacts: squares,
    /// the largest load, the load at large strain.
    #[inline(always)]
    pub(crate) fn merge_weighted<T: Copy>(&mut self, part: &ContactSums<T>)
    where
        S: AddAssign<T>,
    {
        for regime in 0..3 {
            if part.occurs[regime] {
                self.occurs[regime] = true;
                self.area[regime] += part.area[regime];
                self.load[regime] += part.load[regime];
            }
        }
        self.stiffness += part.stiffness;
        if let (Some(spots), Some(part)) = (&mut self.spots, part.spots) {
            spots.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
    }
}

impl Total {
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

    /// Sum of the squared loads, N^2.
    pub fn load_squared(&self) -> f64 {
        self.load_squared.value()
    }

    /// Largest load of a contact, N.
    pub fn largest_load(&self) -> f64 {
        self.largest_load
    }

    /// Sums of [`SpotQuantity`](crate::spot::SpotQuantity); `None` where they were not wanted.
    pub fn spots(&self) -> Option<SpotValues> {
        self.spots.map(|spots| spots.map(|sum| sum.value()))
    }

    /// Load of the contacts whose a/R exceeds [`LARGEST_SLOPE`], N; a is the radius of a circle of the contact's area.
    pub fn large_strain_load(&self) -> f64 {
        self.large_strain_load.value()
    }
}

/// The difference of equal terms is a rounding error, possibly negative; it counts as 0.
fn sampling_error(squares: f64, total: f64, count: usize) -> f64 {
    let scatter = squares - total * total / count as f64;
    if scatter > 16.0 * f64::EPSILON * squares { scatter.sqrt() } else { 0.0 }
}

impl Accumulator {
    /// Whether sums over spots are wanted.
    pub fn wants_spots(&self) -> bool {
        self.spots.is_some()
    }

    /// Adds the values of a spot times `weight`, where they are wanted.
    #[inline]
    pub fn add_spot(&mut self, values: SpotValues, weight: f64) {
        if let Some(spots) = &mut self.spots {
            spots.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
    }

    /// Adds `contact` times `weight` (a quadrature weight of the statistical model).
    #[inline]
    pub fn accumulate_weighted(&mut self, contact: &Contact, weight: f64) {
        let regime = contact.regime as usize;
        self.contacts += weight;
        self.occurs[regime] = true;
        self.area[regime] += weight * contact.area;
        self.load[regime] += weight * contact.load;
        self.stiffness += weight * contact.stiffness;
    }

    /// Adds the contact of one asperity of `shape`, with what follows from single contacts: squares, from which the
    /// sampling error follows, the largest load, the load at large strain.
    #[inline]
    pub fn add(&mut self, contact: &Contact, shape: Shape) {
        self.accumulate_weighted(contact, 1.0);
        self.area_squared += contact.area * contact.area;
        self.load_squared += contact.load * contact.load;
        self.largest_load = self.largest_load.max(contact.load);
        if contact.area > small_strain_area(shape.radius, shape.spheres) {
            self.large_strain_load += contact.load;
        }
    }

    /// Adds the contribution of a load jump to the stiffness (N/m).
    pub fn add_jump(&mut self, stiffness: f64) {
        self.stiffness += stiffness;
    }

    /// The sums over all contacts that were added.
    pub fn total(&self) -> Total {
        Total {
            contacts: self.contacts.total(),
            occurs: self.occurs,
            area: self.area.map(|sum| sum.total()),
            load: self.load.map(|sum| sum.total()),
            stiffness: self.stiffness.total(),
            area_squared: self.area_squared.total(),
            load_squared: self.load_squared.total(),
            large_strain_load: self.large_strain_load.total(),
            largest_load: self.largest_load,
            spots: self.spots.map(|spots| spots.map(|sum| sum.total())),
        }
    }
}

/// In registers, any number of contacts.
impl<N: Real> ContactSums<Sum<N>> {
    /// Adds the contacts of the lanes in `present`; see [`ContactSums::add`] for `small_strain`.
    #[inline(always)]
    pub(crate) fn add_present(&mut self, contact: &Contacts<N>, small_strain: N, present: N::Mask) -> N {
        let zero = contact.area.splat(0.0);
        let mut plain = ContactSums::new(zero);
        let contact = Contacts {
            area: N::select(present, contact.area, zero),
            load: N::select(present, contact.load, zero),
            stiffness: N::select(present, contact.stiffness, zero),
            elastic: contact.elastic | !present,
            plastic: contact.plastic & present,
        };
        plain.add_terms(&contact);
        plain.add_large_strain(&contact, small_strain);
        plain.contacts = N::select(present, zero + 1.0, zero);
        self.merge(&plain);
        contact.load
    }

    /// Completes the sums with the largest load of each lane.
    #[inline(always)]
    pub(crate) fn with_largest_load(self, loads: N) -> Self {
        let mut lanes = [0.0; MOST];
        loads.store(&mut lanes);
        Self { largest_load: lanes[..N::LANES].iter().copied().fold(self.largest_load, f64::max), ..self }
    }

    /// Adds contacts times `weights` (quadrature weights of the statistical model) to `plain`. Only the weights are
    /// summed here, with compensation; [`Self::merge_weighted`] adds the rest.
    #[inline(always)]
    pub(crate) fn accumulate_weighted(
        &mut self,
        plain: &mut ContactSums<N>,
        contact: &Contacts<N>,
        weights: N,
    ) {
        self.contacts += weights;
        plain.add_terms(&contact.times(weights));
    }
}

/// In registers, at most [`PLAIN_TERMS`] contacts per lane.
impl<N: Real> ContactSums<N> {
    /// Adds the contacts of all lanes; `small_strain` is [`small_strain_area`] of each lane.
    #[inline(always)]
    pub(crate) fn add(&mut self, contact: &Contacts<N>, small_strain: N) {
        self.contacts = self.contacts + 1.0;
        self.add_terms(contact);
        self.add_large_strain(contact, small_strain);
    }

    #[inline(always)]
    fn add_large_strain(&mut self, contact: &Contacts<N>, small_strain: N) {
        let is_large = small_strain.lt(contact.area);
        if is_large.any() {
            let load = N::select(is_large, contact.load, contact.load.splat(0.0));
            self.large_strain_load = self.large_strain_load + load;
        }
    }

    #[inline(always)]
    fn add_terms(&mut self, contact: &Contacts<N>) {
        let &Contacts { area, load, stiffness, elastic, plastic } = contact;
        self.stiffness = self.stiffness + stiffness;
        self.area_squared = area.mul_add(area, self.area_squared);
        self.load_squared = load.mul_add(load, self.load_squared);
        let between = !(elastic | plastic);
        // Usually all lanes are in one regime.
        let of_one = self.add_if_all(Regime::Elastic, elastic, area, load)
            || self.add_if_all(Regime::ElasticPlastic, between, area, load)
            || self.add_if_all(Regime::Plastic, plastic, area, load);
        if !of_one {
            self.add_some(Regime::Elastic, elastic, area, load);
            self.add_some(Regime::ElasticPlastic, between, area, load);
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
            let zero = area.splat(0.0);
            self.add_to(regime, N::select(mask, area, zero), N::select(mask, load, zero));
        }
    }

    #[inline(always)]
    fn add_to(&mut self, regime: Regime, area: N, load: N) {
        let regime = regime as usize;
        self.occurs[regime] = true;
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
            let contact = Contact { area: 2.0 * load, load, stiffness: 0.0, regime };
            accumulator.add(&contact, Shape::sphere(5.0));
        }
        let total = accumulator.total();
        assert_eq!(total.load().shares(), Some([0.125, 0.25, 0.625]));
        assert_eq!(total.area().0, [2.0, 4.0, 10.0]);
        assert_eq!(ByRegime::default().shares(), None);
        // a/R exceeds 0.3 above an area of 7.07 on a sphere of radius 5.
        assert_eq!((total.largest_load(), total.large_strain_load()), (5.0, 5.0));
        assert_eq!(total.load_squared(), 30.0);
    }
}
