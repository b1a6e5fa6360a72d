//! Which curves of a layered sphere are shown beside each other.

use asperity::sphere::Curve;
use asperity_plot::{Colour, Dash};

use super::run::LawCurves;

/// The curves that stand beside each other.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    Coated,
    Uncoated,
    AllLayer,
    Exact,
}

impl Shown {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coated => "coated",
            Self::Uncoated => "uncoated",
            Self::AllLayer => "all-layer",
            Self::Exact => "exact-elastic",
        }
    }

    pub fn colour(self) -> Colour {
        match self {
            Self::Coated => Colour::ElasticPlastic,
            Self::Uncoated => Colour::Series(0),
            Self::AllLayer => Colour::Series(3),
            Self::Exact => Colour::Series(2),
        }
    }

    pub fn dash(self) -> Dash {
        match self {
            Self::Coated | Self::Exact => Dash::Solid,
            Self::Uncoated => Dash::Dashed,
            Self::AllLayer => Dash::Dotted,
        }
    }

    /// Those of one law.
    pub fn of(law: &LawCurves) -> [(Self, &Curve); 3] {
        [(Self::Coated, &law.coated), (Self::Uncoated, &law.uncoated), (Self::AllLayer, &law.all_layer)]
    }
}
