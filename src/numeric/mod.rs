//! Numerical tools that know no physics: quadrature, root search, sums in a fixed order.

pub mod quadrature;
pub mod root;
pub mod sum;

pub use sum::Sum;
