//! Sums that do not depend on the number of threads and lose nothing to rounding.

use rayon::prelude::*;

use super::lanes::{MOST, Real};

/// How many terms one task adds. Fixed, so that a result does not depend on the thread count.
pub const CHUNK: usize = 4096;

/// A compensated sum: the rounding error of every addition is kept (Knuth's TwoSum, The Art of
/// Computer Programming 2, section 4.2.2, theorem B), so the result is the exact sum of its terms
/// to within a few ulp whatever their number.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    /// Adds one term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        let sum = self.high + term;
        let shadow = sum - self.high;
        self.low += (self.high - (sum - shadow)) + (term - shadow);
        self.high = sum;
    }

    /// Adds the sum of another part.
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        self.add(other.high);
        self.low += other.low;
    }

    /// The rounded total.
    #[inline]
    pub fn value(&self) -> f64 {
        self.high + self.low
    }
}

/// Sums as [`Sum`], side by side.
#[derive(Debug, Clone, Copy)]
pub struct Sums<N> {
    high: N,
    low: N,
}

impl<N: Real> Sums<N> {
    /// Sums of nothing, with the lanes of `zero`.
    #[inline(always)]
    pub fn new(zero: N) -> Self {
        Self { high: zero, low: zero }
    }

    /// Adds one term in each lane.
    #[inline(always)]
    pub fn add(&mut self, term: N) {
        let sum = self.high + term;
        let shadow = sum - self.high;
        self.low = self.low + ((self.high - (sum - shadow)) + (term - shadow));
        self.high = sum;
    }
}

/// One sum in as many parts as any machine has lanes, so that sums side by side need not be added up before a total is
/// asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LaneSum {
    high: [f64; MOST],
    low: [f64; MOST],
}

impl LaneSum {
    /// Adds one term.
    #[inline]
    pub fn add(&mut self, term: f64) {
        let mut sum = Sum { high: self.high[0], low: self.low[0] };
        sum.add(term);
        (self.high[0], self.low[0]) = (sum.high, sum.low);
    }

    /// Adds sums side by side, each to a part of its own.
    #[inline(always)]
    pub fn add_lanes<N: Real>(&mut self, sums: &Sums<N>) {
        let mut total = Sums { high: sums.high.load(&self.high), low: sums.low.load(&self.low) };
        total.add(sums.high);
        (total.low + sums.low).store(&mut self.low);
        total.high.store(&mut self.high);
    }

    /// The sum of all parts.
    pub fn total(&self) -> Sum {
        let mut parts = *self;
        let mut count = MOST;
        while count > 1 {
            // In halves, so that no addition waits for the one before.
            count /= 2;
            for k in 0..count {
                let mut sum = Sum { high: parts.high[k], low: parts.low[k] };
                sum.merge(&Sum { high: parts.high[k + count], low: parts.low[k + count] });
                (parts.high[k], parts.low[k]) = (sum.high, sum.low);
            }
        }
        Sum { high: parts.high[0], low: parts.low[0] }
    }
}

impl FromIterator<f64> for Sum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::default();
        terms.into_iter().for_each(|term| sum.add(term));
        sum
    }
}

/// Folds the index range `0..count` in parallel: `part` answers a chunk, `join` adds a chunk's
/// answer to the running one. Chunks are fixed and joined in order, so the result is the same to
/// the bit on any number of threads.
pub fn in_chunks<T: Default + Send>(
    count: usize,
    part: impl Fn(std::ops::Range<usize>) -> T + Sync,
    mut join: impl FnMut(&mut T, &T),
) -> T {
    let chunk = |k: usize| part(k * CHUNK..count.min((k + 1) * CHUNK));
    let mut total = T::default();
    let chunks = count.div_ceil(CHUNK);
    if chunks == 1 {
        join(&mut total, &chunk(0));
        return total;
    }
    let parts: Vec<T> = (0..chunks).into_par_iter().map(chunk).collect();
    parts.iter().for_each(|answer| join(&mut total, answer));
    total
}

/// Parallel compensated sum of `term(i)` for i in `0..count`.
pub fn sum_of(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    in_chunks(count, |range| range.map(&term).collect::<Sum>(), |total, part| total.merge(part)).value()
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

    #[test]
    fn a_million_equal_terms_are_exact() {
        let total = sum_of(1_000_000, |_| 0.1);
        assert_eq!(total, 0.1 * 1e6);
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
