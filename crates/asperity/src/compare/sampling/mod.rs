//! Sampling error of the difference between both models: a jackknife over groups of asperities.
//!
//! | module | content |
//! |---|---|
//! | `division` | groups of asperities: blocks of a map, or groups of independent draws |
//! | `one_step` | both models at equal load with a group left out |
//! | `jackknife` | standard error from estimates with each group left out, or from surfaces of a process fitted to the map; Student's quantiles |

mod division;
mod jackknife;
mod one_step;

pub use division::{Division, GROUPS};
pub use jackknife::{Generated, NotModelled, jackknife_error, jackknife_quantile, student_quantile};
pub use one_step::OneStep;
pub(super) use one_step::{moved, slopes, state};
