//! Errors in reading a map.

use std::borrow::Cow;

use crate::legible::legible;
use crate::npy::NpyError;
use crate::topography::MapError;

/// An error in reading a map. Texts are predicates without the file name: "is empty".
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The format of the file is not known.
    #[error("{}", shown(.0))]
    Mismatch(String),
    /// The format is known, but the content is not supported.
    #[error("{}", shown(.0))]
    Unsupported(String),
    /// A word stands in place of a number in a text.
    #[error(
        "line {line}, column {column}: found \"{}\"; allowed: a number, or NaN, BAD or nothing for a missing point",
        shown(word)
    )]
    Word { line: usize, column: usize, word: String },
    /// The channel that is named is not there, or holds no heights.
    #[error("{}; allowed: {}", shown(reason), shown(found))]
    Channel { reason: String, found: String },
    /// Words mark missing points of a file of numbers.
    #[error("is {format}, which holds numbers only; allowed: numbers for its missing points")]
    NoWords { format: &'static str },
    /// A channel is named of a file that holds one map.
    #[error("is {format}, which holds one map; allowed: leave channel out")]
    NoChannels { format: &'static str },
    /// The content is inconsistent or damaged.
    #[error("{}", shown(.0))]
    Corrupt(String),
    /// The file is a `.npy` whose array cannot be read.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// The heights form no valid map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A height too large for a rough surface.
    #[error("holds a height of {tallest:e} m; allowed: at most {MAX_HEIGHT} m")]
    TooTall { tallest: f64 },
    /// A height far from all others, which marks missing points.
    #[error(
        "holds the height {value} at {count} {}, far from all other heights ({low} to {high}): a mark of missing points?",
        if *count == 1 { "point" } else { "points" }
    )]
    Mark { value: f64, count: usize, low: f64, high: f64 },
    /// A part that is not within the map.
    #[error(
        "is {side:e} m long along {axis}, and the part from {:e} to {:e} m is not within it or holds fewer than three points, \
         {pixel:e} m apart",
        ends[0], ends[1]
    )]
    Crop { axis: &'static str, ends: [f64; 2], side: f64, pixel: f64 },
    /// The options leave open what the file does not state.
    #[error(transparent)]
    Options(#[from] ReadOptionsError),
}

/// What the file leaves open and the options do not say.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadOptionsError {
    /// Neither the file nor the options give a pixel.
    #[error("holds no pixel size, and none is given")]
    NoPixel,
    /// A file that states the unit of its pixel states none of its heights.
    #[error("holds heights without a unit{}", channel.as_ref().map_or_else(String::new, |name| format!(" in \"{}\"", shown(name))))]
    NoUnit {
        /// The channel of the heights, where there may be several.
        channel: Option<String>,
    },
    /// Names of columns in a text with units that are not clear, where the options give none.
    #[error(
        "names columns with units in line {line}: \"{}\"; allowed: one unit of length for x and y and one for z, as in x [um] \
         y [um] z [nm], or the units given separately",
        shown(found)
    )]
    UnitsInColumns {
        /// Line number, from 1.
        line: usize,
        /// Text of the line.
        found: String,
    },
}

/// The largest height allowed, m: beyond it the unit is wrong.
pub(super) const MAX_HEIGHT: f64 = 10.0;

pub(super) fn too_large() -> ReadError {
    corrupt!("claims to hold more numbers than any file can")
}

/// A text with parts of a file, as a message shows it.
fn shown(text: &str) -> Cow<'_, str> {
    legible(text, 1000)
}

/// A text shortened for a message.
pub(super) fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}
