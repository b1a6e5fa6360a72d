//! Numerical error of `f64`: thousands of random and adversarial cases, each checked by an evaluation of
//! about 32 digits that shares nothing with the models.
//!
//! | file | what lives there |
//! |---|---|
//! | `quantity` | what is measured |
//! | `group` | the groups of cases, and how far each may be off |
//! | `bodies` | bodies and law of a case |
//! | `cases` | the cases themselves, each from the seed, its group and its number |
//! | `laws` | the laws that are covered: their equations in about 32 digits, one table |
//! | [`exact`] | results in about 32 digits |
//! | `check` | error of a result |
//! | `maps` | errors over a plane |

mod bodies;
mod cases;
mod check;
pub mod exact;
mod group;
mod laws;
mod maps;
mod quantity;
pub mod wide;

pub use bodies::{Bodies, Layer};
pub use cases::{Case, CaseInput, Layout, SetParameters};
pub use check::{CheckedCase, Deviation, Failure};
pub use group::{CheckKind, Group};
pub use laws::CoveredLaw;
pub use maps::{Map, maps};
pub use quantity::CheckedQuantity;

use asperity::distribution::{Entry, REGISTRY};
use asperity::progress::Progress;
use rayon::prelude::*;

/// Names of the height distributions for which there is no evaluation of about 32 digits.
pub fn uncovered_heights() -> Vec<&'static str> {
    let is_covered =
        |entry: &Entry| entry.example().is_ok_and(|heights| exact::density_of(&heights).is_some());
    REGISTRY.iter().filter(|entry| !is_covered(entry)).map(|entry| entry.name).collect()
}

/// What random numbers are drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ranges {
    /// d/sigma.
    pub separation: [f64; 2],
    /// Radius over sigma.
    pub radius_over_sigma: [f64; 2],
    /// H/E*.
    pub hardness_over_modulus: [f64; 2],
    /// Of a layer, m.
    pub thickness: [f64; 2],
}

impl Default for Ranges {
    /// The whole representable range.
    fn default() -> Self {
        Self {
            separation: [-20.0, 37.0],
            radius_over_sigma: [1e-3, 1e9],
            hardness_over_modulus: [1e-6, 1.0],
            thickness: [1e-15, 1.0],
        }
    }
}

/// Cases of each group, by what they evaluate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Of each group of single contacts; a quarter of it under a layer.
    pub contacts: u64,
    /// Of each group of sums.
    pub sums: u64,
    /// Of each group of integrals.
    pub integrals: u64,
    /// Of each group of load control.
    pub loads: u64,
    /// Of each group of a million asperities.
    pub millions: u64,
}

impl Default for Counts {
    fn default() -> Self {
        Self { contacts: 1000, sums: 200, integrals: 250, loads: 50, millions: 3 }
    }
}

impl Counts {
    /// Cases of a group.
    pub fn in_group(&self, group: Group) -> u64 {
        match group.kind() {
            _ if group.is_large() => self.millions,
            // The tables of a layer cost as much as hundreds of contacts.
            CheckKind::Contact if group.is_layered() => self.contacts.div_ceil(4),
            CheckKind::Contact => self.contacts,
            CheckKind::Sum => self.sums,
            CheckKind::Integral => self.integrals,
            CheckKind::Load => self.loads,
        }
    }

    /// Cases of all groups.
    pub fn total(&self) -> u64 {
        Group::ALL.into_iter().map(|group| self.in_group(group)).sum()
    }
}

/// The errors of the cases of a group.
#[derive(Debug, Clone)]
pub struct GroupResults {
    /// The group.
    pub group: Group,
    /// Number of cases.
    pub cases: u64,
    /// Quantity by quantity.
    pub worst: Vec<WorstCase>,
    /// Cases that failed or could not be checked, and why.
    pub failures: Vec<(Case, Failure)>,
}

impl GroupResults {
    /// The largest error of a quantity, as checked; `None` of a quantity that the group does not have.
    pub fn largest_error(&self, quantity: CheckedQuantity) -> Option<f64> {
        self.worst.iter().find(|worst| worst.quantity == quantity).map(|worst| worst.largest)
    }

    /// Whether every quantity of every case is within its bound.
    pub fn is_within_bounds(&self) -> bool {
        self.failures.is_empty() && self.worst.iter().all(WorstCase::is_within_bound)
    }

    /// Cases that failed, then quantities beyond their bounds, each with the case.
    pub fn violations(&self) -> impl Iterator<Item = (String, &Case)> {
        let failures = self.failures.iter().map(|(case, failure)| (failure.to_string(), case));
        let beyond = self.worst.iter().filter(|worst| !worst.is_within_bound());
        failures.chain(beyond.map(|worst| {
            let WorstCase { quantity, checked, .. } = worst;
            let name = quantity.name();
            (
                format!("error of {checked:.1e} in {name}, beyond the bound of {:.1e}", worst.bound()),
                &worst.case,
            )
        }))
    }
}

/// Worst case of one quantity.
#[derive(Debug, Clone)]
pub struct WorstCase {
    /// The quantity.
    pub quantity: CheckedQuantity,
    /// Median of the errors of all cases, as checked.
    pub median: f64,
    /// Largest of the errors of all cases, as checked.
    pub largest: f64,
    /// The error closest to its bound, as checked.
    pub checked: f64,
    /// The case of that error.
    pub case: Case,
    /// The largest plain error, separations within their rounding not counted as right.
    pub error: f64,
}

impl WorstCase {
    /// Largest error allowed in the case.
    pub fn bound(&self) -> f64 {
        self.case.group.bound_under(self.quantity, &self.case.bodies.law)
    }

    /// Whether the error is a number within its bound.
    pub fn is_within_bound(&self) -> bool {
        self.checked <= self.bound()
    }

    /// Of one quantity over the cases of a group; `None` where no case has it.
    fn among(cases: &[CheckedCase], quantity: CheckedQuantity) -> Option<Self> {
        let deviations = cases.iter().flat_map(|CheckedCase { case, outcome }| {
            outcome.iter().flatten().map(move |deviation| (deviation, case))
        });
        let mut all: Vec<(&Deviation, &Case)> =
            deviations.filter(|(deviation, _)| deviation.quantity == quantity).collect();
        all.sort_by(|(a, _), (b, _)| a.checked.total_cmp(&b.checked));
        // Bounds are those of a case's law.
        let share = |(deviation, case): &(&Deviation, &Case)| {
            deviation.checked / case.group.bound_under(quantity, &case.bodies.law)
        };
        let (worst, case) = all.iter().max_by(|a, b| share(a).total_cmp(&share(b)))?;
        Some(Self {
            quantity,
            median: all[all.len() / 2].0.checked,
            largest: all.last()?.0.checked,
            checked: worst.checked,
            case: (*case).clone(),
            error: all.iter().map(|(deviation, _)| deviation.error).fold(0.0, f64::max),
        })
    }
}

/// Checks `count` cases of one group, each a unit of work for `progress`.
pub fn check_group(
    group: Group,
    count: u64,
    seed: [u8; 32],
    ranges: &Ranges,
    progress: &dyn Progress,
) -> GroupResults {
    let factory = cases::CaseFactory { seed, ranges };
    let check = |index| {
        let checked = check::check(factory.case(group, index));
        progress.advance(1.0);
        checked
    };
    let checked: Vec<CheckedCase> = (0..count).into_par_iter().map(check).collect();
    let worst = CheckedQuantity::ALL.into_iter().filter_map(|quantity| WorstCase::among(&checked, quantity));
    GroupResults {
        group,
        cases: count,
        worst: worst.collect(),
        failures: checked.into_iter().filter_map(|case| Some((case.case, case.outcome.err()?))).collect(),
    }
}
