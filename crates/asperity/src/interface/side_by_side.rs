//! The contacts of many asperities, in the registers of the machine.

use crate::asperity::Asperities;
use crate::contact::Contacts;
use crate::law::Shape;
use crate::numeric::lanes::{MOST, Real, Work, run};
use crate::tally::{FEW, Handful, SideBySide, Tally};

/// What knows the contacts of asperities side by side.
pub(super) trait Answers {
    /// The answers of shapes, so many spheres of such radii (m), at indentations `w` (m). Must be `#[inline(always)]`, see
    /// [`crate::numeric::lanes`].
    fn answers<N: Real>(&self, w: N, radius: N, spheres: N) -> Contacts<N>;
}

/// [`super::MicroContact::press`].
pub(super) fn press<A: Answers>(contact: A, asperities: Asperities<'_>, separation: f64, tally: &mut Tally) {
    run(Press { contact, asperities, separation, tally });
}

/// [`super::MicroContact::weigh`].
pub(super) fn weigh<A: Answers>(
    contact: A,
    indentations: &[f64],
    weights: &[f64],
    shape: Shape,
    tally: &mut Tally,
) {
    run(Weigh { contact, indentations, weights, shape, tally });
}

struct Press<'a, A> {
    contact: A,
    asperities: Asperities<'a>,
    separation: f64,
    tally: &'a mut Tally,
}

impl<A: Answers> Work for Press<'_, A> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { contact, asperities, separation, tally } = self;
        let (heights, radii) = (asperities.heights(), asperities.radii());
        let lanes = match asperities.spheres() {
            None => press_lanes::<N, A, false>(contact, zero, separation, [heights, radii, radii]),
            Some(spheres) => press_lanes::<N, A, true>(contact, zero, separation, [heights, radii, spheres]),
        };
        tally.add_lanes(&lanes);
    }
}

/// The last numbers of `values`, as many as there are lanes, the first of them again where there are not so many.
#[inline(always)]
fn last<N: Real>(values: &[f64], zero: N) -> N {
    if let Some(first) = values.len().checked_sub(N::LANES) {
        return zero.load(&values[first..]);
    }
    let mut lanes = [values[0]; MOST];
    lanes[N::LANES - values.len()..N::LANES].copy_from_slice(values);
    zero.load(&lanes)
}

/// Presses asperities of some heights and radii, for each of which one sphere stands or, of ellipses, so many.
#[inline(always)]
fn press_lanes<N: Real, A: Answers, const ELLIPSES: bool>(
    contact: A,
    zero: N,
    separation: f64,
    [heights, radii, spheres]: [&[f64]; 3],
) -> SideBySide<N> {
    let count = heights.len();
    let mut lanes = SideBySide::new(zero);
    let mut start = 0;
    while start + N::LANES <= count {
        let mut few = Handful::new(zero);
        for _ in 0..FEW {
            if start + N::LANES <= count {
                let w = zero.load(&heights[start..]) - separation;
                // The compiler leaves out a multiplication by one.
                let n = if ELLIPSES { zero.load(&spheres[start..]) } else { zero.splat(1.0) };
                few.add(&contact.answers(w, zero.load(&radii[start..]), n));
                start += N::LANES;
            }
        }
        lanes.add(&few);
    }
    if start < count {
        // Lanes before the rest are of asperities that were added already, and do not count.
        let rest = zero.lanes_from(N::LANES - (count - start));
        let n = if ELLIPSES { last(spheres, zero) } else { zero.splat(1.0) };
        let contacts = contact.answers(last(heights, zero) - separation, last(radii, zero), n);
        lanes.add_part(&contacts, rest, count - start);
    }
    lanes
}

struct Weigh<'a, A> {
    contact: A,
    indentations: &'a [f64],
    weights: &'a [f64],
    shape: Shape,
    tally: &'a mut Tally,
}

impl<A: Answers> Work for Weigh<'_, A> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { contact, indentations, weights, shape, tally } = self;
        let (radius, spheres) = (zero.splat(shape.radius), zero.splat(shape.spheres));
        let mut lanes = SideBySide::new(zero);
        let mut start = 0;
        while start + N::LANES <= indentations.len() {
            let mut few = Handful::new(zero);
            for _ in 0..FEW {
                if start + N::LANES <= indentations.len() {
                    let w = zero.load(&indentations[start..]);
                    lanes.weigh(&mut few, &contact.answers(w, radius, spheres), zero.load(&weights[start..]));
                    start += N::LANES;
                }
            }
            lanes.add_weighed(&few);
        }
        if start < indentations.len() {
            let rest = zero.lanes_from(N::LANES - (indentations.len() - start));
            let contacts = contact.answers(last(indentations, zero), radius, spheres);
            let mut few = Handful::new(zero);
            lanes.weigh(&mut few, &contacts, N::choose(rest, last(weights, zero), zero));
            lanes.add_weighed(&few);
        }
        tally.add_lanes(&lanes);
    }
}
