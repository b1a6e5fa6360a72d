//! `[sampling-interval]` resolved: intervals and filters that the maps hold.

use std::fmt;
use std::ops::Range;

use asperity_framework::input::Spanned;
use asperity_framework::input::quantity::{Pure, Quantity};
use asperity_framework::input::{InputError, SpecFile, Whole};

use super::spec::SamplingIntervalSpec;
use crate::kind::compare::plan::{ComparePlan, compared};

/// The intervals and multiples of a spec that gives none.
const DEFAULT: [u32; 4] = [1, 2, 4, 8];

/// The smallest nesting index in pixels of a spec that gives none: it leaves 0.5^(5/2)^2 = 1.3 % of the amplitude of waves of two
/// pixels, so that the filter and not the pixel ends the spectrum.
pub const PIXELS: f64 = 5.0;

/// The criterion for a limit compares two changes.
const FEWEST: usize = 3;

/// More are a sweep that no table shows.
const MOST: usize = 32;

/// The same surfaces at several sampling intervals and under several S filters.
pub struct IntervalPlan {
    /// Both models on the surfaces as they are, under one law.
    pub compare: ComparePlan,
    /// Sampling intervals in pixels, ascending.
    pub intervals: Vec<usize>,
    /// S filters; `None` where none are asked for.
    pub filters: Option<FilterPlan>,
}

/// S filters of growing nesting indices.
#[derive(Debug, Clone, PartialEq)]
pub struct FilterPlan {
    /// Nesting indices, ascending, in units of `base`.
    pub multiples: Vec<f64>,
    /// m; `None` for [`PIXELS`] pixels of each map.
    pub base: Option<f64>,
    /// Position in the spec of what set the indices, for errors about maps that do not hold them.
    pub key: Range<usize>,
}

impl FilterPlan {
    /// The unit of the nesting indices on a map of `pixel` (m), m.
    pub fn base(&self, pixel: [f64; 2]) -> f64 {
        self.base.unwrap_or(PIXELS * pixel[0].max(pixel[1]))
    }
}

impl IntervalPlan {
    /// Number of variants of each surface.
    pub fn scales(&self) -> usize {
        self.intervals.len() + self.filters.as_ref().map_or(0, |filters| filters.multiples.len())
    }
}

impl fmt::Display for IntervalPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.compare)?;
        writeln!(f, "  each surface at sampling intervals of {} pixels", listed(&self.intervals))?;
        let Some(filters) = &self.filters else { return Ok(()) };
        let base = filters.base.map_or_else(|| format!("{PIXELS} pixels"), |base| format!("{base:e} m"));
        writeln!(f, "  and under S filters of {} times {base}", listed(&filters.multiples))
    }
}

/// "1, 2, 4 and 8".
fn listed(values: &[impl fmt::Display]) -> String {
    let names: Vec<String> = values.iter().map(ToString::to_string).collect();
    asperity_framework::report::format::listed(&names)
}

/// Reads `[sampling-interval]`.
pub(super) fn plan(
    file: &SpecFile,
    table: &Spanned<SamplingIntervalSpec>,
) -> Result<IntervalPlan, InputError> {
    let (raw, span) = (table.get_ref(), table.span());
    let laws = &raw.law.get_ref().0;
    if laws.len() > 1 {
        let message = format!("found {} laws; allowed: one", laws.len());
        return Err(file.source.error_at(raw.law.span(), message));
    }
    let compare = compared(file, &raw.compared(), span.clone())?;
    let intervals = intervals(file, raw)?;
    let filters = filters(file, raw, &span)?;
    for surface in &compare.surfaces {
        let refuse = |at: Range<usize>, message: String| Err(file.source.error_at(at, message));
        let Some(points) = surface.map_points() else {
            let message = format!(
                "found surface {} ({}), which has no height map to sample; allowed: surfaces made by [surface.NAME.generate] or read by \
                 [surface.NAME.file], chosen by `surfaces = [...]`",
                surface.name,
                surface.describe()
            );
            return refuse(surface.size_key.clone(), message);
        };
        if surface.realisations > 1 {
            let message = format!(
                "found {} realisations of surface {}; allowed: one, whose blocks give the uncertainty: more points make it smaller",
                surface.realisations, surface.name
            );
            return refuse(surface.size_key.clone(), message);
        }
        /// Points that a five-point summit needs, three times over.
        const LEAST: usize = 9;
        let shorter = points[0].min(points[1]);
        if let Some(interval) = intervals.iter().find(|&&interval| shorter.div_ceil(interval) < LEAST) {
            let message = format!(
                "found an interval of {interval} pixels, which leaves {} points along an axis of surface {}; allowed: at most {} pixels \
                 there",
                shorter.div_ceil(*interval),
                surface.name,
                shorter / LEAST
            );
            return refuse(raw.intervals.as_ref().map_or(surface.size_key.clone(), Spanned::span), message);
        }
    }
    Ok(IntervalPlan { compare, intervals, filters })
}

fn intervals(file: &SpecFile, raw: &SamplingIntervalSpec) -> Result<Vec<usize>, InputError> {
    let Some(given) = &raw.intervals else { return Ok(DEFAULT.map(|interval| interval as usize).to_vec()) };
    let values: Vec<usize> = given.get_ref().iter().map(|&Whole(value)| value as usize).collect();
    let is_growing = values.windows(2).all(|pair| pair[0] < pair[1]);
    if !(FEWEST..=MOST).contains(&values.len()) || !is_growing || values[0] == 0 {
        let message = format!(
            "found {}; allowed: {FEWEST} to {MOST} whole numbers of pixels, ascending, from 1, such as [1, 2, 4, 8]",
            bracketed(&values)
        );
        return Err(file.source.error_at(given.span(), message));
    }
    Ok(values)
}

fn filters(
    file: &SpecFile,
    raw: &SamplingIntervalSpec,
    span: &Range<usize>,
) -> Result<Option<FilterPlan>, InputError> {
    let multiples = match &raw.s_filter {
        None => DEFAULT.map(f64::from).to_vec(),
        Some(given) => {
            let values: Vec<f64> = given.get_ref().iter().map(Quantity::<Pure>::value).collect();
            let is_growing = values.windows(2).all(|pair| pair[0] < pair[1]);
            if !(values.is_empty() || (FEWEST..=MOST).contains(&values.len())) || !is_growing {
                let message = format!(
                    "found {}; allowed: {FEWEST} to {MOST} multiples of the nesting index, ascending, such as [1, 2, 4, 8], or [] for \
                     no filters",
                    bracketed(&values)
                );
                return Err(file.source.error_at(given.span(), message));
            }
            values
        }
    };
    if multiples.is_empty() {
        return match &raw.nesting_index {
            None => Ok(None),
            Some(index) => {
                let message = "found a nesting index, and no filters (s-filter = []); allowed: both, or neither of them";
                Err(file.source.error_at(index.span(), message))
            }
        };
    }
    let key = raw.nesting_index.as_ref().map(Spanned::span);
    let key = key.or_else(|| raw.s_filter.as_ref().map(Spanned::span)).unwrap_or_else(|| span.clone());
    let base = raw.nesting_index.as_ref().map(|index| index.get_ref().value());
    Ok(Some(FilterPlan { multiples, base, key }))
}

/// "\[1, 2, 4\]".
fn bracketed(values: &[impl fmt::Display]) -> String {
    let names: Vec<String> = values.iter().map(ToString::to_string).collect();
    format!("[{}]", names.join(", "))
}
