//! The contributions to a difference, with their intervals, and which of them leads.

use super::Cause;
use crate::compare::difference::{Estimate, Repeats};

/// The number of orders of replacement.
const ORDERS: usize = 3;

/// A contribution to a difference, as a [contrast](crate::compare::ComparedQuantity::contrast).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contribution {
    /// In each of [`Order::ALL`](super::Order::ALL), with its sampling uncertainty.
    pub by_order: [Estimate; ORDERS],
    /// The mean over the orders.
    pub mean: Estimate,
}

impl Contribution {
    /// The smallest interval that holds the 95 % intervals of all orders; `None` where one has none.
    pub fn interval(&self) -> Option<[f64; 2]> {
        let [mut low, mut high] = self.mean.interval()?;
        for order in &self.by_order {
            let [from, to] = order.interval()?;
            (low, high) = (low.min(from), high.max(to));
        }
        Some([low, high])
    }

    /// The smallest and the largest value over the orders.
    pub fn range(&self) -> [f64; 2] {
        let each = self.by_order.map(|order| order.contrast);
        [each.into_iter().fold(f64::INFINITY, f64::min), each.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The smallest and the largest magnitude in the interval.
    fn magnitudes(&self) -> Option<[f64; 2]> {
        let [low, high] = self.interval()?;
        let least = if low * high > 0.0 { low.abs().min(high.abs()) } else { 0.0 };
        Some([least, low.abs().max(high.abs())])
    }

    /// Whether every value of its interval is larger, by magnitude, than every one of `other`'s.
    pub fn exceeds(&self, other: &Self) -> bool {
        let magnitudes = self.magnitudes().zip(other.magnitudes());
        magnitudes.is_some_and(|([least, _], [_, most])| least > most)
    }

    /// The mean over `repeats` of a surface (at least two).
    fn over(each: &[Self], repeats: Repeats) -> Self {
        let over = |of: &dyn Fn(&Self) -> Estimate| {
            Estimate::over(&each.iter().map(of).collect::<Vec<_>>(), repeats)
        };
        Self {
            by_order: std::array::from_fn(|order| over(&|one| one.by_order[order])),
            mean: over(&|one| one.mean),
        }
    }
}

/// The difference in one quantity at one load, divided among its causes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contributions {
    /// The difference.
    pub total: Estimate,
    /// Of each of [`Cause::ALL`]; in every order and in the mean they add up to the difference.
    pub causes: [Contribution; 3],
    /// Of the radii: their spread and their correlation with the heights together.
    pub radii: Contribution,
    /// Of each of [`Cause::ALL`], means over the orders, where the statistical model has the other mean radius; `None` where it has not
    /// one radius that could be taken in another way.
    pub with_other_radius: Option<[f64; 3]>,
}

impl Contributions {
    /// The contribution of a cause.
    pub fn of_cause(&self, cause: Cause) -> &Contribution {
        &self.causes[cause as usize]
    }

    /// The mean contribution of a cause over the orders.
    pub fn part(&self, cause: Cause) -> f64 {
        self.of_cause(cause).mean.contrast
    }

    /// The share of a cause in the contributions, taken by magnitude; 0 where all are zero.
    pub fn share(&self, cause: Cause) -> f64 {
        let all: f64 = Cause::ALL.into_iter().map(|cause| self.part(cause).abs()).sum();
        if all > 0.0 { self.part(cause).abs() / all } else { 0.0 }
    }

    /// The difference itself.
    pub fn gap(&self) -> f64 {
        self.total.contrast
    }

    /// The cause that leads; see [`leading`].
    pub fn leading(&self) -> Option<Cause> {
        leading(&self.total, &Cause::ALL.map(|cause| (cause, *self.of_cause(cause))))
    }

    /// The cause with the largest contribution on this very surface; see [`largest`].
    pub fn largest(&self) -> Option<Cause> {
        largest(&self.total, &Cause::ALL.map(|cause| (cause, *self.of_cause(cause))))
    }

    /// The mean contributions over `repeats` of a surface (at least two).
    pub(super) fn over(each: &[Self], repeats: Repeats) -> Self {
        let over = |of: &dyn Fn(&Self) -> Contribution| {
            Contribution::over(&each.iter().map(of).collect::<Vec<_>>(), repeats)
        };
        let others: Option<Vec<[f64; 3]>> = each.iter().map(|one| one.with_other_radius).collect();
        let mean_of = |others: Vec<[f64; 3]>| {
            Cause::ALL.map(|cause| {
                others.iter().map(|parts| parts[cause as usize]).sum::<f64>() / others.len() as f64
            })
        };
        Self {
            total: Estimate::over(&each.iter().map(|one| one.total).collect::<Vec<_>>(), repeats),
            causes: Cause::ALL.map(|cause| over(&|one| *one.of_cause(cause))),
            radii: over(&|one| one.radii),
            with_other_radius: others.map(mean_of),
        }
    }
}

/// The part that leads: of the `parts` in the direction of the difference the largest one, where its 95 % interval, all orders of
/// replacement included, lies beyond zero and beyond the intervals of all others. None leads where a part has no interval, or the
/// interval of the difference, which is the `total` of the parts, leaves its sign open.
pub fn leading<T: Copy>(total: &Estimate, parts: &[(T, Contribution)]) -> Option<T> {
    let direction = direction(total.interval()?)?;
    let along = |(name, part): &(T, Contribution)| {
        let [low, high] = part.interval()?;
        Some(if direction > 0.0 { (*name, low, high) } else { (*name, -high, -low) })
    };
    let mut along: Vec<(T, f64, f64)> = parts.iter().map(along).collect::<Option<_>>()?;
    along.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (&(first, low, _), others) = along.split_first()?;
    let next = others.iter().fold(0.0, |next: f64, (_, _, high)| next.max(*high));
    (low > next).then_some(first)
}

/// The part that is the largest in the direction of the difference in every order of replacement, by more than the bounds of errors:
/// what holds of the very surface that was compared, whatever another sample of it would give.
pub fn largest<T: Copy>(total: &Estimate, parts: &[(T, Contribution)]) -> Option<T> {
    let direction = direction(total.here().interval()?)?;
    let is_largest_in = |first: usize, order: usize| {
        let part = |place: usize| {
            let Estimate { contrast, bound, .. } = parts[place].1.by_order[order];
            (direction * contrast, bound)
        };
        let (size, bound) = part(first);
        let smaller = |other: usize| part(other).0 + part(other).1 < size - bound;
        size > bound && (0..parts.len()).all(|other| other == first || smaller(other))
    };
    let is_largest = |first: &usize| (0..ORDERS).all(|order| is_largest_in(*first, order));
    (0..parts.len()).find(is_largest).map(|first| parts[first].0)
}

/// The sign that all values of an interval share.
fn direction([low, high]: [f64; 2]) -> Option<f64> {
    (low > 0.0 || high < 0.0).then(|| low.signum())
}

impl From<Estimate> for Contribution {
    /// One that no order changes.
    fn from(estimate: Estimate) -> Self {
        Self { by_order: [estimate; ORDERS], mean: estimate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::estimate;

    /// A part of the same size in every order.
    fn part(contrast: f64, error: Option<f64>) -> Contribution {
        estimate(contrast, error).into()
    }

    /// The sum of the parts, well known.
    fn total(parts: &[Contribution; 3]) -> Estimate {
        estimate(parts.iter().map(|part| part.mean.contrast).sum(), Some(1e-3))
    }

    fn leading_of(parts: [Contribution; 3]) -> Option<&'static str> {
        leading(&total(&parts), &named(parts))
    }

    fn largest_of(parts: [Contribution; 3]) -> Option<&'static str> {
        largest(&total(&parts), &named(parts))
    }

    fn named(parts: [Contribution; 3]) -> Vec<(&'static str, Contribution)> {
        ["a", "b", "c"].into_iter().zip(parts).collect()
    }

    #[test]
    fn the_leading_part_is_apart_from_all_others() {
        let of = |parts: [(f64, f64); 3]| leading_of(parts.map(|(size, error)| part(size, Some(error))));
        assert_eq!(of([(0.2, 0.01), (0.1, 0.01), (-0.05, 0.01)]), Some("a"));
        // The largest one is against the direction of the sum.
        assert_eq!(of([(-0.2, 0.01), (0.3, 0.01), (-0.25, 0.01)]), Some("c"));
        assert_eq!(of([(-0.2, 0.01), (0.3, 0.01), (-0.21, 0.01)]), None);
        assert_eq!(of([(0.2, 0.06), (0.1, 0.01), (0.0, 0.0)]), None);
        assert_eq!(of([(0.2, 0.01), (0.1, 0.06), (0.0, 0.0)]), None);
        assert_eq!(of([(0.0, 0.0); 3]), None);
    }

    #[test]
    fn without_an_interval_no_part_leads() {
        let sure = part(0.0, Some(0.0));
        assert_eq!(leading_of([part(0.2, None), part(0.01, None), sure]), None);
        assert_eq!(leading_of([part(0.2, Some(0.01)), part(0.01, None), sure]), None);
        assert_eq!(leading_of([part(0.2, Some(0.01)), part(0.01, Some(0.01)), sure]), Some("a"));
    }

    /// 0.3 and -0.29: which of them leads would change with the sign of what they leave.
    #[test]
    fn nothing_leads_where_the_sign_of_the_difference_is_open() {
        let parts = named([part(0.3, Some(0.01)), part(-0.29, Some(0.01)), part(0.0, Some(0.0))]);
        assert_eq!(leading(&estimate(0.01, Some(0.004)), &parts), Some("a"));
        assert_eq!(leading(&estimate(0.01, Some(0.006)), &parts), None);
        assert_eq!(leading(&estimate(0.01, None), &parts), None);
    }

    /// Without an interval, but known within a bound, as the reference is.
    #[test]
    fn the_largest_part_is_so_within_the_bounds_of_errors() {
        let of = |bound: f64| {
            let bounded = |contrast| Estimate { bound, ..estimate(contrast, None) };
            let parts = [bounded(0.2).into(), part(0.1, None), part(-0.15, None)];
            largest(&bounded(0.15), &named(parts))
        };
        assert_eq!(of(0.09), Some("a"));
        // Another part may be as large.
        assert_eq!(of(0.11), None);
        let alone = |contrast: f64| {
            let all = Estimate { bound: 0.02, ..estimate(contrast, None) };
            largest(&all, &[("a", all.into())])
        };
        assert_eq!((alone(0.03), alone(0.01)), (Some("a"), None));
    }

    /// Contributions of 0.677, 0.677 and 0.325 sigma with a mean of 0.56 +- 0.048: the interval holds all of them.
    #[test]
    fn an_interval_holds_all_orders_and_so_decides_less() {
        let first = Contribution {
            by_order: [0.677, 0.677, 0.325].map(|size| estimate(size, Some(0.03))),
            mean: estimate(0.56, Some(0.024)),
        };
        let [low, high] = first.interval().unwrap();
        assert!((low - 0.265).abs() < 1e-12 && (high - 0.737).abs() < 1e-12, "{low} {high}");
        assert_eq!(first.range(), [0.325, 0.677]);
        let second = part(0.3, Some(0.02));
        assert_eq!(leading_of([first, second, part(0.0, Some(0.0))]), None);
        assert_eq!(leading_of([first, part(0.2, Some(0.02)), part(0.0, Some(0.0))]), Some("a"));
    }

    #[test]
    fn one_part_exceeds_another_by_magnitude() {
        let exceeds = |a: Contribution, b: Contribution| a.exceeds(&b);
        assert!(exceeds(part(-0.3, Some(0.01)), part(0.2, Some(0.01))));
        assert!(!exceeds(part(-0.3, Some(0.04)), part(0.2, Some(0.02))));
        assert!(!exceeds(part(-0.3, None), part(0.2, Some(0.01))));
        assert!(!exceeds(part(0.01, Some(0.02)), part(0.0, Some(0.0))));
    }

    #[test]
    fn the_largest_part_is_so_in_every_order() {
        let orders = |sizes: [f64; 3]| Contribution {
            by_order: sizes.map(|size| estimate(size, None)),
            mean: estimate(sizes.iter().sum::<f64>() / 3.0, None),
        };
        let none = part(0.0, None);
        assert_eq!(largest_of([orders([0.3, 0.3, 0.2]), orders([0.1, 0.1, 0.19]), none]), Some("a"));
        assert_eq!(largest_of([orders([0.3, 0.3, 0.1]), orders([0.1, 0.1, 0.2]), none]), None);
        // In the direction of the sum.
        assert_eq!(largest_of([orders([0.3, 0.3, 0.3]), orders([-0.4, -0.4, -0.4]), none]), Some("b"));
        assert_eq!(largest_of([none; 3]), None);
    }
}
