//! Formatting of numbers by measure.

use asperity::compare::Measure;
use asperity_framework::report::format::{number, percent};

/// A size in the unit of its measure: "0.12 σ", "12.3 %".
pub fn size(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => format!("{} σ", number(value.abs())),
        Measure::Area => percent(value.abs().exp_m1()),
    }
}

/// A signed difference: "-0.12", "0.891".
pub fn signed(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => number(value),
        Measure::Area => number(value.exp()),
    }
}
