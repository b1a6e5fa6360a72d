//! Interval arithmetic.

use std::ops::{Add, Mul, Neg, Sub};

use pulp::Arch;

use super::parallel;

/// The closed interval from `low` to `high`. Results of arithmetic contain all results of their operands, up to
/// rounding of the ends.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// The interval between two numbers in any order.
    pub fn between(a: f64, b: f64) -> Self {
        Self { low: a.min(b), high: a.max(b) }
    }

    /// The smallest interval that contains all `values`, of which there must be at least one; many on all threads.
    pub fn new(values: &[f64]) -> Self {
        /// Values per task.
        const TASK: usize = 1 << 15;
        if values.len() < 2 * TASK {
            return Self::of_some(values);
        }
        let tasks: Vec<&[f64]> = values.chunks(TASK).collect();
        let parts = parallel::map(tasks.len(), |k| Self::of_some(tasks[k]));
        parts.into_iter().reduce(Self::hull).unwrap_or_default()
    }

    fn of_some(values: &[f64]) -> Self {
        /// Written to be vectorised by the compiler, which it does for comparisons, not for `f64::min`.
        const LANES: usize = 16;
        let (whole, rest) = values.as_chunks::<LANES>();
        let mut parts = rest.iter().map(|&x| Self::point(x)).reduce(Self::hull);
        if let Some(&first) = whole.first() {
            let (mut low, mut high) = (first, first);
            let ends = (&mut low, &mut high);
            Arch::new().dispatch(move || {
                let (low, high) = ends;
                for some in whole {
                    for k in 0..LANES {
                        low[k] = if some[k] < low[k] { some[k] } else { low[k] };
                        high[k] = if some[k] > high[k] { some[k] } else { high[k] };
                    }
                }
            });
            let lanes = low.into_iter().zip(high).map(|(low, high)| Self { low, high });
            parts = lanes.chain(parts).reduce(Self::hull);
        }
        parts.unwrap_or_default()
    }

    /// The union of intervals sorted by their lower ends, with overlapping or touching ones merged.
    pub fn union(ranges: impl IntoIterator<Item = Self>) -> Vec<Self> {
        let mut apart: Vec<Self> = Vec::new();
        for range in ranges {
            match apart.last_mut() {
                Some(last) if range.low <= last.high => *last = last.hull(range),
                _ => apart.push(range),
            }
        }
        apart
    }

    /// The interval of one number.
    pub fn point(x: f64) -> Self {
        Self { low: x, high: x }
    }

    /// Whether the interval contains `x`.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// Whether the intervals overlap.
    pub fn overlaps(self, other: Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// The smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The range of 1/x; `self` must be positive.
    pub fn recip(self) -> Self {
        Self { low: self.high.recip(), high: self.low.recip() }
    }

    /// The range of ln x; `self` must not be negative.
    pub fn ln(self) -> Self {
        Self { low: self.low.ln(), high: self.high.ln() }
    }

    /// The range of a function that increases up to `peak` and decreases beyond it.
    pub fn of_unimodal(self, value: impl Fn(f64) -> f64, peak: f64) -> Self {
        let ends = Self::between(value(self.low), value(self.high));
        if self.contains(peak) { ends.hull(Self::point(value(peak))) } else { ends }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let corners = [self.low, self.high].map(|a| [a * other.low, a * other.high]);
        let corners = corners.as_flattened();
        Self {
            low: corners.iter().copied().fold(f64::INFINITY, f64::min),
            high: corners.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

impl Add<f64> for Interval {
    type Output = Self;

    fn add(self, x: f64) -> Self {
        self + Self::point(x)
    }
}

impl Mul<f64> for Interval {
    type Output = Self;

    fn mul(self, x: f64) -> Self {
        self * Self::point(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lowest and the highest number at each place that is treated differently: within and behind whole registers and tasks.
    #[test]
    fn the_smallest_interval_of_many_numbers() {
        for count in [1_usize, 15, 16, 17, 1003, 65_535, 65_536, 100_003] {
            for (lowest, highest) in [(0, count - 1), (count - 1, 0), (count / 2, count / 3)] {
                let mut values: Vec<f64> = (0..count).map(|k| ((k * 7919) % 1009) as f64).collect();
                values[lowest] = -5.0;
                values[highest] = 2000.0;
                let low = if lowest == highest { 2000.0 } else { -5.0 };
                assert_eq!(Interval::new(&values), Interval { low, high: 2000.0 }, "{count}");
            }
        }
        assert_eq!(Interval::new(&[]), Interval::default());
    }

    #[test]
    fn holds_what_its_numbers_give() {
        let (a, b) = (Interval { low: -2.0, high: 3.0 }, Interval { low: -5.0, high: 1.0 });
        assert_eq!(a + b, Interval { low: -7.0, high: 4.0 });
        assert_eq!(a - b, Interval { low: -3.0, high: 8.0 });
        assert_eq!(a * b, Interval { low: -15.0, high: 10.0 });
        assert_eq!(a * -2.0, Interval { low: -6.0, high: 4.0 });
        assert_eq!(Interval::between(4.0, 2.0).recip(), Interval { low: 0.25, high: 0.5 });
        assert_eq!(a.hull(b), Interval { low: -5.0, high: 3.0 });
    }

    #[test]
    fn ranges_that_touch_are_one() {
        let range = |low, high| Interval { low, high };
        let union = Interval::union([range(0.0, 2.0), range(1.0, 1.5), range(2.0, 3.0), range(4.0, 5.0)]);
        assert_eq!(union, [range(0.0, 3.0), range(4.0, 5.0)]);
        assert!(union[0].overlaps(range(3.0, 3.5)) && !union[0].overlaps(union[1]));
    }

    #[test]
    fn a_hump_is_highest_at_its_peak() {
        let hump = |x: f64| -(x - 1.0).powi(2);
        assert_eq!(
            Interval { low: 0.0, high: 3.0 }.of_unimodal(hump, 1.0),
            Interval { low: -4.0, high: 0.0 }
        );
        assert_eq!(
            Interval { low: 2.0, high: 3.0 }.of_unimodal(hump, 1.0),
            Interval { low: -4.0, high: -1.0 }
        );
    }
}
