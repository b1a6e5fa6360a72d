//! What a user may set of a law.

use std::ops::{Bound, RangeBounds};

/// A number that a user may set of a law by its name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawOption {
    /// Its key, as specs and tables write it.
    pub name: &'static str,
    /// Symbol and meaning.
    pub about: &'static str,
    /// Its value where none is given.
    pub default: f64,
    /// A value that a user might give, for messages.
    pub example: f64,
    /// All values that it may have.
    pub range: (Bound<f64>, Bound<f64>),
    /// The range in words, for errors.
    pub allowed: &'static str,
}

impl LawOption {
    /// Whether it may have this value.
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
    #[error("the option `{option}`; allowed: none of this law")]
    NoOptions {
        /// The name that was given.
        option: String,
    },
}
