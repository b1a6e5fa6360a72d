//! Grids of boundary elements: what several kinds check and estimate.

use std::ops::{Range, RangeInclusive};

use asperity::bem::{Boundary, Solver};
use asperity_contact_framework::input::{InputError, SpecFile};

/// Pixels per contact radius of a sphere: fewer show no circle.
pub const PIXELS: RangeInclusive<f64> = 4.0..=400.0;

/// Refuses values outside a range; `{}` in `allowed` stands for it.
pub fn check_range(
    file: &SpecFile,
    span: Range<usize>,
    values: &[f64],
    range: &RangeInclusive<f64>,
    allowed: &str,
) -> Result<(), InputError> {
    let Some(value) = values.iter().find(|value| !range.contains(value)) else { return Ok(()) };
    let message = format!("found {value}; allowed: {}", allowed.replace("{}", &range_words(range)));
    Err(file.source.error_at(span, message))
}

/// "4 to 400"
pub fn range_words(range: &RangeInclusive<f64>) -> String {
    let plain = |value: f64| if value.abs() < 1e-3 { format!("{value:e}") } else { value.to_string() };
    format!("{} to {}", plain(*range.start()), plain(*range.end()))
}

/// Ascending values rounded to whole numbers, each once.
pub fn whole(values: &[f64]) -> Vec<usize> {
    let mut whole: Vec<usize> = values.iter().map(|value| value.round() as usize).collect();
    whole.dedup();
    whole
}

/// Bytes of a square map, its heights before they are scaled, and its solver.
pub fn contact_memory(points: usize, boundary: Boundary) -> u128 {
    16 * (points as u128).pow(2) + Solver::memory([points; 2], boundary)
}
