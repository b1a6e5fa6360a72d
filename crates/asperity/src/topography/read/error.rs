//! Errors in reading a map.

use std::borrow::Cow;

use super::content::LengthUnits;
use crate::legible::legible;
use crate::npy::NpyError;
use crate::topography::MapError;
use crate::units::Dimension;

/// An error in reading a map. Texts are predicates without the file name: "is empty".
#[derive(Debug, thiserror::Error)]
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
    /// Lines of words or sizes stand above the numbers of a text.
    #[error(
        "begins with {} that hold{} no row of the table (line {line}: \"{}\"), the table begins in line {begin}; allowed: a table \
         only, below lines that begin with #",
        if *begin == line + 1 { "a line".to_owned() } else { format!("{} lines", begin - line) },
        if *begin == line + 1 { "s" } else { "" },
        shown(found),
    )]
    Heading {
        /// The first of these lines, from 1.
        line: usize,
        /// Its text.
        found: String,
        /// The line in which the table begins.
        begin: usize,
    },
    /// The channel that is named is not there, or holds no heights.
    #[error("{}; allowed: {}", shown(reason), shown(found))]
    Channel {
        /// What is wrong with it.
        reason: String,
        /// The channels of the file.
        found: String,
    },
    /// A channel is named of a file that holds one map.
    #[error("is {format}, which holds one map; allowed: leave channel out")]
    NoChannels {
        /// Name of the format.
        format: &'static str,
    },
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
    TooTall {
        /// The largest height, m.
        tallest: f64,
        /// Whether the format stores its unit; otherwise the unit given may be wrong.
        has_unit: bool,
    },
    /// A height far from all others, which marks missing points.
    #[error(
        "holds the height {value} at {count} {}, far from all other heights ({low} to {high}): a mark of missing points?",
        if *count == 1 { "point" } else { "points" }
    )]
    Mark {
        /// The height, in the unit of the file.
        value: f64,
        /// At how many points it stands.
        count: usize,
        /// The lowest of the other heights, in the unit of the file.
        low: f64,
        /// The highest of the other heights.
        high: f64,
    },
    /// A part that is not within the map.
    #[error(
        "is {side:e} m long along {axis}, and the part from {:e} to {:e} m is not within it or holds fewer than three points, \
         {pixel:e} m apart",
        ends[0], ends[1]
    )]
    Crop {
        /// x or y.
        axis: &'static str,
        /// Ends of the part, m.
        ends: [f64; 2],
        /// Length of the map, m.
        side: f64,
        /// Distance of its points, m.
        pixel: f64,
    },
    /// The options contradict the file.
    #[error(transparent)]
    Options(#[from] ReadOptionsError),
}

/// Options that contradict the content of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadOptionsError {
    /// Both the file and the options give a pixel.
    #[error(
        "is {format}, which holds its own pixel of {:e} x {:e} {}; allowed: leave pixel out",
        pixel[0], pixel[1], if *has_unit { "m" } else { "units" }
    )]
    PixelHeld {
        /// Name of the format.
        format: &'static str,
        /// The pixel of the file.
        pixel: [f64; 2],
        /// Whether it is in metres.
        has_unit: bool,
    },
    /// Neither the file nor the options give a pixel.
    #[error("holds no pixel size, and none is given")]
    NoPixel,
    /// Names of columns in the file and the options give different units.
    #[error(
        "names the units of its columns (x and y in {}, z in {}), and the unit given is {}; allowed: leave unit out, or correct \
         the names of the columns",
        name_of(named.xy), name_of(named.z),
        if given.xy == given.z { name_of(given.xy) } else { format!("{} of x and y, {} of z", name_of(given.xy), name_of(given.z)) }
    )]
    UnitNamed {
        /// The units that the columns name.
        named: LengthUnits,
        /// The units that the options give.
        given: LengthUnits,
    },
    /// Both the file and the options give a unit.
    #[error("is {format}, which holds its own unit of length; allowed: leave unit out")]
    UnitHeld {
        /// Name of the format.
        format: &'static str,
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

/// The name of a unit of length, m.
fn name_of(unit: f64) -> String {
    let length = Dimension::Length;
    let found = length.documented().iter().find(|name| length.factor(name) == Some(unit));
    found.map_or_else(|| format!("{unit:e} m"), |name| (*name).to_owned())
}

/// The largest height allowed, m: beyond it the unit is wrong.
pub(super) const MAX_HEIGHT: f64 = 10.0;

pub(super) fn too_large() -> ReadError {
    ReadError::Corrupt("claims to hold more numbers than any file can".to_owned())
}

/// A text with parts of a file, as a message shows it.
fn shown(text: &str) -> Cow<'_, str> {
    legible(text, 1000)
}

/// A text shortened for a message.
pub(super) fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}
