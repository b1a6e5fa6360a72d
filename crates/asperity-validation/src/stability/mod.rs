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
pub use group::{Group, Kind};
pub use laws::CoveredLaw;
pub use maps::Map;
pub use quantity::Quantity;

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
    /// Scenes of a group.
    pub fn of(&self, group: Group) -> u64 {
        match group.kind() {
            _ if group.is_large() => self.millions,
            // The tables of a layer cost as much as hundreds of contacts.
            Kind::Contact if group.is_layered() => self.contacts.div_ceil(4),
            Kind::Contact => self.contacts,
            Kind::Sum => self.sums,
            Kind::Integral => self.integrals,
            Kind::Load => self.loads,
        }
    }

    /// Scenes of all groups.
    pub fn total(&self) -> u64 {
        Group::ALL.into_iter().map(|group| self.of(group)).sum()
    }
}

/// What came of the cases of a group.
#[derive(Debug, Clone)]
pub struct GroupFindings {
    /// Which.
    pub group: Group,
    /// How many cases were checked.
    pub cases: u64,
    /// Quantity by quantity.
    pub quantities: Vec<Worst>,
    /// Scenes that could not be checked as right, and why.
    pub failures: Vec<(Case, Failure)>,
}

impl GroupFindings {
    /// Whether every quantity of every case is within its bound.
    pub fn holds(&self) -> bool {
        self.failures.is_empty()
            && self.quantities.iter().all(|worst| worst.checked <= worst.bound(self.group))
    }
}

impl Worst {
    /// How far the quantity may be off in its case.
    pub fn bound(&self, group: Group) -> f64 {
        group.bound_of(self.quantity, &self.case.bodies.law)
    }
}

/// Worst case of one quantity.
#[derive(Debug, Clone)]
pub struct Worst {
    /// Which.
    pub quantity: Quantity,
    /// Half of the cases are not further off than this, as checked.
    pub median: f64,
    /// The worst, as checked.
    pub checked: f64,
    /// The case of that.
    pub case: Case,
    /// The largest plain error, separations within their rounding not counted as right.
    pub error: f64,
}

/// Checks `count` cases of one group, each a unit of work for `progress`.
pub fn group(
    group: Group,
    count: u64,
    seed: [u8; 32],
    ranges: &Ranges,
    progress: &dyn Progress,
) -> GroupFindings {
    let maker = cases::CaseFactory { seed, ranges };
    let checked: Vec<CheckedCase> = (0..count)
        .into_par_iter()
        .map(|index| {
            let checked = check::check(maker.case(group, index));
            progress.advance(1.0);
            checked
        })
        .collect();
    let mut findings = GroupFindings { group, cases: count, quantities: Vec::new(), failures: Vec::new() };
    for quantity in Quantity::ALL {
        let mut all: Vec<(f64, &Case)> = Vec::new();
        let mut error = 0.0f64;
        for CheckedCase { case, outcome } in &checked {
            let of = outcome.iter().flatten().filter(|deviation| deviation.quantity == quantity);
            for deviation in of {
                all.push((deviation.checked, case));
                error = error.max(deviation.error);
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Bounds are those of a case's law.
        let share = |(checked, case): &(f64, &Case)| checked / group.bound_of(quantity, &case.bodies.law);
        if let Some((checked, case)) = all.iter().max_by(|a, b| share(a).total_cmp(&share(b))) {
            let median = all[all.len() / 2].0;
            let (checked, case) = (*checked, (*case).clone());
            findings.quantities.push(Worst { quantity, median, checked, case, error });
        }
    }
    let failures = checked.into_iter().filter_map(|checked| Some((checked.case, checked.outcome.err()?)));
    findings.failures.extend(failures);
    findings
}

/// Errors over the planes of the report, with so many cells along each: one unit of work for `progress`.
pub fn maps(ranges: &Ranges, resolution: usize, progress: &dyn Progress) -> Vec<Map> {
    maps::maps(ranges, resolution, progress)
}
