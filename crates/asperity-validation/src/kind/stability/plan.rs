//! How many cases, and what they are drawn from.

use std::fmt;

use crate::kind::stability::spec::{SpanSpec, StabilitySpec};
use crate::stability::Group;
use crate::stability::{Counts, Ranges};
use asperity_framework::input::InputError;
use asperity_framework::input::Spanned;
use asperity_framework::input::SpecFile;
use asperity_framework::input::Whole;
use asperity_framework::input::quantity::{Dimension, Range};

/// Scenes to be checked.
#[derive(Debug, Clone, Copy)]
pub struct StabilityPlan {
    /// Scenes of each group.
    pub counts: Counts,
    /// What they are drawn from.
    pub ranges: Ranges,
    /// Cells along each side of an error map.
    pub cells: usize,
}

impl StabilityPlan {
    /// An estimate of the micro-contacts that are evaluated, wide ones counted a hundredfold.
    pub fn work(&self) -> u128 {
        const OF_AN_INTEGRAL: u64 = 100_000;
        const OF_A_SUM: u64 = 30_000;
        let Counts { contacts, sums, integrals, loads, millions } = self.counts;
        let work = 100 * contacts
            + OF_A_SUM * sums
            + OF_AN_INTEGRAL * (integrals + 3 * loads)
            + 1_000_000 * millions;
        u128::from(work)
    }

    /// Bytes of the largest set and its ordered copy.
    pub fn memory(&self) -> u128 {
        let largest: u128 = if self.counts.millions > 0 { 1_000_000 } else { 1000 };
        100 * largest * rayon::current_num_threads() as u128
    }
}

impl fmt::Display for StabilityPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "  {} cases in {} groups, and error maps", self.counts.total(), Group::ALL.len())
    }
}

/// Reads `[stability]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<StabilitySpec>) -> Result<StabilityPlan, InputError> {
    let raw = table.get_ref();
    let (counts, ranges) = (Counts::default(), Ranges::default());
    Ok(StabilityPlan {
        counts: Counts {
            contacts: within(file, raw.contacts.as_ref(), counts.contacts, [1, 100_000], "cases")?,
            sums: within(file, raw.sums.as_ref(), counts.sums, [1, 100_000], "cases")?,
            integrals: within(file, raw.integrals.as_ref(), counts.integrals, [1, 100_000], "cases")?,
            loads: within(file, raw.loads.as_ref(), counts.loads, [1, 100_000], "cases")?,
            millions: within(file, raw.millions.as_ref(), counts.millions, [1, 1000], "cases")?,
        },
        ranges: Ranges {
            separation: span(file, raw.separation.as_ref(), ranges.separation)?,
            radius_over_sigma: span(file, raw.radius_over_sigma.as_ref(), ranges.radius_over_sigma)?,
            hardness_over_modulus: span(
                file,
                raw.hardness_over_modulus.as_ref(),
                ranges.hardness_over_modulus,
            )?,
            thickness: span(file, raw.thickness.as_ref(), ranges.thickness)?,
        },
        cells: within(file, raw.cells.as_ref(), 48, [8, 400], "cells")? as usize,
    })
}

fn within(
    file: &SpecFile,
    found: Option<&Spanned<Whole>>,
    usual: u64,
    range: [u64; 2],
    what: &str,
) -> Result<u64, InputError> {
    found.map_or(Ok(usual), |found| file.whole_within(found, range, what))
}

/// A part of what is checked at most.
fn span<D: Dimension, R: Range>(
    file: &SpecFile,
    found: Option<&Spanned<SpanSpec<D, R>>>,
    [least, most]: [f64; 2],
) -> Result<[f64; 2], InputError> {
    let Some(found) = found else { return Ok([least, most]) };
    let [from, to] = found.get_ref().ends();
    if least <= from && from < to && to <= most {
        return Ok([from, to]);
    }
    let message = format!(
        "found {from:e} to {to:e}; allowed: from a lower to a higher value within {least:e} to {most:e}"
    );
    Err(file.source.error_at(found.span(), message))
}
