//! How far a run of a comparison goes, for a program that shows results as they come.

use std::sync::{Mutex, PoisonError};

use asperity::compare::{CaseSampling, Controls};
use indexmap::IndexMap;

use crate::surface::{SurfacePlan, SurfaceStore};

/// How far a run goes; a longer one repeats the shorter ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Extent {
    /// Both models at some of the loads on the first realisation, without intervals and what follows from them.
    Models,
    /// With intervals, causes and other statistical models, on all realisations.
    Intervals,
    /// With other treatments of maps and the reference.
    #[default]
    Everything,
}

/// What a run does, and what it takes from earlier ones.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    pub extent: Extent,
    pub store: Option<&'a dyn SurfaceStore>,
    /// Sampling errors that a shorter run of the same spec has found.
    pub samplings: Option<&'a Samplings>,
    /// The most cases of which each has a picture of its contacts.
    pub pictures: usize,
}

/// Loads at which contacts are drawn, beside the reported one; fewer where the models alone are run.
const LOADS_OF_PICTURES: [usize; 2] = [3, 16];

/// The sampling errors of the cases of each surface, between the runs of one spec.
#[derive(Default)]
pub struct Samplings(Mutex<IndexMap<String, Vec<CaseSampling>>>);

impl Samplings {
    /// Those of a surface, or what `find` finds, which is kept.
    pub(super) fn of(&self, surface: &str, find: impl FnOnce() -> Vec<CaseSampling>) -> Vec<CaseSampling> {
        let all = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all().get(surface).cloned();
        known.unwrap_or_else(|| {
            let found = find();
            all().insert(surface.to_owned(), found.clone());
            found
        })
    }
}

impl Default for Scope<'_> {
    /// A whole run by itself; of one case there is a picture.
    fn default() -> Self {
        Self { extent: Extent::Everything, store: None, samplings: None, pictures: 1 }
    }
}

impl Scope<'_> {
    pub(super) fn has_intervals(self) -> bool {
        self.extent >= Extent::Intervals
    }

    /// Loads at which contacts are drawn, beside the reported one.
    pub(super) fn loads_of_pictures(self) -> usize {
        LOADS_OF_PICTURES[usize::from(self.has_intervals())]
    }

    pub(super) fn has_everything(self) -> bool {
        self.extent == Extent::Everything
    }

    pub(super) fn realisations(self, surface: &SurfacePlan) -> usize {
        if self.has_intervals() { surface.realisations } else { 1 }
    }
}

/// At most so many points of a sweep where the models alone are run.
const FEW: usize = 11;

/// At most [`FEW`] points of each sweep, its ends among them.
pub fn thinned(controls: &Controls) -> Controls {
    let few = |values: &[f64]| match values.len() {
        0..=FEW => values.to_vec(),
        count => (0..FEW).map(|k| values[k * (count - 1) / (FEW - 1)]).collect(),
    };
    let Controls { separations, pressures, forces } = controls;
    Controls { separations: few(separations), pressures: few(pressures), forces: few(forces) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_sweep_has_its_ends_and_no_point_of_its_own() {
        let long: Vec<f64> = (0..61).map(f64::from).collect();
        let thin = thinned(&Controls { separations: vec![3.0, 2.0], ..Controls::at_pressures(long.clone()) });
        assert_eq!((thin.separations, thin.pressures.len()), (vec![3.0, 2.0], FEW));
        assert_eq!((thin.pressures[0], thin.pressures[FEW - 1]), (0.0, 60.0));
        assert!(
            thin.pressures.is_sorted_by(|a, b| a < b) && thin.pressures.iter().all(|one| long.contains(one))
        );
    }
}
