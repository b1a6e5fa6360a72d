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
pub enum OptionError {
    /// The value is out of the option's range.
    #[error("{option} {value}; allowed: {allowed}")]
    OutOfRange {
        /// The option.
        option: &'static str,
        /// The value that was given.
        value: f64,
        /// The range in words.
        allowed: &'static str,
    },
    /// The law has other options.
    #[error("the key `{option}`; allowed: {allowed}")]
    Unknown {
        /// The name that was given.
        option: String,
        /// The options of the law.
        allowed: String,
    },
    /// The law has no options.
    #[error("the option `{option}`; allowed: none, as this law has no options")]
    NoOptions {
        /// The name that was given.
        option: String,
    },
}
