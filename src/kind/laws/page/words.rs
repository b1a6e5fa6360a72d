//! Formatting of numbers by measure.

use asperity::compare::Measure;
use asperity_framework::report::format::{number, percent};

/// At most three significant digits.
pub fn short(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

/// A size in the unit of its measure: "0.12 σ", "12.3 %".
pub fn size(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => format!("{} σ", short(value.abs())),
        Measure::Area => percent(value.abs().exp_m1()),
    }
}

/// A signed difference: "-0.12", "0.891".
pub fn signed(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => short(value),
        Measure::Area => short(value.exp()),
    }
}
