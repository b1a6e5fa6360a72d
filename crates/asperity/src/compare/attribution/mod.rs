//! Why both models differ at equal load: the gap divided among its causes.
//!
//! Between the statistical model (one height density, one mean radius) and the deterministic one (every asperity with
//! its own height and radius) lie states that each change one thing:
//!
//! | state | heights | radii |
//! |---|---|---|
//! | statistical | density | mean radius |
//! | own heights | own | mean radius |
//! | own radii | density | own, independent of the heights |
//! | independent | own | own, independent of the heights |
//! | paired by rank | quantiles of the density, in the order of the own heights | own |
//! | deterministic | own | own |
//!
//! Three orders lead from the first to the last, since a correlation needs a spread of radii. In each, the differences
//! from one state to the next add up to the gap; the contribution of a cause is the mean over the orders, and its interval holds those
//! of all orders. What the radii contribute is their spread and their correlation with the heights together; how much of it the spread
//! has depends on which mean radius the statistical model takes.
//!
//! | module | content |
//! |---|---|
//! | `contribution` | what a cause contributes, with its interval; which cause leads |
//! | `states` | the models of the states |
//! | `at_loads` | the states at the loads of pairs, and the gap divided among the causes |

mod at_loads;
mod contribution;
mod states;
#[cfg(test)]
mod tests;

pub use at_loads::{GroupsLeftOut, StatesAtLoads};
pub use contribution::{Contribution, Contributions, largest, leading};
pub use states::{Inputs, Rearranged};

use crate::named_enum;

use super::difference::{ByQuantity, ComparedQuantity, Repeats, over_realisations};

named_enum! {
    /// A reason why both models differ.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Cause {
        /// The heights do not follow the density of the statistical model.
        Heights = "heights",
        /// The radii are not all equal to the mean radius.
        Radii = "radii",
        /// Heights and radii are correlated. With equal radii: what replacing a sum by its integral leaves.
        Correlation = "correlation",
    }
}

impl Cause {
    /// The name in sentences.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Heights => "height distribution",
            Self::Radii => "spread of radii",
            Self::Correlation => "height-radius correlation",
        }
    }
}

named_enum! {
    /// An order in which one thing after the other is changed from the statistical to the deterministic model.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Order {
        /// Heights, radii, correlation.
        HeightsFirst = "heights-radii-correlation",
        /// Radii, heights, correlation.
        RadiiFirst = "radii-heights-correlation",
        /// Radii, correlation, heights.
        HeightsLast = "radii-correlation-heights",
    }
}

impl Order {
    /// The causes in this order.
    const fn causes(self) -> [Cause; 3] {
        match self {
            Self::HeightsFirst => [Cause::Heights, Cause::Radii, Cause::Correlation],
            Self::RadiiFirst => [Cause::Radii, Cause::Heights, Cause::Correlation],
            Self::HeightsLast => [Cause::Radii, Cause::Correlation, Cause::Heights],
        }
    }
}

/// The division of the gap at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct Attribution {
    /// The load, Pa.
    pub load: f64,
    /// In the order of [`ComparedQuantity::ALL`]; `None` where a quantity cannot be compared, and where too few contacts
    /// carry the load.
    pub quantities: ByQuantity<Option<Contributions>>,
}

impl Attribution {
    /// The contributions to the difference in a quantity.
    pub fn contributions(&self, quantity: ComparedQuantity) -> Option<&Contributions> {
        self.quantities[quantity as usize].as_ref()
    }

    /// The mean attributions over `repeats` of a surface (at least two), at the loads that all of them have.
    pub fn over(realisations: &[Vec<Self>], repeats: Repeats) -> Vec<Self> {
        over_realisations(realisations, |one| one.load, |all| Self::mean(all, repeats))
    }

    fn mean(all: &[Self], repeats: Repeats) -> Self {
        let quantity = |quantity: ComparedQuantity| {
            let each: Option<Vec<Contributions>> =
                all.iter().map(|one| one.contributions(quantity).copied()).collect();
            Some(Contributions::over(&each?, repeats))
        };
        Self { load: all[0].load, quantities: ComparedQuantity::ALL.map(quantity) }
    }
}
