//! How many cases, and what they are drawn from.

use std::fmt;

use super::spec::{SpanSpec, StabilitySpec};
use crate::stability::{Counts, Group, Ranges};
use asperity_contact_framework::input::quantity::{Dimension, Range};
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole};

/// Cases to be checked.
#[derive(Debug, Clone, Copy)]
pub struct StabilityPlan {
    /// Cases of each group.
    pub counts: Counts,
    /// What they are drawn from.
    pub ranges: Ranges,
    /// Cells along each side of an error map.
    pub cells: usize,
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
    let count = |raw: &Option<Spanned<Whole>>, default: u64, range: [u64; 2]| {
        raw.as_ref().map_or(Ok(default), |raw| file.whole_within(raw, range, "cases"))
    };
    let cells = raw.cells.as_ref().map_or(Ok(48), |cells| file.whole_within(cells, [8, 400], "cells"));
    Ok(StabilityPlan {
        counts: Counts {
            contacts: count(&raw.contacts, counts.contacts, [1, 100_000])?,
            sums: count(&raw.sums, counts.sums, [1, 100_000])?,
            integrals: count(&raw.integrals, counts.integrals, [1, 100_000])?,
            loads: count(&raw.loads, counts.loads, [1, 100_000])?,
            millions: count(&raw.millions, counts.millions, [1, 1000])?,
        },
        ranges: Ranges {
            separation: span(file, &raw.separation, ranges.separation)?,
            radius_over_sigma: span(file, &raw.radius_over_sigma, ranges.radius_over_sigma)?,
            hardness_over_modulus: span(file, &raw.hardness_over_modulus, ranges.hardness_over_modulus)?,
            thickness: span(file, &raw.thickness, ranges.thickness)?,
        },
        cells: cells? as usize,
    })
}

/// A part of the widest range, which is the default.
fn span<D: Dimension, R: Range>(
    file: &SpecFile,
    raw: &Option<Spanned<SpanSpec<D, R>>>,
    [least, most]: [f64; 2],
) -> Result<[f64; 2], InputError> {
    let Some(raw) = raw else { return Ok([least, most]) };
    let [from, to] = raw.get_ref().ends();
    if least <= from && from < to && to <= most {
        return Ok([from, to]);
    }
    let message = format!(
        "found {from:e} to {to:e}; allowed: from a lower to a higher value within {least:e} to {most:e}"
    );
    Err(file.source.error_at(raw.span(), message))
}
