//! Common parts of laws with several regimes.

use super::{FullyPlastic, Hertz, Pairs};
use crate::contact::Contacts;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{Mask, Real};

/// Hertz where contacts are `elastic`, Abbott and Firestone where they are `plastic`, and `between` elsewhere.
#[inline(always)]
pub(super) fn in_range<N: Real>(
    w: N,
    b: N,
    pair: &Pairs<N>,
    [elastic, plastic]: [N::Mask; 2],
    between: Contacts<N>,
) -> Contacts<N> {
    let mut contacts = between;
    if plastic.any() {
        contacts =
            Contacts::select(plastic, &FullyPlastic::plastic(w, b, pair.yield_limits.strength), &contacts);
    }
    if elastic.any() {
        contacts = Contacts::select(elastic, &Hertz::elastic(w, b, pair.reduced_modulus), &contacts);
    }
    contacts
}

/// The hull of those `exponents` whose ranges overlap `u`; each range begins at the given value, ascending from 0.
pub(super) fn exponents_passed(u: Interval, exponents: &[(f64, Interval)]) -> Interval {
    let ends = exponents.iter().skip(1).map(|(from, _)| *from).chain([f64::INFINITY]);
    let passed = exponents.iter().zip(ends).filter(|((from, _), to)| u.high >= *from && u.low <= *to);
    passed.map(|((_, exponents), _)| *exponents).reduce(Interval::hull).unwrap_or_default()
}
