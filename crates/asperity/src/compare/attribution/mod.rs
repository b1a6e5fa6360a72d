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
//! from one state to the next add up to the gap; the contribution of a cause is the mean over the orders.
//!
//! | module | content |
//! |---|---|
//! | `states` | the models of the states |
//! | `at_loads` | the states at the loads of pairs, and the gap divided among the causes |

mod at_loads;
mod states;
#[cfg(test)]
mod tests;

pub use at_loads::{GroupsLeftOut, StatesAtLoads};
pub use states::{Inputs, Rearranged};

use crate::named_enum;

use super::difference::{ComparedQuantity, Estimate, over_realisations};

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

/// The division of the difference in one quantity at one load, as [contrasts](ComparedQuantity::contrast).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contributions {
    /// The contribution of each of [`Cause::ALL`] in each of [`Order::ALL`].
    pub by_order: [[f64; 3]; 3],
    /// The mean over the orders for each of [`Cause::ALL`], with its sampling uncertainty.
    pub estimates: [Estimate; 3],
}

impl Contributions {
    /// The mean contribution of a cause over the orders.
    pub fn part(&self, cause: Cause) -> f64 {
        self.estimates[cause as usize].contrast
    }

    /// The cause that leads; see [`leading`].
    pub fn leading(&self) -> Option<Cause> {
        leading(&Cause::ALL.map(|cause| (cause, self.estimates[cause as usize])))
    }

    /// The smallest and the largest contribution of a cause in an order.
    pub fn range(&self, cause: Cause) -> [f64; 2] {
        let each = self.by_order.map(|order| order[cause as usize]);
        [each.into_iter().fold(f64::INFINITY, f64::min), each.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The share of a cause in the contributions, taken by magnitude; 0 where all are zero.
    pub fn share(&self, cause: Cause) -> f64 {
        let all: f64 = Cause::ALL.into_iter().map(|cause| self.part(cause).abs()).sum();
        if all > 0.0 { self.part(cause).abs() / all } else { 0.0 }
    }

    /// The difference that the contributions add up to.
    pub fn gap(&self) -> f64 {
        self.estimates.iter().map(|estimate| estimate.contrast).sum()
    }
}

/// The part that leads: of the `parts` in the direction of their sum the largest one, where the lower end of its 95 % interval lies
/// above zero and above the upper end of the interval of every other part. A part without an interval counts as exact.
pub fn leading<T: Copy>(parts: &[(T, Estimate)]) -> Option<T> {
    let sum: f64 = parts.iter().map(|(_, part)| part.contrast).sum();
    let mut along: Vec<(T, f64, f64)> = parts
        .iter()
        .map(|(name, part)| (*name, part.contrast * sum.signum(), part.half_width().unwrap_or(0.0)))
        .collect();
    along.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (&(first, size, half_width), others) = along.split_first()?;
    let next = others.iter().fold(0.0, |next: f64, (_, size, half_width)| next.max(size + half_width));
    (sum != 0.0 && size - half_width > next).then_some(first)
}

/// The division of the gap at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct Attribution {
    /// The load, Pa.
    pub load: f64,
    /// In the order of [`ComparedQuantity::ALL`]; `None` where a quantity cannot be compared, and where too few contacts
    /// carry the load.
    pub quantities: [Option<Contributions>; 3],
}

impl Attribution {
    /// The contributions to the difference in a quantity.
    pub fn contributions(&self, quantity: ComparedQuantity) -> Option<&Contributions> {
        self.quantities[quantity as usize].as_ref()
    }

    /// The mean attributions over realisations (at least two), at the loads that all of them have, with the interval that
    /// their scatter gives.
    pub fn over(realisations: &[Vec<Self>]) -> Vec<Self> {
        over_realisations(realisations, |one| one.load, Self::mean)
    }

    fn mean(all: &[Self]) -> Self {
        let quantity = |quantity: ComparedQuantity| {
            let each: Option<Vec<Contributions>> =
                all.iter().map(|one| one.contributions(quantity).copied()).collect();
            let each = each?;
            let mean = |order: usize, cause: usize| {
                each.iter().map(|one| one.by_order[order][cause]).sum::<f64>() / each.len() as f64
            };
            let of_cause = |cause: Cause| {
                let all: Vec<Estimate> = each.iter().map(|one| one.estimates[cause as usize]).collect();
                Estimate::over(&all)
            };
            Some(Contributions {
                by_order: std::array::from_fn(|order| std::array::from_fn(|cause| mean(order, cause))),
                estimates: Cause::ALL.map(of_cause),
            })
        };
        Self { load: all[0].load, quantities: ComparedQuantity::ALL.map(quantity) }
    }
}
