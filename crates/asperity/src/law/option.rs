//! Options of a law.

use std::ops::{Bound, RangeBounds};

/// A parameter of a law that can be set by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawOption {
    /// The key in specs and tables.
    pub name: &'static str,
    /// Symbol and meaning.
    pub about: &'static str,
    /// The default value.
    pub default: f64,
    /// An example value, for messages.
    pub example: f64,
    /// The range of allowed values.
    pub range: (Bound<f64>, Bound<f64>),
    /// The range in words, for errors.
    pub allowed: &'static str,
}

impl LawOption {
    /// Checks whether `value` is in the range.
    ///
    /// # Errors
    /// [`OptionError::OutOfRange`]
    pub fn check(&self, value: f64) -> Result<(), OptionError> {
        if self.range.contains(&value) {
            return Ok(());
        }
        Err(OptionError::OutOfRange { option: self.name, value, allowed: self.allowed })
    }
}

/// An option that cannot be set.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum OptionError {
    /// The value is out of the option's range.
    #[error("{option} {value}; allowed: {allowed}")]
    OutOfRange { option: &'static str, value: f64, allowed: &'static str },
    /// The law has other options.
    #[error("the key `{option}`; allowed: {allowed}")]
    Unknown { option: String, allowed: String },
    /// The law has no options.
    #[error("the option `{option}`; allowed: none, as this law has no options")]
    NoOptions { option: String },
}
