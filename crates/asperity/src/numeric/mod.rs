//! Numerical tools: quadrature, root search, reproducible sums, tabulated functions, vector registers.

pub(crate) mod condensed;
pub(crate) mod interval;
pub mod lanes;
pub(crate) mod levels;
pub(crate) mod parallel;
pub(crate) mod power;
pub mod quadrature;
pub(crate) mod root;
pub(crate) mod sort;
pub(crate) mod stored;
pub(crate) mod sum;
pub(crate) mod table;

pub use interval::Interval;
pub use sort::{decades, extremes, median};
pub use sum::{Sum, in_chunks};

use sha2::{Digest, Sha256};

/// The largest magnitude of any input: loads computed from such numbers, their squares and sums neither overflow nor
/// underflow.
pub const LARGEST: f64 = 1e30;

/// 2^52: the sum with a smaller number has the nearest integer in its last bits.
pub(crate) const INTEGER_BIAS: f64 = 4_503_599_627_370_496.0;

/// Whether `value` is positive and within a range in which no product overflows or underflows.
#[inline]
pub fn is_positive(value: f64) -> bool {
    (1.0 / LARGEST..=LARGEST).contains(&value)
}

/// The nearest value with two significant digits; the value itself if it is not finite.
pub fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// The least value of two significant digits that is not below a positive one.
pub fn two_digits_up(value: f64) -> f64 {
    let nearest = two_digits(value);
    if nearest < value { two_digits(nearest + 10f64.powf(value.log10().floor() - 1.0)) } else { nearest }
}

/// The seed of one stream of random numbers: it depends on a seed and on what is drawn, not on what else is drawn.
pub fn stream_seed(seed: u64, what: &str) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(what);
    hash.finalize().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits_are_the_nearest_or_the_next_above() {
        assert_eq!([1.24e-6, 1.26e-6, 9.96, 0.0].map(two_digits), [1.2e-6, 1.3e-6, 10.0, 0.0]);
        assert_eq!([1.24e-6, 1.2e-6, 9.94, 9.96].map(two_digits_up), [1.3e-6, 1.2e-6, 10.0, 10.0]);
    }
}
