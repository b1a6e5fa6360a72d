//! Sampling error of the difference between both models: a jackknife over groups of asperities.
//!
//! | module | content |
//! |---|---|
//! | `division` | groups of asperities: blocks of a map, or groups of independent draws |
//! | `jackknife` | standard error from estimates with each group left out; Student's quantiles |

mod division;
mod jackknife;

pub use division::{Division, GROUPS};
pub use jackknife::{jackknife_error, jackknife_quantile, student_quantile};
