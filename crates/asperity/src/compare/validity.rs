//! The admissible range of loads, and the numbers of points beyond it.

use std::iter::Sum;

use super::{Comparison, Control};
use crate::model::{Exceeded, Limit};

/// The loads that are admissible.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AdmissibleRange {
    /// First and last load (Pa) of each stretch of neighbouring admissible loads, ascending.
    pub stretches: Vec<[f64; 2]>,
    /// The limits exceeded at the next lower load; of all loads together where none is valid.
    pub below: Exceeded,
    /// The limits exceeded at the next higher load.
    pub above: Exceeded,
    /// Where no load is admissible, the limit that binds: the one without which most loads would be, or which most loads exceed.
    pub binding: Option<Limit>,
}

impl AdmissibleRange {
    /// Of loads (Pa), in any order, and the limits exceeded at each.
    pub fn new(loads: impl IntoIterator<Item = (f64, Exceeded)>) -> Self {
        let mut loads: Vec<(f64, Exceeded)> = loads.into_iter().collect();
        loads.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_admissible = |at: &(f64, Exceeded)| at.1.is_none();
        let valid = loads
            .chunk_by(|a, b| is_admissible(a) == is_admissible(b))
            .filter(|stretch| is_admissible(&stretch[0]));
        let stretches: Vec<[f64; 2]> =
            valid.map(|stretch| [stretch[0].0, stretch[stretch.len() - 1].0]).collect();
        let (Some(first), Some(last)) =
            (loads.iter().position(is_admissible), loads.iter().rposition(is_admissible))
        else {
            let all = loads.iter().fold(Exceeded::default(), |all, at| all.union(at.1));
            return Self { stretches, below: all, above: Exceeded::default(), binding: binding(&loads) };
        };
        let exceeded = |at: Option<&(f64, Exceeded)>| at.map_or(Exceeded::default(), |at| at.1);
        Self {
            stretches,
            below: exceeded(first.checked_sub(1).and_then(|k| loads.get(k))),
            above: exceeded(loads.get(last + 1)),
            binding: None,
        }
    }
}

/// The limit that binds among loads of which none is admissible.
fn binding(loads: &[(f64, Exceeded)]) -> Option<Limit> {
    let count =
        |holds: &dyn Fn(Exceeded) -> bool| loads.iter().filter(|(_, exceeded)| holds(*exceeded)).count();
    let rank = |limit: &Limit| {
        (count(&|at| at.is_at_most(*limit)), count(&|at| at.limits().any(|exceeded| exceeded == *limit)))
    };
    Limit::ALL.into_iter().max_by_key(rank).filter(|_| !loads.is_empty())
}

/// Numbers of points of one or several comparisons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PointCounts {
    /// Points of both models.
    pub points: usize,
    /// Of these, beyond each of [`Limit::ALL`].
    pub exceeded: [usize; 4],
    /// Points prescribed by a pressure or a force.
    pub load_points: usize,
    /// Of these, within a load jump of the law.
    pub in_jump: usize,
    /// Pressures of the deterministic model without a pair at equal load.
    pub unpaired: usize,
}

impl PointCounts {
    /// Counts the points of one comparison.
    pub fn new(comparison: &Comparison) -> Self {
        let mut counts = Self { unpaired: comparison.unpaired.len(), ..Self::default() };
        for (point, exceeded) in comparison.curves.iter().zip(comparison.exceeded()) {
            counts.points += 1;
            for limit in exceeded.limits() {
                counts.exceeded[limit as usize] += 1;
            }
            if point.control != Control::Separation {
                counts.load_points += 1;
                counts.in_jump += usize::from(point.in_jump);
            }
        }
        counts
    }

    /// Number of points beyond a limit.
    pub fn beyond(&self, limit: Limit) -> usize {
        self.exceeded[limit as usize]
    }
}

impl Sum for PointCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), |a, b| Self {
            points: a.points + b.points,
            exceeded: std::array::from_fn(|k| a.exceeded[k] + b.exceeded[k]),
            load_points: a.load_points + b.load_points,
            in_jump: a.in_jump + b.in_jump,
            unpaired: a.unpaired + b.unpaired,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::{response, sharing};
    use crate::compare::{CurvePoint, ModelKind};

    fn names(exceeded: Exceeded) -> Vec<&'static str> {
        exceeded.limits().map(Limit::name).collect()
    }

    #[test]
    fn loads_between_stretches_are_not_valid() {
        let range = |loads: &[(f64, f64, f64)]| {
            let at = |&(load, contacts, area_ratio): &(f64, f64, f64)| {
                (load, Exceeded::new(Some(&sharing(contacts)), area_ratio))
            };
            AdmissibleRange::new(loads.iter().map(at))
        };
        let found = range(&[
            (5.0, 90.0, 0.01),
            (1.0, 20.0, 0.01),
            (2.0, 40.0, 0.01),
            (3.0, 50.0, 0.01),
            (4.0, 29.0, 0.01),
            (6.0, 90.0, 0.06),
        ]);
        assert_eq!(found.stretches, [[2.0, 3.0], [5.0, 5.0]]);
        assert_eq!((names(found.below), names(found.above)), (vec!["few-contacts"], vec!["interaction"]));
        let none = range(&[(1.0, 20.0, 0.01), (2.0, 90.0, 0.07)]);
        assert_eq!((none.stretches.len(), names(none.below)), (0, vec!["few-contacts", "interaction"]));
        // Of two limits that exclude one load each, the last; without one of them two loads would be admissible.
        assert_eq!(none.binding, Some(Limit::Interaction));
        let few = range(&[(1.0, 20.0, 0.01), (2.0, 25.0, 0.01), (3.0, 90.0, 0.07)]);
        assert_eq!(few.binding, Some(Limit::FewContacts));
        let both = range(&[(1.0, 20.0, 0.07), (2.0, 40.0, 0.07)]);
        assert_eq!((both.binding, found.binding), (Some(Limit::Interaction), None));
        let all = range(&[(1.0, 40.0, 0.01), (2.0, 90.0, 0.02)]);
        assert!(all.below.is_none() && all.above.is_none() && all.stretches == [[1.0, 2.0]]);
    }

    #[test]
    fn each_kind_of_point_is_counted_by_itself() {
        let point = |kind, control, contacts: Option<f64>, area: f64, in_jump| CurvePoint {
            kind,
            control,
            target: 1.0,
            prescribed_pressure: None,
            response: response(1.0, area, contacts),
            in_jump,
        };
        let curves = vec![
            point(ModelKind::Statistical, Control::Separation, None, 0.01, false),
            point(ModelKind::Statistical, Control::Force, None, 0.06, false),
            point(ModelKind::Deterministic, Control::Separation, Some(29.0), 0.01, false),
            point(ModelKind::Deterministic, Control::Force, Some(31.0), 0.02, true),
        ];
        let comparison = Comparison { curves, unpaired: vec![1.0], ..Comparison::default() };
        let counts = PointCounts::new(&comparison);
        // Both models at one control share its limits.
        let expected =
            PointCounts { points: 4, exceeded: [2, 0, 2, 0], load_points: 2, in_jump: 1, unpaired: 1 };
        assert_eq!(counts, expected);
        assert_eq!([counts, counts].into_iter().sum::<PointCounts>().beyond(Limit::Interaction), 4);
    }
}
