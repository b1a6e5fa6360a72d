//! The worst errors by kind.

use crate::stability::{Group, GroupFindings, Kind, Worst};

/// Worst case of a kind.
#[derive(Debug, Clone)]
pub struct KindFindings {
    pub kind: Kind,
    /// The largest error of any quantity, as checked.
    pub largest_error: f64,
    /// The quantity closest to its bound.
    pub worst: Worst,
    pub group: Group,
}

impl KindFindings {
    /// Kind by kind, of those in which something was measured.
    pub fn of_all(groups: &[GroupFindings]) -> Vec<Self> {
        Kind::ALL.into_iter().filter_map(|kind| Self::of(groups, kind)).collect()
    }

    fn of(groups: &[GroupFindings], kind: Kind) -> Option<Self> {
        let of_kind = groups.iter().filter(|findings| findings.group.kind() == kind);
        let all: Vec<(Group, &Worst)> = of_kind
            .flat_map(|findings| findings.quantities.iter().map(|worst| (findings.group, worst)))
            .collect();
        let share = |(group, worst): &(Group, &Worst)| worst.checked / worst.bound(*group);
        let &(group, worst) = all.iter().max_by(|a, b| share(a).total_cmp(&share(b)))?;
        let largest_error = all.iter().map(|(_, worst)| worst.checked).fold(0.0, f64::max);
        Some(Self { kind, largest_error, worst: worst.clone(), group })
    }
}
