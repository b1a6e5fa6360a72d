//! Compensated sums that do not depend on the number of threads.

use std::ops::AddAssign;

use super::lanes::{MOST, Real, Work, run};
use super::parallel;

/// Terms per task. Fixed, so that results do not depend on the number of threads.
pub const CHUNK: usize = 4096;

/// A compensated sum, or one per lane: the rounding error of each addition is kept (Knuth's TwoSum, The Art of Computer
/// Programming 2, section 4.2.2, theorem B), so that the result is within a few ulp of the exact sum for any number of
/// terms.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sum<N = f64> {
    high: N,
    low: N,
}

impl<N: Real> Sum<N> {
    /// An empty sum with the lanes of `zero`.
    #[inline(always)]
    pub fn new(zero: N) -> Self {
        Self { high: zero, low: zero }
    }
}

impl Sum {
    /// The rounded total.
    #[inline]
    pub fn value(&self) -> f64 {
        self.high + self.low
    }
}

impl<N: Real> AddAssign<N> for Sum<N> {
    #[inline(always)]
    fn add_assign(&mut self, term: N) {
        let sum = self.high + term;
        let shadow = sum - self.high;
        self.low = self.low + ((self.high - (sum - shadow)) + (term - shadow));
        self.high = sum;
    }
}

/// Adds the sum of another part.
impl<N: Real> AddAssign<Sum<N>> for Sum<N> {
    #[inline(always)]
    fn add_assign(&mut self, part: Self) {
        *self += part.high;
        self.low = self.low + part.low;
    }
}

/// A sum in as many parts as the widest register has lanes, which are added only for the total.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LaneSum {
    high: [f64; MOST],
    low: [f64; MOST],
}

impl LaneSum {
    /// The sum of all parts.
    pub fn total(&self) -> Sum {
        let mut parts = *self;
        let mut count = MOST;
        while count > 1 {
            // Pairwise, so that additions are independent.
            count /= 2;
            for k in 0..count {
                let mut sum = parts.part(k);
                sum += parts.part(k + count);
                (parts.high[k], parts.low[k]) = (sum.high, sum.low);
            }
        }
        parts.part(0)
    }

    #[inline(always)]
    fn part(&self, lane: usize) -> Sum {
        Sum { high: self.high[lane], low: self.low[lane] }
    }
}

impl AddAssign<f64> for LaneSum {
    #[inline]
    fn add_assign(&mut self, term: f64) {
        let mut first = self.part(0);
        first += term;
        (self.high[0], self.low[0]) = (first.high, first.low);
    }
}

/// Adds each lane to a separate part.
impl<N: Real> AddAssign<Sum<N>> for LaneSum {
    #[inline(always)]
    fn add_assign(&mut self, lanes: Sum<N>) {
        let mut total = Sum { high: lanes.high.load(&self.high), low: lanes.low.load(&self.low) };
        total += lanes;
        total.low.store(&mut self.low);
        total.high.store(&mut self.high);
    }
}

impl FromIterator<f64> for Sum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::default();
        terms.into_iter().for_each(|term| sum += term);
        sum
    }
}

/// Folds the index range `0..count` in parallel: `part` gives the result of a chunk, `join` adds it to the running
/// result. Chunks are fixed and joined in order, so that the result is bit-identical for any number of threads.
pub fn in_chunks<T: Default + Send + Sync>(
    count: usize,
    part: impl Fn(std::ops::Range<usize>) -> T + Sync,
    mut join: impl FnMut(&mut T, &T),
) -> T {
    let chunk = |k: usize| part(k * CHUNK..count.min((k + 1) * CHUNK));
    let mut total = T::default();
    parallel::map(count.div_ceil(CHUNK), chunk).iter().for_each(|answer| join(&mut total, answer));
    total
}

/// Parallel compensated sum of `term(i)` for i in `0..count`.
pub fn sum_of(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    in_chunks(count, |range| range.map(&term).collect::<Sum>(), |total, part| *total += *part).value()
}

/// The terms of K sums over the values of C columns, a register at a time. Implementations are `#[inline(always)]`.
pub(crate) trait Terms<const C: usize, const K: usize>: Copy + Sync {
    /// The terms of the values in each lane.
    fn of<N: Real>(self, values: [N; C]) -> [N; K];
}

/// Parallel compensated sums of terms over `columns` of equal length, several times as fast as [`sum_of`]: the same in registers of
/// any width.
pub(crate) fn sums_over<const C: usize, const K: usize>(
    columns: [&[f64]; C],
    terms: impl Terms<C, K>,
) -> [f64; K] {
    let of_chunk = |range: std::ops::Range<usize>| {
        Sums(run((InParts { columns: columns.map(|column| &column[range.clone()]), terms }, [(); K])))
    };
    let join = |total: &mut Sums<K>, part: &Sums<K>| {
        total.0.iter_mut().zip(part.0).for_each(|(total, part)| *total += part);
    };
    in_chunks(columns[0].len(), of_chunk, join).0.map(|sum| sum.value())
}

/// Sums of terms over `columns` of equal length, where the first term is a number, and how many these are: plain sums in [`MOST`] parts, the
/// same in registers of any width.
pub(crate) fn sums_of_present<const C: usize, const K: usize>(
    columns: [&[f64]; C],
    terms: impl Terms<C, K>,
) -> ([f64; K], usize) {
    run((Present { columns, terms }, [(); K]))
}

struct Present<'a, T, const C: usize> {
    columns: [&'a [f64]; C],
    terms: T,
}

impl<T: Terms<C, K>, const C: usize, const K: usize> Work for (Present<'_, T, C>, [(); K]) {
    type Output = ([f64; K], usize);

    #[inline(always)]
    fn with<N: Real>(self, zero: N) -> ([f64; K], usize) {
        let Present { columns, terms } = self.0;
        let (one, registers) = (zero.splat(1.0), MOST / N::LANES);
        let (mut sums, mut counts) = ([[zero; K]; MOST], [zero; MOST]);
        let count = columns[0].len();
        let whole = count - count % MOST;
        for start in (0..whole).step_by(MOST) {
            for (k, (sums, count)) in sums.iter_mut().zip(&mut counts).enumerate().take(registers) {
                let mut values = [zero; C];
                for (value, column) in values.iter_mut().zip(columns) {
                    *value = zero.load(&column[start + k * N::LANES..]);
                }
                let terms = terms.of(values);
                let is_there = terms[0].le(terms[0]);
                for (sum, term) in sums.iter_mut().zip(terms) {
                    *sum = *sum + N::select(is_there, term, zero);
                }
                *count = *count + N::select(is_there, one, zero);
            }
        }
        let mut parts = [[0.0; MOST]; K];
        let mut present = [0.0; MOST];
        for k in 0..registers {
            for (part, sum) in parts.iter_mut().zip(sums[k]) {
                sum.store(&mut part[k * N::LANES..]);
            }
            counts[k].store(&mut present[k * N::LANES..]);
        }
        for at in whole..count {
            let terms = terms.of(columns.map(|column| column[at]));
            if !terms[0].is_nan() {
                parts.iter_mut().zip(terms).for_each(|(part, term)| part[at - whole] += term);
                present[at - whole] += 1.0;
            }
        }
        (parts.map(|parts| parts.iter().sum()), present.iter().sum::<f64>() as usize)
    }
}

/// Sums side by side.
struct Sums<const K: usize>([Sum; K]);

impl<const K: usize> Default for Sums<K> {
    fn default() -> Self {
        Self([Sum::default(); K])
    }
}

/// The compensated sums of a chunk in [`PARTS`] parts, whose additions do not wait for each other.
struct InParts<'a, T, const C: usize> {
    columns: [&'a [f64]; C],
    terms: T,
}

/// Four of the widest registers.
const PARTS: usize = 4 * MOST;

impl<T: Terms<C, K>, const C: usize, const K: usize> Work for (InParts<'_, T, C>, [(); K]) {
    type Output = [Sum; K];

    #[inline(always)]
    fn with<N: Real>(self, zero: N) -> [Sum; K] {
        let InParts { columns, terms } = self.0;
        let mut parts = [[Sum::new(zero); K]; PARTS];
        let registers = PARTS / N::LANES;
        let count = columns[0].len();
        let whole = count - count % PARTS;
        for start in (0..whole).step_by(PARTS) {
            for (k, part) in parts[..registers].iter_mut().enumerate() {
                let at = start + k * N::LANES;
                let values = columns.map(|column| zero.load(&column[at..]));
                part.iter_mut().zip(terms.of(values)).for_each(|(sum, term)| *sum += term);
            }
        }
        std::array::from_fn(|term| {
            let (mut high, mut low) = ([0.0; PARTS], [0.0; PARTS]);
            for (k, part) in parts[..registers].iter().enumerate() {
                part[term].high.store(&mut high[k * N::LANES..]);
                part[term].low.store(&mut low[k * N::LANES..]);
            }
            let mut total = Sum::default();
            for (&high, &low) in high.iter().zip(&low) {
                total += Sum { high, low };
            }
            for at in whole..count {
                total += terms.of(columns.map(|column| column[at]))[term];
            }
            total
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_what_a_plain_sum_loses() {
        let terms = [1.0, 1e100, 1.0, -1e100];
        assert_eq!(terms.iter().sum::<f64>(), 0.0);
        assert_eq!(terms.into_iter().collect::<Sum>().value(), 2.0);
    }

    #[derive(Clone, Copy)]
    struct SumAndSquare;

    impl Terms<2, 2> for SumAndSquare {
        #[inline(always)]
        fn of<N: Real>(self, [a, b]: [N; 2]) -> [N; 2] {
            [a + b, a * a]
        }
    }

    #[test]
    fn values_that_are_missing_do_not_count() {
        let at = |k: usize| if k % 5 == 1 { f64::NAN } else { k as f64 };
        for count in [0, 1, 7, 8, 9, 1003] {
            let values: Vec<f64> = (0..count).map(at).collect();
            let others: Vec<f64> = (0..count).map(|k| if k % 7 == 3 { f64::NAN } else { 1.0 }).collect();
            let found = sums_of_present([&values, &others], SumAndSquare);
            let present: Vec<f64> =
                (0..count).filter(|k| k % 5 != 1 && k % 7 != 3).map(|k| k as f64).collect();
            let expected =
                [|x: f64| x + 1.0, |x: f64| x * x].map(|of| present.iter().map(|&x| of(x)).sum::<f64>());
            assert_eq!(found, (expected, present.len()));
        }
    }

    #[test]
    fn a_million_equal_terms_are_exact() {
        let total = sum_of(1_000_000, |_| 0.1);
        assert_eq!(total, 0.1 * 1e6);
    }

    #[derive(Clone, Copy)]
    struct Square;

    impl Terms<2, 2> for Square {
        #[inline(always)]
        fn of<N: Real>(self, [x, y]: [N; 2]) -> [N; 2] {
            [x * x, x * y]
        }
    }

    #[test]
    fn parts_give_the_sum() {
        for count in [0, 1, 7, 8, 9, 4096, 4097, 100_003] {
            let values: Vec<f64> = (0..count).map(|i| f64::from(i).sin() * 10f64.powi(i % 17)).collect();
            let others: Vec<f64> = values.iter().rev().copied().collect();
            let [square, product] = sums_over([&values, &others], Square);
            let plain = sum_of(values.len(), |i| values[i] * values[i]);
            assert!((square - plain).abs() <= f64::EPSILON * plain, "{count}: {square} {plain}");
            let plain = sum_of(values.len(), |i| values[i] * others[i]);
            assert!((product - plain).abs() <= 2.0 * f64::EPSILON * square, "{count}: {product} {plain}");
        }
    }

    #[test]
    fn does_not_depend_on_threads() {
        let term = |i: usize| ((i as f64) * 0.7).sin() * 10f64.powi((i % 17) as i32);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| sum_of(100_003, term)).to_bits()
        };
        assert!((2..9).all(|threads| on(threads) == on(1)));
    }
}
