//! The asperities of a rough surface.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use pulp::Arch;
use rayon::prelude::*;

use super::by_height::means_above;
use super::{Asperities, ByHeight, Ellipse, RadiiAbove};
use crate::distribution::{EqualHeights, Heights, Smoothed};
use crate::memory::collected;
use crate::numeric::interval::Interval;
use crate::numeric::parallel::once;
use crate::numeric::{LARGEST, is_positive};

/// The asperities of a rough surface, as a struct of arrays in the order of their origin.
#[derive(Debug, Clone)]
pub struct AsperitySet {
    source: Source,
    nominal_area: f64,
    found: Arc<Found>,
}

/// What follows from a set, found when it is first asked for.
#[derive(Debug, Default)]
struct Found {
    by_height: OnceLock<ByHeight>,
    means_above: OnceLock<Vec<f64>>,
    smoothed: OnceLock<Result<Heights, EqualHeights>>,
}

/// Where the columns of a set are from.
#[derive(Debug, Clone)]
enum Source {
    /// They are there.
    Own(Arc<Columns>),
    /// All but some of another set, copied when they are first looked at: often the number of asperities is enough.
    Rest { all: Arc<Columns>, of_all: Arc<Found>, left_out: Places, columns: Arc<OnceLock<Columns>> },
}

/// Different places in a set: a part of a list.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    pub(crate) list: Arc<Vec<usize>>,
    pub(crate) part: Range<usize>,
}

impl Places {
    pub(crate) fn as_slice(&self) -> &[usize] {
        &self.list[self.part.clone()]
    }
}

#[derive(Debug, Clone, PartialEq)]
struct Columns {
    heights: Vec<f64>,
    radii: Vec<f64>,
    ellipses: Option<Vec<Ellipse>>,
}

impl Columns {
    /// Those of all asperities but some at different places.
    fn excluding(&self, places: &[usize]) -> Self {
        let mut stays = vec![true; self.heights.len()];
        places.iter().for_each(|&place| stays[place] = false);
        Self {
            heights: of_those(&self.heights, &stays),
            radii: of_those(&self.radii, &stays),
            ellipses: self.ellipses.as_ref().map(|all| of_those(all, &stays)),
        }
    }
}

/// The values of those that stay.
fn of_those<T: Copy>(values: &[T], stays: &[bool]) -> Vec<T> {
    values.iter().zip(stays).filter(|(_, stays)| **stays).map(|(value, _)| *value).collect()
}

impl PartialEq for AsperitySet {
    fn eq(&self, other: &Self) -> bool {
        self.nominal_area == other.nominal_area && self.columns() == other.columns()
    }
}

/// Values that form no valid set.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum SetError {
    /// There must be at least one asperity.
    #[error("no asperity")]
    Empty,
    /// There must be as many heights as radii.
    #[error("{heights} heights but {radii} radii")]
    Lengths { heights: usize, radii: usize },
    /// There must be as many heights as ellipses.
    #[error("{heights} heights but {ellipses} ellipses")]
    Ellipses { heights: usize, ellipses: usize },
    /// Heights must be finite.
    #[error("asperity {index}: height {height} m; allowed: a finite number")]
    Height { index: usize, height: f64 },
    /// Radii must be positive and finite.
    #[error("asperity {index}: radius {radius} m; allowed: positive and finite")]
    Radius { index: usize, radius: f64 },
    /// The nominal area must be positive and finite.
    #[error("nominal area {0} m^2; allowed: positive and finite")]
    NominalArea(f64),
}

impl SetError {
    /// Checks heights, radii and area as [`AsperitySet::new`] does.
    pub(crate) fn check(heights: &[f64], radii: &[f64], nominal_area: f64) -> Result<(), Self> {
        if heights.len() != radii.len() {
            return Err(Self::Lengths { heights: heights.len(), radii: radii.len() });
        }
        if heights.is_empty() {
            return Err(Self::Empty);
        }
        let is_height = |z: f64| z.abs() <= LARGEST;
        if let Some(index) = first_without(heights, is_height) {
            return Err(Self::Height { index, height: heights[index] });
        }
        if let Some(index) = first_without(radii, is_positive) {
            return Err(Self::Radius { index, radius: radii[index] });
        }
        if !is_positive(nominal_area) {
            return Err(Self::NominalArea(nominal_area));
        }
        Ok(())
    }
}

/// Values checked at a time.
const BLOCK: usize = 4096;

/// The index of the first value that is not valid; whole blocks are checked without a branch per value.
fn first_without(values: &[f64], is_admissible: impl Fn(f64) -> bool + Sync) -> Option<usize> {
    let arch = Arch::new();
    let is_whole =
        |block: &[f64]| arch.dispatch(|| block.iter().fold(true, |all, &value| all & is_admissible(value)));
    let bad = values.par_chunks(BLOCK).position_first(|block| !is_whole(block))?;
    let first = values[bad * BLOCK..].iter().position(|&value| !is_admissible(value))?;
    Some(bad * BLOCK + first)
}

/// The height that is far from zero for all of `heights` to be stored relative to it; `None` where zero serves.
pub(super) fn far_origin(heights: &[f64]) -> Option<f64> {
    /// Four bits lost: what is nearer keeps its frame.
    const FAR: f64 = 16.0;
    let Interval { low, high } = Interval::new(heights);
    let is_near = low * high <= 0.0 || low.abs().min(high.abs()) <= FAR * (high - low);
    (!is_near).then_some(low)
}

impl AsperitySet {
    /// Asperities of the given heights and radii (m) on a nominal area (m^2).
    ///
    /// # Errors
    /// The first invalid value; see [`SetError`].
    pub fn new(heights: Vec<f64>, radii: Vec<f64>, nominal_area: f64) -> Result<Self, SetError> {
        SetError::check(&heights, &radii, nominal_area)?;
        Ok(Self::of_columns(Columns { heights, radii, ellipses: None }, nominal_area))
    }

    /// No asperities on a positive nominal area (m^2).
    pub(crate) fn none_on(nominal_area: f64) -> Self {
        Self::of_columns(Columns { heights: Vec::new(), radii: Vec::new(), ellipses: None }, nominal_area)
    }

    fn of_columns(columns: Columns, nominal_area: f64) -> Self {
        Self { source: Source::Own(Arc::new(columns)), nominal_area, found: Arc::default() }
    }

    fn columns(&self) -> &Columns {
        match &self.source {
            Source::Own(columns) => columns,
            Source::Rest { all, left_out, columns, .. } => {
                once(columns, || all.excluding(left_out.as_slice()))
            }
        }
    }

    fn into_columns(self) -> Columns {
        match self.source {
            Source::Own(columns) => Arc::unwrap_or_clone(columns),
            Source::Rest { .. } => self.columns().clone(),
        }
    }

    /// The same asperities with heights relative to an origin (m), which is returned, so that an offset costs no digits:
    /// one of the heights if all are further from zero than 16 times their range, else zero. The differences are exact.
    #[must_use]
    pub fn near_zero(self) -> (Self, f64) {
        let Some(origin) = far_origin(self.heights()) else { return (self, 0.0) };
        (self.relative_to(origin), origin)
    }

    /// The same asperities with heights relative to a height, m.
    #[must_use]
    pub fn relative_to(self, height: f64) -> Self {
        let nominal_area = self.nominal_area;
        let mut columns = self.into_columns();
        columns.heights.iter_mut().for_each(|z| *z -= height);
        Self::of_columns(columns, nominal_area)
    }

    /// Heights, m.
    pub fn heights(&self) -> &[f64] {
        &self.columns().heights
    }

    /// Radii, m.
    pub fn radii(&self) -> &[f64] {
        &self.columns().radii
    }

    /// The same set with an ellipse for each asperity, used instead of its sphere by laws for ellipses.
    ///
    /// # Errors
    /// A number of ellipses other than that of asperities.
    pub fn with_ellipses(self, ellipses: Vec<Ellipse>) -> Result<Self, SetError> {
        if ellipses.len() != self.count() {
            return Err(SetError::Ellipses { heights: self.count(), ellipses: ellipses.len() });
        }
        let nominal_area = self.nominal_area;
        Ok(Self::of_columns(Columns { ellipses: Some(ellipses), ..self.into_columns() }, nominal_area))
    }

    /// The ellipses, where they are known.
    pub fn ellipses(&self) -> Option<&[Ellipse]> {
        let (Source::Own(all) | Source::Rest { all, .. }) = &self.source;
        all.ellipses.as_ref()?;
        self.columns().ellipses.as_deref()
    }

    /// The asperities as spheres.
    pub fn spheres(&self) -> Asperities<'_> {
        Asperities::new(self.heights(), self.radii(), None, self.nominal_area)
    }

    /// The asperities in the order of their heights (m), sorted once: of the rest of a set from that of the whole where it is known.
    pub fn by_height(&self) -> &ByHeight {
        let of_whole = || match &self.source {
            Source::Own(_) => None,
            Source::Rest { of_all, left_out, .. } => {
                Some(of_all.by_height.get()?.without(left_out.as_slice()))
            }
        };
        once(&self.found.by_height, || of_whole().unwrap_or_else(|| ByHeight::new(self.heights())))
    }

    /// The mean radius of the asperities above a height.
    pub fn radii_above(&self) -> RadiiAbove<'_> {
        let by_height = self.by_height();
        let means = once(&self.found.means_above, || means_above(by_height, self.radii()));
        RadiiAbove::new(by_height, means)
    }

    /// The heights as a smoothed density.
    ///
    /// # Errors
    /// Heights that are all equal.
    pub fn smoothed_heights(&self) -> Result<Heights, EqualHeights> {
        let smoothed = || Smoothed::of_ascending(self.by_height().values()).map(Heights::new);
        once(&self.found.smoothed, smoothed).clone()
    }

    /// Number of asperities.
    pub fn count(&self) -> usize {
        match &self.source {
            Source::Own(columns) => columns.heights.len(),
            Source::Rest { all, left_out, .. } => all.heights.len() - left_out.part.len(),
        }
    }

    /// Nominal area, m^2.
    pub fn nominal_area(&self) -> f64 {
        self.nominal_area
    }

    /// All asperities but those at some places, on a positive nominal area (m^2); `None` if there is none.
    pub(crate) fn excluding(&self, left_out: Places, nominal_area: f64) -> Option<Self> {
        let all = match &self.source {
            Source::Own(columns) => columns.clone(),
            Source::Rest { .. } => Arc::new(self.columns().clone()),
        };
        let is_set = left_out.part.len() < self.count() && nominal_area > 0.0;
        let source = Source::Rest { all, of_all: self.found.clone(), left_out, columns: Arc::default() };
        is_set.then(|| Self { source, nominal_area, found: Arc::default() })
    }

    /// The asperities at some places, on a positive nominal area (m^2); `None` if there is none.
    pub(crate) fn selected(&self, places: &[usize], nominal_area: f64) -> Option<Self> {
        let column = |values: &[f64]| collected(places.par_iter().map(|&place| values[place]));
        let columns = || Columns {
            heights: column(self.heights()),
            radii: column(self.radii()),
            ellipses: self.ellipses().map(|all| places.iter().map(|&place| all[place]).collect()),
        };
        let is_set = !places.is_empty() && nominal_area > 0.0;
        is_set.then(|| Self::of_columns(columns(), nominal_area))
    }

    /// Asperities per nominal area, 1/m^2.
    pub fn density(&self) -> f64 {
        self.count() as f64 / self.nominal_area
    }
}
