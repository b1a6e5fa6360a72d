//! Why a file gives no heights.

use crate::npy::NpyError;
use crate::topography::MapError;

/// Why a file gives no heights. The caller says which file.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The file is of another format.
    #[error("{0}")]
    Mismatch(String),
    /// The format is known, what the file holds is not supported.
    #[error("{0}")]
    Unsupported(String),
    /// The file does not hold what it says it holds.
    #[error("{0}")]
    Corrupt(String),
    /// The file is a `.npy` whose array cannot be read.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// The heights make no map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A height that no roughness has.
    #[error("holds a height of {tallest:e} m; allowed: at most {TALLEST} m")]
    TooTall {
        /// The largest height, m.
        tallest: f64,
        /// Whether the format holds its unit; elsewhere another unit may be meant.
        has_unit: bool,
    },
    /// A text names its columns and their units, which are not read there.
    #[error(
        "names columns with units in line {line}: \"{found}\"; allowed: x y z, the unit given beside the file"
    )]
    UnitsInColumns {
        /// The line, from 1.
        line: usize,
        /// Text of the line.
        found: String,
    },
    /// The options contradict the file.
    #[error(transparent)]
    Options(#[from] ReadOptionsError),
}

/// Options that contradict what the file holds.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ReadOptionsError {
    /// Two pixels: one must be wrong.
    #[error(
        "is {format}, which holds its own pixel of {:e} x {:e} {}; allowed: leave pixel out",
        pixel[0], pixel[1], if *has_unit { "m" } else { "units" }
    )]
    PixelHeld {
        /// The format.
        format: &'static str,
        /// The pixel held.
        pixel: [f64; 2],
        /// Whether that is in metres.
        has_unit: bool,
    },
    /// No pixel.
    #[error("holds no pixel size, and none is given beside it")]
    NoPixel,
    /// Two units: one must be wrong.
    #[error("is {format}, which holds its own unit of length; allowed: leave unit out")]
    UnitHeld {
        /// The format.
        format: &'static str,
    },
}

/// No rough surface is so high (m): its unit is wrong.
pub(super) const TALLEST: f64 = 10.0;

/// The formats that are read.
pub(super) const FORMATS: &str = ".npy, X3P, SDF, a matrix of numbers or columns x y z as text";

pub(super) fn too_large() -> ReadError {
    ReadError::Corrupt("claims to hold more numbers than any file can".to_owned())
}

/// What was found, not too long for a message.
pub(super) fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}
