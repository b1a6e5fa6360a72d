//! Which curves of a layered sphere are compared.

use asperity::sphere::Curve;

use super::run::LawCurves;

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

    /// Those of one law.
    pub fn of(law: &LawCurves) -> [(Self, &Curve); 3] {
        [(Self::Coated, &law.coated), (Self::Uncoated, &law.uncoated), (Self::AllLayer, &law.all_layer)]
    }
}
