//! Interpolation between the responses of a model: polynomials of logarithms and shares.

use std::ops::Range;

use super::quantities::{Quantities, Row};
use crate::model::Response;
use crate::numeric::lanes::{Mask, Real, Work};

/// A response of the model and the quantities interpolated from it.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// Index among all separations, ascending.
    pub place: usize,
    /// The response of the model there.
    pub response: Response,
    /// The interpolated quantities.
    pub row: Row,
}

impl Node {
    /// A node from the response at `place`.
    pub fn new(place: usize, response: Response) -> Self {
        Self { place, response, row: Quantities::of(&response).into() }
    }

    /// The separation.
    fn x(&self) -> f64 {
        self.response.separation_over_sigma
    }
}

/// How the quantities that are interpolated as logarithms are returned.
#[derive(Clone, Copy, PartialEq)]
pub enum Scale {
    /// As logarithms.
    Logarithms,
    /// As the quantities themselves.
    Plain,
}

/// Newton polynomials through the nearest nodes (DLMF 3.3.38), one quantity per lane.
pub struct Interpolation<'a, G, F> {
    /// The nodes, ascending; at least one.
    pub known: &'a [Node],
    /// Number of nodes per polynomial, at most [`MOST_THROUGH`].
    pub through: usize,
    /// Number of entries of each row that are interpolated: those of an integral or of a sum.
    pub places: usize,
    /// All separations, ascending.
    pub separations: &'a [f64],
    /// Ranges of places between two nodes, ascending.
    pub gaps: G,
    /// How the quantities that are interpolated as logarithms are returned.
    pub scale: Scale,
    /// Called with each place of the gaps and its quantities.
    pub take: F,
}

impl<G: Iterator<Item = Range<usize>>, F: FnMut(usize, &Row)> Work for Interpolation<'_, G, F> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        /// Places evaluated together, to hide latency.
        const TOGETHER: usize = 48;
        const LOGARITHMS: usize = Row::LOGARITHMS;
        let Self { known, through, places, separations, gaps, scale, mut take } = self;
        let mut newton = Newton::new(known, through, places);
        let mut found = [Row::ZERO; TOGETHER];
        let mut logarithms = [0.0; LOGARITHMS * TOGETHER];
        let mut after = 0;
        for gap in gaps {
            while known.get(after).is_some_and(|node| node.place < gap.start) {
                after += 1;
            }
            newton.go_to(after, zero);
            for start in gap.clone().step_by(TOGETHER) {
                let these = start..gap.end.min(start + TOGETHER);
                let found = &mut found[..these.len()];
                newton.evaluate(&separations[these.clone()], found, zero);
                if scale == Scale::Plain {
                    let (used, unused) = logarithms.split_at_mut(LOGARITHMS * found.len());
                    for (row, logarithms) in found.iter().zip(used.chunks_exact_mut(LOGARITHMS)) {
                        logarithms.copy_from_slice(&row.0[..LOGARITHMS]);
                    }
                    // Unused lanes of the last register must stay in the range of the exponential.
                    unused.fill(0.0);
                    for lane in (0..LOGARITHMS * found.len()).step_by(N::LANES) {
                        exponential(zero.load(&logarithms[lane..])).store(&mut logarithms[lane..]);
                    }
                    for (row, plain) in found.iter_mut().zip(logarithms.chunks_exact(LOGARITHMS)) {
                        row.0[..LOGARITHMS].copy_from_slice(plain);
                    }
                }
                these.zip(&*found).for_each(|(place, row)| take(place, row));
            }
        }
    }
}

/// The largest number of nodes per polynomial.
pub const MOST_THROUGH: usize = 12;

/// A Newton polynomial through consecutive nodes, from the last of them.
struct Newton<'a> {
    known: &'a [Node],
    /// Number of nodes.
    through: usize,
    /// Number of entries of each row that are interpolated.
    places: usize,
    /// The node after its last.
    end: usize,
    /// Its nodes, from the last on.
    nodes: [f64; MOST_THROUGH],
    /// The divided differences of each order.
    differences: [Row; MOST_THROUGH],
}

impl<'a> Newton<'a> {
    fn new(known: &'a [Node], through: usize, places: usize) -> Self {
        let differences = [Row::ZERO; MOST_THROUGH];
        Self { known, through, places, end: 0, nodes: [0.0; MOST_THROUGH], differences }
    }

    /// Moves the polynomial to the gap below the node `after`, which must not be below the previous one.
    #[inline(always)]
    fn go_to<N: Real>(&mut self, after: usize, zero: N) {
        let end = (after + self.through.div_ceil(2)).clamp(self.through, self.known.len());
        while self.end < end {
            let node = &self.known[self.end];
            for lane in (0..self.places).step_by(N::LANES) {
                let mut difference = zero.load(&node.row.0[lane..]);
                for order in 0..self.through.min(self.end + 1) {
                    let shorter = zero.load(&self.differences[order].0[lane..]);
                    difference.store(&mut self.differences[order].0[lane..]);
                    difference = (difference - shorter) * (node.x() - self.nodes[order]).recip();
                }
            }
            self.nodes.copy_within(..MOST_THROUGH - 1, 1);
            self.nodes[0] = node.x();
            self.end += 1;
        }
    }

    /// The rows at `separations`.
    #[inline(always)]
    fn evaluate<N: Real>(&self, separations: &[f64], rows: &mut [Row], zero: N) {
        let (h, rest) = separations.as_chunks::<4>();
        let (of_h, of_rest) = rows[..separations.len()].as_chunks_mut::<4>();
        for (h, rows) in h.iter().zip(of_h) {
            self.evaluate_at(h, rows, zero);
        }
        for (&h, row) in rest.iter().zip(of_rest) {
            self.evaluate_at(&[h], std::array::from_mut(row), zero);
        }
    }

    /// The rows at `K` separations, evaluated together to hide latency.
    #[inline(always)]
    fn evaluate_at<N: Real, const K: usize>(&self, h: &[f64; K], rows: &mut [Row; K], zero: N) {
        for lane in (0..self.places).step_by(N::LANES) {
            let mut values = [zero; K];
            for (node, difference) in self.nodes.iter().zip(&self.differences).take(self.through).rev() {
                let difference = zero.load(&difference.0[lane..]);
                for (value, h) in values.iter_mut().zip(h) {
                    *value = value.mul_add(zero.splat(h - node), difference);
                }
            }
            for (value, row) in values.into_iter().zip(&mut *rows) {
                value.store(&mut row.0[lane..]);
            }
        }
    }
}

/// exp(x) for any x.
#[inline(always)]
fn exponential<N: Real>(x: N) -> N {
    /// The range of [`Real::exp`].
    const LARGEST: f64 = 700.0;
    let largest = x.splat(LARGEST);
    if (x.le(largest) & (-largest).le(x)).all() {
        return x.exp();
    }
    let [powers] = x.each(|x| [x.exp()]);
    powers
}
