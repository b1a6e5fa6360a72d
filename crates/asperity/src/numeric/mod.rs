//! Numerical tools that know no physics: quadrature, root search, sums in a fixed order, tables of functions.

pub(crate) mod interval;
pub mod lanes;
pub(crate) mod levels;
pub(crate) mod parallel;
pub(crate) mod power;
pub mod quadrature;
pub(crate) mod root;
pub(crate) mod stored;
pub(crate) mod sum;
pub(crate) mod table;

pub use interval::Interval;
pub use sum::{Sum, in_chunks};

/// The largest magnitude of any input: loads of such numbers, their squares
/// and sums neither overflow nor vanish.
pub const LARGEST: f64 = 1e30;

/// 2^52: the sum with a smaller number has the nearest whole number in its last bits.
pub(crate) const WHOLES: f64 = 4_503_599_627_370_496.0;

/// Whether `value` is positive and within a range in which no product overflows or vanishes.
pub fn is_positive(value: f64) -> bool {
    (1.0 / LARGEST..=LARGEST).contains(&value)
}
