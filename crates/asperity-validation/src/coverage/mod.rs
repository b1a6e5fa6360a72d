//! Coverage of 95 % intervals: how often the interval that one map gives holds the mean over many maps of one process.
//!
//! | file | content |
//! |---|---|
//! | `process` | windows of an endless rough surface, and the loads at which they are examined |
//! | `window` | both models on one window, with the intervals that the program claims |
//! | `count` | how often intervals hold the truth |

mod count;
mod process;
mod window;

pub use count::{Coverage, IntervalCount};
pub use process::{Controls, EndlessProcess, Unusable};
pub use window::{CoveredQuantity, QuantityEstimate, WindowResults, WindowTask};

use rayon::prelude::*;

/// Windows of one map.
pub const WINDOWS_PER_MAP: usize = 4;

/// Results of all windows of `maps` maps, in their order; `done` is called after each map.
///
/// # Errors
/// The first window on which the models cannot be run.
pub fn windows_of(
    process: &EndlessProcess,
    task: &WindowTask,
    maps: usize,
    done: impl Fn() + Sync,
) -> Result<Vec<WindowResults>, Unusable> {
    let of_map = |map: usize| -> Result<Vec<WindowResults>, Unusable> {
        let windows = process.windows(&format!("map {map}"))?;
        // The windows of a map are neighbours: asperities are taken as independent in one of them only.
        let seed = |index: usize| (index == 0).then(|| process.seed(&format!("groups of map {map}")));
        let results = windows.iter().enumerate().map(|(index, window)| task.run(window, seed(index)));
        let results = results.collect();
        done();
        results
    };
    let maps: Result<Vec<Vec<WindowResults>>, Unusable> = (0..maps).into_par_iter().map(of_map).collect();
    Ok(maps?.into_iter().flatten().collect())
}
