//! The contacts of many asperities, evaluated in vector registers.

use crate::accumulator::{Accumulator, ContactSums, PLAIN_TERMS, small_strain_area};
use crate::asperity::Asperities;
use crate::contact::{ContactColumns, Contacts};
use crate::numeric::lanes::{MOST, Real, Work, run};
use crate::numeric::sum::Sum;
use crate::shape::Shape;

/// Evaluates the contacts of one asperity per lane, in two steps that each run over several registers: the instructions of one step
/// are few enough for the processor to work at several registers at once.
///
/// All methods must be `#[inline(always)]`, see [`crate::numeric::lanes`].
pub(super) trait LaneContacts {
    /// What the first step finds.
    type Local<N: Real>: Copy;

    /// Properties of the bodies under asperities at indentations `w` (m), each `spheres` spheres of `radius` (m).
    fn local<N: Real>(&self, w: N, radius: N, spheres: N) -> Self::Local<N>;

    /// The contacts with these properties.
    fn contacts<N: Real>(&self, w: N, radius: N, spheres: N, local: &Self::Local<N>) -> Contacts<N>;
}

/// Implements [`super::MicroContact::accumulate`].
pub(super) fn accumulate<A: LaneContacts>(
    contact: A,
    asperities: Asperities<'_>,
    separation: f64,
    accumulator: &mut Accumulator,
) {
    run(Accumulate { contact, asperities, separation, accumulator });
}

/// Implements [`super::MicroContact::accumulate_weighted`].
pub(super) fn accumulate_weighted<A: LaneContacts>(
    contact: A,
    indentations: &[f64],
    weights: &[f64],
    shape: Shape,
    accumulator: &mut Accumulator,
) {
    run(AccumulateWeighted { contact, indentations, weights, shape, accumulator });
}

/// Implements [`super::MicroContact::contacts`].
pub(super) fn contacts<A: LaneContacts>(contact: A, indentations: &[f64], shape: Shape) -> ContactColumns {
    run(EachContact { contact, indentations, shape })
}

/// Adds the contacts of `columns` from `start` on, times `weights`, whose number must be a multiple of [`MOST`].
pub(crate) fn accumulate_columns(
    columns: &ContactColumns,
    start: usize,
    weights: &[f64],
    accumulator: &mut Accumulator,
) {
    run(AccumulateColumns { columns, start, weights, accumulator });
}

struct Accumulate<'a, A> {
    contact: A,
    asperities: Asperities<'a>,
    separation: f64,
    accumulator: &'a mut Accumulator,
}

impl<A: LaneContacts> Work for Accumulate<'_, A> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { contact, asperities, separation, accumulator } = self;
        let (heights, radii) = (asperities.heights(), asperities.radii());
        let lanes = match asperities.spheres() {
            None => accumulate_lanes::<N, A, false>(contact, zero, separation, [heights, radii, radii]),
            Some(spheres) => {
                accumulate_lanes::<N, A, true>(contact, zero, separation, [heights, radii, spheres])
            }
        };
        accumulator.merge(&lanes);
    }
}

/// The last numbers of `values`, one per lane, preceded by copies of the first if there are too plain.
#[inline(always)]
fn last<N: Real>(values: &[f64], zero: N) -> N {
    if let Some(first) = values.len().checked_sub(N::LANES) {
        return zero.load(&values[first..]);
    }
    let mut lanes = [values[0]; MOST];
    lanes[N::LANES - values.len()..N::LANES].copy_from_slice(values);
    zero.load(&lanes)
}

/// Indentations, radii and numbers of spheres of the asperities from `start` on, one per lane.
#[inline(always)]
fn registers<N: Real, const ELLIPSES: bool>(
    zero: N,
    separation: f64,
    [heights, radii, spheres]: [&[f64]; 3],
    start: usize,
) -> [N; 3] {
    // The compiler removes a multiplication by one.
    let n = if ELLIPSES { zero.load(&spheres[start..]) } else { zero.splat(1.0) };
    [zero.load(&heights[start..]) - separation, zero.load(&radii[start..]), n]
}

/// Adds the contacts of asperities, each a sphere or, with `ELLIPSES`, a number of equal spheres.
#[inline(always)]
fn accumulate_lanes<N: Real, A: LaneContacts, const ELLIPSES: bool>(
    contact: A,
    zero: N,
    separation: f64,
    asperities: [&[f64]; 3],
) -> ContactSums<Sum<N>> {
    let [heights, radii, spheres] = asperities;
    let count = heights.len();
    let whole = count - count % N::LANES;
    let mut lanes = ContactSums::new(Sum::new(zero));
    let mut largest_load = zero;
    if whole > 0 {
        let [w, radius, n] = registers::<N, ELLIPSES>(zero, separation, asperities, 0);
        let mut local = [contact.local(w, radius, n); PLAIN_TERMS];
        for first in (0..whole).step_by(PLAIN_TERMS * N::LANES) {
            let starts = || (first..whole).step_by(N::LANES);
            for (local, start) in local.iter_mut().zip(starts()) {
                let [w, radius, n] = registers::<N, ELLIPSES>(zero, separation, asperities, start);
                *local = contact.local(w, radius, n);
            }
            let mut plain = ContactSums::new(zero);
            for (local, start) in local.iter().zip(starts()) {
                let [w, radius, n] = registers::<N, ELLIPSES>(zero, separation, asperities, start);
                let contacts = contact.contacts(w, radius, n, local);
                plain.add(&contacts, small_strain_area(radius, n));
                largest_load = larger(largest_load, contacts.load);
            }
            lanes.merge(&plain);
        }
    }
    if whole < count {
        // Lanes before the rest hold asperities already added.
        let rest = zero.lanes_from(N::LANES - (count - whole));
        let n = if ELLIPSES { last(spheres, zero) } else { zero.splat(1.0) };
        let (w, radius) = (last(heights, zero) - separation, last(radii, zero));
        let contacts = contact.contacts(w, radius, n, &contact.local(w, radius, n));
        let loads = lanes.add_present(&contacts, small_strain_area(radius, n), rest);
        largest_load = larger(largest_load, loads);
    }
    lanes.with_largest_load(largest_load)
}

/// The lane-wise maximum.
#[inline(always)]
fn larger<N: Real>(a: N, b: N) -> N {
    N::select(a.lt(b), b, a)
}

struct AccumulateWeighted<'a, A> {
    contact: A,
    indentations: &'a [f64],
    weights: &'a [f64],
    shape: Shape,
    accumulator: &'a mut Accumulator,
}

impl<A: LaneContacts> Work for AccumulateWeighted<'_, A> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { contact, indentations, weights, shape, accumulator } = self;
        let (radius, spheres) = (zero.splat(shape.radius), zero.splat(shape.spheres));
        let whole = indentations.len() - indentations.len() % N::LANES;
        let mut lanes = ContactSums::new(Sum::new(zero));
        if whole > 0 {
            let mut local = [contact.local(zero.load(indentations), radius, spheres); PLAIN_TERMS];
            for first in (0..whole).step_by(PLAIN_TERMS * N::LANES) {
                let starts = || (first..whole).step_by(N::LANES);
                for (local, start) in local.iter_mut().zip(starts()) {
                    *local = contact.local(zero.load(&indentations[start..]), radius, spheres);
                }
                let mut plain = ContactSums::new(zero);
                for (local, start) in local.iter().zip(starts()) {
                    let w = zero.load(&indentations[start..]);
                    lanes.accumulate_weighted(
                        &mut plain,
                        &contact.contacts(w, radius, spheres, local),
                        zero.load(&weights[start..]),
                    );
                }
                lanes.merge_weighted(&plain);
            }
        }
        if whole < indentations.len() {
            let rest = zero.lanes_from(N::LANES - (indentations.len() - whole));
            let w = last(indentations, zero);
            let contacts = contact.contacts(w, radius, spheres, &contact.local(w, radius, spheres));
            let mut plain = ContactSums::new(zero);
            lanes.accumulate_weighted(&mut plain, &contacts, N::select(rest, last(weights, zero), zero));
            lanes.merge_weighted(&plain);
        }
        accumulator.merge(&lanes);
    }
}

struct EachContact<'a, A> {
    contact: A,
    indentations: &'a [f64],
    shape: Shape,
}

impl<A: LaneContacts> Work for EachContact<'_, A> {
    type Output = ContactColumns;

    #[inline(always)]
    fn with<N: Real>(self, zero: N) -> ContactColumns {
        let Self { contact, indentations, shape: Shape { radius, spheres } } = self;
        let (radii, counts) = (zero.splat(radius), zero.splat(spheres));
        let mut columns = ContactColumns::default();
        let registers = indentations.chunks_exact(N::LANES);
        let rest = registers.remainder();
        for w in registers {
            let w = zero.load(w);
            columns.extend(&contact.contacts(w, radii, counts, &contact.local(w, radii, counts)));
        }
        for &w in rest {
            columns.extend(&contact.contacts(w, radius, spheres, &contact.local(w, radius, spheres)));
        }
        columns
    }
}

struct AccumulateColumns<'a> {
    columns: &'a ContactColumns,
    start: usize,
    weights: &'a [f64],
    accumulator: &'a mut Accumulator,
}

impl Work for AccumulateColumns<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { columns, start, weights, accumulator } = self;
        let mut lanes = ContactSums::new(Sum::new(zero));
        for first in (0..weights.len()).step_by(PLAIN_TERMS * N::LANES) {
            let mut plain = ContactSums::new(zero);
            let end = weights.len().min(first + PLAIN_TERMS * N::LANES);
            for k in (first..end).step_by(N::LANES) {
                let contacts = columns.load(start + k, zero);
                lanes.accumulate_weighted(&mut plain, &contacts, zero.load(&weights[k..]));
            }
            lanes.merge_weighted(&plain);
        }
        accumulator.merge(&lanes);
    }
}
