//! Coverage of 95 % intervals: how often the interval that one map gives holds the mean over many maps of one process.
//!
//! | file | content |
//! |---|---|
//! | `process` | windows of an endless rough surface, and the loads at which they are examined |
//! | `window` | both models on one window, with the intervals that the program claims |
//! | `count` | how often intervals hold the truth |
//! | `studied` | fitness checks and verdicts of one window under other treatments of it, as of a measured map |
//! | `verdicts` | how often verdicts decide, and are wrong |
//! | `checks` | how often fitness checks find faults where there are none |
//! | `spiked` | windows with spikes planted in them |
//! | `patches` | roughness whose amplitude varies from place to place |

mod checks;
mod count;
mod patches;
mod process;
mod spiked;
mod studied;
mod verdicts;
mod window;

pub use checks::{CheckCount, upper_limit};
pub use count::{Coverage, IntervalCount};
pub use patches::Patches;
pub use process::{Controls, EndlessProcess, Roughness, SecondBody, Unusable};
pub use spiked::PlantedSpikes;
pub use studied::{SmallWindow, StudiedWindow, StudyTask};
pub use verdicts::{Truths, VerdictCount, WindowVerdict};
pub use window::{CoveredQuantity, QuantityEstimate, WindowResults, WindowTask};

use asperity::HeightMap;
use asperity::topography::fitness::Finding;
use rayon::prelude::*;
use studied::quick_findings;

/// Windows of one map.
pub const WINDOWS_PER_MAP: usize = 4;

/// A window that was examined.
#[derive(Debug, Clone)]
pub struct ExaminedWindow {
    /// Both models on it.
    pub results: WindowResults,
    /// Its fitness checks: all where it was studied, those for spikes and line offsets where it was checked.
    pub findings: Vec<Finding>,
    /// Its verdicts under other treatments, where these were studied.
    pub studied: Option<Vec<WindowVerdict>>,
}

/// Which maps of a process are examined, and how many of them are studied.
#[derive(Debug, Clone, Copy)]
pub struct Maps {
    /// Maps.
    pub count: usize,
    /// The first maps are studied under other treatments, this many.
    pub studied: usize,
    /// The first maps are checked for spikes and line offsets, this many.
    pub checked: usize,
}

/// Results of all windows of some maps, in their order; `done` is called after each map.
///
/// # Errors
/// The first window on which the models cannot be run.
pub fn windows_of(
    process: &EndlessProcess,
    (task, study): (&WindowTask, &StudyTask),
    maps: Maps,
    done: impl Fn() + Sync,
) -> Result<Vec<ExaminedWindow>, Unusable> {
    let of_map = |map: usize| -> Result<Vec<ExaminedWindow>, Unusable> {
        let windows = process.windows_at_positions(&format!("map {map}"))?;
        // The windows of a map are neighbours: asperities are taken as independent in one of them only.
        let seed = |index: usize| (index == 0).then(|| process.seed(&format!("groups of map {map}")));
        let examine = |(index, positions): (usize, &Vec<HeightMap>)| -> Result<ExaminedWindow, Unusable> {
            let window = &positions[0];
            let results = task.run_at_positions(positions, seed(index))?;
            let studied = if map < maps.studied { Some(study.run(window)?) } else { None };
            let (findings, studied) = match studied {
                Some(studied) => (studied.findings, Some(studied.verdicts)),
                None if map < maps.checked => (quick_findings(window), None),
                None => (Vec::new(), None),
            };
            Ok(ExaminedWindow { results, findings, studied })
        };
        let results = windows.iter().enumerate().map(examine).collect();
        done();
        results
    };
    let windows: Result<Vec<Vec<ExaminedWindow>>, Unusable> =
        (0..maps.count).into_par_iter().map(of_map).collect();
    Ok(windows?.into_iter().flatten().collect())
}

/// Checks for spikes and line offsets of all windows of some `maps`; `done` is called after each map.
///
/// # Errors
/// A window that cannot be levelled.
pub fn checked_windows(
    process: &EndlessProcess,
    maps: std::ops::Range<usize>,
    done: impl Fn() + Sync,
) -> Result<Vec<Vec<Finding>>, Unusable> {
    let of_map = |map: usize| -> Result<Vec<Vec<Finding>>, Unusable> {
        let findings = process.windows(&format!("map {map}"))?.iter().map(quick_findings).collect();
        done();
        Ok(findings)
    };
    let findings: Result<Vec<Vec<Vec<Finding>>>, Unusable> = maps.into_par_iter().map(of_map).collect();
    Ok(findings?.into_iter().flatten().collect())
}

/// For each of the windows of `maps` maps that are used for nothing else, its study without spikes and with each of `planted`; `done` is called after
/// each map.
///
/// # Errors
/// The first window on which the models cannot be run.
pub fn spiked_windows(
    process: &EndlessProcess,
    study: &StudyTask,
    maps: usize,
    planted: &[PlantedSpikes],
    done: impl Fn() + Sync,
) -> Result<Vec<Vec<StudiedWindow>>, Unusable> {
    let of_map = |map: usize| -> Result<Vec<Vec<StudiedWindow>>, Unusable> {
        let name = format!("spiked map {map}");
        let windows = process.windows(&name)?;
        let of_window = |(index, window)| {
            let seed = process.seed(&format!("spikes of window {index} of {name}"));
            let spiked = planted.iter().map(|spikes| spikes.study(study, window, seed));
            std::iter::once(study.run(window)).chain(spiked).collect()
        };
        let results = windows.iter().enumerate().map(of_window).collect();
        done();
        results
    };
    let windows: Result<Vec<Vec<Vec<StudiedWindow>>>, Unusable> =
        (0..maps).into_par_iter().map(of_map).collect();
    Ok(windows?.into_iter().flatten().collect())
}
