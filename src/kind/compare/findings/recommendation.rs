//! Which model to use on a surface.

use asperity::compare::Departure;

use crate::surface::Surface;

/// Which model to use.
#[derive(Debug, Clone, PartialEq)]
pub enum Recommendation {
    /// Neither: the numbers of the surface themselves are doubtful.
    Neither,
    /// Either: the models differ by no more than chance.
    Either,
    /// The deterministic sum: the models differ by more than chance.
    Deterministic {
        /// In what the surface is not what the statistical model assumes.
        departures: Vec<Departure>,
    },
}

impl Recommendation {
    /// For a surface on which the models differ by more than chance, or not.
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
