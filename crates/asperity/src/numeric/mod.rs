//! Numerical tools: quadrature, root search, reproducible sums, tabulated functions, vector registers.

pub(crate) mod condensed;
pub(crate) mod interval;
pub mod lanes;
pub(crate) mod levels;
mod order;
pub(crate) mod parallel;
pub(crate) mod power;
pub mod quadrature;
pub(crate) mod root;
pub(crate) mod stored;
mod stream;
pub(crate) mod sum;
pub(crate) mod table;

pub use interval::Interval;
pub use order::{decades, extremes, median};
pub use stream::stream_seed;
pub use sum::{Sum, in_chunks};

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
