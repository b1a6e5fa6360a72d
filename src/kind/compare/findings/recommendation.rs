//! Which model to use on a surface.

use asperity::compare::Departure;

use crate::surface::Surface;

/// Which model to use.
#[derive(Debug, Clone, PartialEq)]
pub enum Recommendation {
    /// Neither: the numbers of the surface themselves are doubtful.
    Neither,
    /// Either: the difference is within sampling uncertainty.
    Either,
    /// The deterministic sum: the models differ beyond sampling uncertainty.
    Deterministic {
        /// In what the surface is not what the statistical model assumes.
        departures: Vec<Departure>,
    },
}

impl Recommendation {
    /// `is_significant`: whether the models differ beyond sampling uncertainty on `surface`.
    pub fn new(surface: &Surface, is_significant: bool) -> Self {
        if !surface.warnings.is_empty() {
            Self::Neither
        } else if is_significant {
            Self::Deterministic { departures: Departure::of(&surface.statistics) }
        } else {
            Self::Either
        }
    }
}
