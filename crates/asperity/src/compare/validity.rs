//! Numbers of points of a comparison at which the models are not valid, or do not reach the prescribed value.

use std::iter::Sum;

use super::{Comparison, Control, Kind, MIN_CONTACTS};

/// Numbers of points of one or several comparisons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PointCounts {
    /// Points of both models.
    pub points: usize,
    /// Of these, beyond the contact area at which asperities interact.
    pub beyond_model: usize,
    /// Points of the deterministic model.
    pub sum_points: usize,
    /// Of these, with a contact, but fewer than [`MIN_CONTACTS`].
    pub few_contacts: usize,
    /// Points prescribed by a pressure or a force.
    pub load_points: usize,
    /// Of these, within a load jump of the law.
    pub in_jump: usize,
    /// Pressures of the deterministic model without a pair at equal load.
    pub unpaired: usize,
}

impl PointCounts {
    /// Counts the points of one comparison on the nominal area `area` (m^2).
    pub fn of(comparison: &Comparison, area: f64) -> Self {
        let mut counts = Self { unpaired: comparison.unpaired.len(), ..Self::default() };
        for point in &comparison.curves {
            counts.points += 1;
            counts.beyond_model += usize::from(point.response.is_beyond_model());
            if point.kind == Kind::Deterministic {
                let contacts = point.response.contact_density * area;
                counts.sum_points += 1;
                counts.few_contacts += usize::from(contacts > 0.0 && contacts < MIN_CONTACTS);
            }
            if point.control != Control::Separation {
                counts.load_points += 1;
                counts.in_jump += usize::from(point.in_jump);
            }
        }
        counts
    }
}

impl Sum for PointCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), |a, b| Self {
            points: a.points + b.points,
            beyond_model: a.beyond_model + b.beyond_model,
            sum_points: a.sum_points + b.sum_points,
            few_contacts: a.few_contacts + b.few_contacts,
            load_points: a.load_points + b.load_points,
            in_jump: a.in_jump + b.in_jump,
            unpaired: a.unpaired + b.unpaired,
        })
    }
}

/// The first and the last load (Pa) of each stretch of neighbouring loads that are all valid, by growing load, from loads
/// in any order.
pub fn valid_stretches(loads: impl IntoIterator<Item = (f64, bool)>) -> Vec<[f64; 2]> {
    let mut loads: Vec<(f64, bool)> = loads.into_iter().collect();
    loads.sort_by(|a, b| a.0.total_cmp(&b.0));
    let stretches = loads.chunk_by(|a, b| a.1 == b.1).filter(|stretch| stretch[0].1);
    stretches.map(|stretch| [stretch[0].0, stretch[stretch.len() - 1].0]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::CurvePoint;
    use crate::contact::ByRegime;
    use crate::model::Response;

    #[test]
    fn loads_between_stretches_are_not_valid() {
        let loads = [(5.0, true), (1.0, false), (2.0, true), (3.0, true), (4.0, false), (6.0, false)];
        assert_eq!(valid_stretches(loads), [[2.0, 3.0], [5.0, 5.0]]);
        assert_eq!(valid_stretches([(1.0, false)]), [[0.0; 2]; 0]);
    }

    #[test]
    fn each_kind_of_point_is_counted_by_itself() {
        let point = |kind, control, contacts: f64, area: f64, in_jump| CurvePoint {
            kind,
            control,
            target: 1.0,
            prescribed_pressure: None,
            response: Response {
                separation_over_sigma: 1.0,
                separation: 1e-8,
                contact_density: contacts,
                area_ratio: ByRegime([area, 0.0, 0.0]),
                pressure: ByRegime([1.0, 0.0, 0.0]),
                stiffness: 1.0,
                sampling: None,
            },
            in_jump,
        };
        let curves = vec![
            point(Kind::Statistical, Control::Pressure, 1.0, 0.06, false),
            point(Kind::Deterministic, Control::Separation, 0.0, 0.0, false),
            point(Kind::Deterministic, Control::Separation, 14.0, 0.01, false),
            point(Kind::Deterministic, Control::Force, 15.0, 0.07, true),
        ];
        let comparison = Comparison { curves, unpaired: vec![1.0], ..Comparison::default() };
        let counts = PointCounts::of(&comparison, 2.0);
        let expected = PointCounts {
            points: 4,
            beyond_model: 2,
            sum_points: 3,
            few_contacts: 1,
            load_points: 2,
            in_jump: 1,
            unpaired: 1,
        };
        assert_eq!(counts, expected);
        assert_eq!([counts, counts].into_iter().sum::<PointCounts>().few_contacts, 2);
    }
}
