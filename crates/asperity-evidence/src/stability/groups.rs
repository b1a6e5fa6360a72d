//! The groups of cases with their error bounds, and the largest errors of each.

use super::cases::{Case, case};
use super::check::{Checked, Deviation, Failure, check};
use crate::exact::CoveredLaw;
use asperity::named_enum;
use asperity::progress::Progress;
use rayon::prelude::*;

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum CheckedQuantity {
        Area = "area",
        /// Load of a contact, nominal pressure.
        Load = "load",
        /// dP/dw of a contact, -dp/dd.
        Stiffness = "stiffness",
        /// Contacts per nominal area.
        Density = "contact density",
        /// Parts of area and load that each regime has: the absolute error.
        Shares = "regime shares",
        /// Sampling errors of a sum: the error of the variance over the mean square.
        Sampling = "sampling error",
        /// The pressure that load control ends on.
        Reached = "pressure reached",
    }
}

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum CheckKind {
        Contact = "single contact",
        Sum = "sum",
        Integral = "integral",
        Load = "load control",
    }
}

/// The groups, a line each: name, kind, largest relative error allowed under laws in closed form (`docs/stability.md` gives the reason),
/// and description.
macro_rules! groups {
    ($($group:ident = $name:literal, $kind:ident, $bound:expr, $about:literal;)+) => {
        named_enum! {
            #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
            pub enum Group {
                $(#[doc = $about] $group = $name,)+
            }
        }

        impl Group {
            pub const fn about(self) -> &'static str {
                match self { $(Self::$group => $about,)+ }
            }

            pub const fn kind(self) -> CheckKind {
                match self { $(Self::$group => CheckKind::$kind,)+ }
            }

            const fn bound_in_closed_form(self) -> f64 {
                match self { $(Self::$group => $bound,)+ }
            }
        }
    };
}

groups! {
    Contacts = "any contact", Contact, 1e-14, "all laws, random material pairs, w from 1e-15 to 10 radii";
    LayeredContacts = "any contact, layer", Contact, 1e-12, "the same under a layer";
    Boundaries = "beside a boundary", Contact, 1e-14, "w within 1e-15 of a boundary between two formulas";
    LayeredBoundaries = "beside a boundary, layer", Contact, 1e-12, "the same under a layer, at every crossing of a boundary";
    Scales = "scales of the layer", Contact, 1e-12, "a/t within a few ulp of 1, layers 1e15 times thinner or thicker, w close to t";
    Ellipses = "ellipses", Contact, 1e-14, "curvature ratios from 1 + 1e-15 to 1e12";
    Denormals = "denormal indentation", Contact, 1e-14, "w from 5e-324 to 2e-293 m; errors relative to the result plus 1e-130 (SI)";
    Sums = "any sum", Sum, 1e-14, "1 to 300 Gaussian heights, radii within a factor of 4";
    LayeredSums = "any sum, layer", Sum, 1e-12, "the same under a layer";
    OneAsperity = "one asperity", Sum, 1e-14, "indentations of 1e-12 to 20 sigma";
    Offset = "offset heights", Sum, 1e-14, "mean height of 1 to 1e8 sigma above or below zero";
    Line = "on a line", Sum, 1e-14, "evenly spaced heights";
    Touching = "just touching", Sum, 1e-14, "all but one within 4 ulp of the flat";
    Equal = "equal", Sum, 1e-14, "1 to 300 asperities of equal height and radius";
    MillionEqual = "a million equal", Sum, 4.0 * f64::EPSILON, "compared with the exact sum of the terms";
    MillionLine = "a million on a line", Sum, 4.0 * f64::EPSILON, "compared with the exact sum of the terms";
    Integrals = "any integral", Integral, 1e-13, "Gaussian heights, d from -10 to 20 sigma";
    LayeredIntegrals = "any integral, layer", Integral, 1e-12, "the same under a layer";
    OtherHeights = "other heights", Integral, 1e-13, "other distributions that are covered, d from -10 to 20 sigma";
    Deep = "deep", Integral, 1e-13, "d from -20 to -10 sigma";
    Tail = "far tail", Integral, 2e-13, "d from 20 to 35 sigma";
    Last = "end of the tail", Integral, 3e-13, "d from 35 to 37 sigma";
    Vanishing = "denormal density", Integral, 1e-15, "d from 37 to 40 sigma; error relative to the value at 37 sigma";
    LoadsOfIntegrals = "pressure of an integral", Load, 1e-12, "load control at the pressures of d from -8 to 20 sigma";
    LoadsOfSums = "pressure of a sum", Load, 1e-12, "load control at the pressures of d from -4 to 2 sigma";
}

impl Group {
    pub const fn is_layered(self) -> bool {
        matches!(
            self,
            Self::LayeredContacts
                | Self::LayeredBoundaries
                | Self::Scales
                | Self::LayeredSums
                | Self::LayeredIntegrals
        )
    }

    /// Whether its cases have a million asperities, so that a few cases are enough.
    pub const fn is_large(self) -> bool {
        matches!(self, Self::MillionEqual | Self::MillionLine)
    }

    /// Largest relative error allowed for a quantity, before the factor of a narrow transition; without a layer, under laws in closed form.
    pub fn bound(self, quantity: CheckedQuantity) -> f64 {
        // The slope of a table has fewer digits.
        let is_slope = quantity == CheckedQuantity::Stiffness && self.is_layered();
        if is_slope { SLOPE_OF_TABLE } else { self.bound_in_closed_form() }
    }

    /// The same under a law.
    pub fn bound_under(self, quantity: CheckedQuantity, law: &CoveredLaw) -> f64 {
        let is_slope = quantity == CheckedQuantity::Stiffness && law.twin.has_tables;
        let bound = if is_slope { SLOPE_OF_TABLE } else { self.bound(quantity) };
        bound * (law.twin.steepness)(law.chosen())
    }
}

/// Error allowed in a stiffness that is the slope of a table.
const SLOPE_OF_TABLE: f64 = 1e-11;

/// Cases of each group, by what they evaluate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Of each group of single contacts; a quarter of it under a layer.
    pub contacts: u64,
    pub sums: u64,
    pub integrals: u64,
    pub loads: u64,
    /// Of each group of a million asperities.
    pub millions: u64,
}

impl Counts {
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
}

#[derive(Debug, Clone)]
pub struct GroupResults {
    pub group: Group,
    pub cases: u64,
    pub worst: Vec<WorstCase>,
    /// Cases that failed or could not be checked, and why.
    pub failures: Vec<(Case, Failure)>,
}

impl GroupResults {
    /// The largest error of a quantity, as checked; `None` of a quantity that the group does not have.
    pub fn largest_error(&self, quantity: CheckedQuantity) -> Option<f64> {
        self.worst.iter().find(|worst| worst.quantity == quantity).map(|worst| worst.largest)
    }

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

#[derive(Debug, Clone)]
pub struct WorstCase {
    pub quantity: CheckedQuantity,
    /// Median of the errors of all cases, as checked.
    pub median: f64,
    /// Largest of the errors of all cases, as checked.
    pub largest: f64,
    /// The error closest to its bound, as checked.
    pub checked: f64,
    pub case: Case,
    /// The largest plain error, separations within their rounding not counted as right.
    pub error: f64,
}

impl WorstCase {
    pub fn bound(&self) -> f64 {
        self.case.group.bound_under(self.quantity, &self.case.bodies.law)
    }

    pub fn is_within_bound(&self) -> bool {
        self.checked <= self.bound()
    }

    /// Of one quantity over the cases of a group; `None` where no case has it.
    fn among(cases: &[(Case, Checked)], quantity: CheckedQuantity) -> Option<Self> {
        let deviations = cases
            .iter()
            .flat_map(|(case, checked)| checked.iter().flatten().map(move |deviation| (deviation, case)));
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
pub fn check_group(group: Group, count: u64, seed: [u8; 32], progress: &dyn Progress) -> GroupResults {
    let check = |index| {
        let case = case(seed, group, index);
        let checked = check(&case);
        progress.advance(1.0);
        (case, checked)
    };
    let checked: Vec<(Case, Checked)> = (0..count).into_par_iter().map(check).collect();
    let worst = CheckedQuantity::ALL.into_iter().filter_map(|quantity| WorstCase::among(&checked, quantity));
    GroupResults {
        group,
        cases: count,
        worst: worst.collect(),
        failures: checked.into_iter().filter_map(|(case, checked)| Some((case, checked.err()?))).collect(),
    }
}
