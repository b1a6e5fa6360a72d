//! Reading measured surfaces: one module per format, identified by the content of a file, not by its name. `docs/formats.md` says what
//! of each format is read.
//!
//! | module | format | |
//! |---|---|---|
//! | `npy` | NumPy array, whole or row by row | heights only |
//! | `text`, `xyz` | matrix of numbers, with or without the header of a program; three columns of numbers | one map |
//! | `nanoscope_text` | what Nanoscope exports as text | a list of channels |
//! | `x3p`, `sdf` | ISO 25178-72, ISO 25178-71 | one map, with pixel and unit |
//! | `al3d`, `bcr`, `datx`, `gsf`, `gwy`, `ibw`, `jpk`, `metropro`, `nanoscope`, `nid`, `opd`, `park`, `plu`, `sur`, `vk` | files of instruments and of Gwyddion | a list of channels, with pixel and unit, of which the heights are chosen, or one by its name |
//!
//! If the file states its unit, a height beyond 1 km marks a missing point. Other heights beyond 10 m are rejected in
//! every format, since the unit must be wrong. The first index of a map is x; in files x runs fastest, so that all
//! formats but `.npy` are transposed. The first y is the first line of a text, X3P or SDF, and of instruments the top line of the picture. A
//! height far from all others, such as -9999, is an error until it is stated whether it marks missing points.

/// The errors of a damaged file, of a content that is not read, and of a file of another kind, with the text of `format!`.
macro_rules! corrupt {
    ($($text:tt)*) => { ReadError::Corrupt(std::fmt::format(format_args!($($text)*))) };
}
macro_rules! unsupported {
    ($($text:tt)*) => { ReadError::Unsupported(std::fmt::format(format_args!($($text)*))) };
}
macro_rules! mismatch {
    ($($text:tt)*) => { ReadError::Mismatch(std::fmt::format(format_args!($($text)*))) };
}

mod al3d;
mod bcr;
mod channel;
mod content;
mod datx;
mod error;
mod file;
mod gsf;
mod gwy;
mod ibw;
mod jpk;
mod labels;
mod marks;
mod metropro;
mod nanoscope;
mod nanoscope_text;
mod nid;
mod npy;
mod opd;
mod park;
mod plu;
mod sdf;
mod source;
mod sur;
mod table;
mod tags;
mod text;
mod vk;
mod x3p;
mod xyz;

use std::path::Path;

use super::{HeightMap, Rows};
use crate::progress::Progress;
use channel::{Channel, Channels};
pub use content::{
    ChannelName, LeftOut, LengthUnits, Measured, Metadata, NamedUnits, OtherChannel, ReadOptions, UnitOrigin,
};
pub use error::{ReadError, ReadOptionsError};
pub use file::{Crop, MapFile, Marks};
pub(super) use gwy::PIXEL as PIXEL_OF_GWY;
use source::Source;

/// A format of files.
struct Format {
    /// With an article, as in "is an SDF file".
    name: &'static str,
    /// Usual endings of names of its files; `000` stands for any number of three digits.
    endings: &'static [&'static str],
    /// Whether a file is of this format, by its content.
    is: fn(&Source) -> bool,
    read: Reader,
}

/// How a format is read.
enum Reader {
    /// One map, or what its user says of it.
    Map {
        metadata: fn(&Source) -> Result<Metadata, ReadError>,
        measured: fn(&Source) -> Result<Measured, ReadError>,
    },
    /// Several channels, of which one is chosen.
    Channels(fn(&Source) -> Result<Vec<Channel>, ReadError>),
}

/// How a file of a format that is not read becomes one that is.
const CONVERTER: &str = "Gwyddion reads most formats and writes .gwy; the Python package SurfaceTopography reads some more and writes X3P: python -m pip install SurfaceTopography, then \
     SurfaceTopography.read_topography(\"FILE\").to_x3p(\"FILE.x3p\")";

/// All formats, in the order in which a file is tried: texts last.
static FORMATS: &[&Format] = &[
    &npy::FORMAT,
    &al3d::FORMAT,
    &bcr::FORMAT,
    &datx::FORMAT,
    &gsf::FORMAT,
    &gwy::FORMAT,
    &ibw::FORMAT,
    &jpk::FORMAT,
    &metropro::FORMAT,
    &nanoscope_text::FORMAT,
    &nanoscope::FORMAT,
    &nid::FORMAT,
    &opd::FORMAT,
    &park::FORMAT,
    &plu::FORMAT,
    &sdf::FORMAT,
    &sur::FORMAT,
    &vk::FORMAT,
    &x3p::FORMAT,
    &text::FORMAT,
];

impl Format {
    fn detect(source: &Source) -> Result<&'static Self, ReadError> {
        let begin = source.begin();
        if let Some(found) = FORMATS.iter().find(|format| (format.is)(source)) {
            return Ok(found);
        }
        if tags::is_tiff(source) {
            return Err(tags::refused(source));
        }
        let bytes: String = begin.iter().take(12).map(|byte| byte.escape_ascii().to_string()).collect();
        Err(mismatch!("is not a height map: it begins with \"{bytes}\"; {}", Self::allowed()))
    }

    /// What is read, and what converts other formats.
    fn allowed() -> String {
        format!("allowed: {}. {CONVERTER}", Self::names())
    }

    /// The formats, as a message lists them.
    fn names() -> String {
        let short = |format: &&Self| {
            let name = format.name.trim_start_matches("an ").trim_start_matches("a ");
            name.trim_end_matches(" file").to_owned()
        };
        FORMATS.iter().map(short).collect::<Vec<_>>().join(", ")
    }
}

/// Size, pixel and format from the header of a file, checked against its length. A text is read completely.
///
/// # Errors
/// Those of [`height_map`] that follow from the header and the length of the file.
pub fn metadata(path: &Path) -> Result<Metadata, ReadError> {
    MapFile::new(path, ReadOptions::default()).metadata()
}

/// Usual endings of names of files of maps, in lower case; `000` stands for any number of three digits. What a file holds is found by
/// its content.
pub fn endings() -> impl Iterator<Item = &'static str> {
    FORMATS.iter().flat_map(|format| format.endings).copied()
}

/// Whether names of files of maps usually end like that of `path`.
pub fn is_named_as_map(path: &Path) -> bool {
    let Some(ending) = path.extension() else { return false };
    let bytes = ending.as_encoded_bytes();
    let is_number = bytes.len() == 3 && bytes.iter().all(u8::is_ascii_digit);
    endings().any(|known| if is_number { known == "000" } else { ending.eq_ignore_ascii_case(known) })
}

/// The formats of maps that are read, for a person.
pub fn format_names() -> String {
    Format::names()
}

/// Reads a map of heights in metres, relative to the offset of its file ([`Rows::offset`]), with the pixel and unit of
/// `options` if the format does not store them; [`MapFile`] says more of a file.
///
/// # Errors
/// See [`ReadError`].
pub fn height_map(path: &Path, options: ReadOptions) -> Result<HeightMap, ReadError> {
    MapFile::new(path, options).height_map()
}

/// Opens a map for reading by rows, see [`MapFile::rows`].
///
/// # Errors
/// As [`height_map`].
pub fn rows(path: &Path, options: ReadOptions, progress: &dyn Progress) -> Result<Box<dyn Rows>, ReadError> {
    MapFile::new(path, options).rows(progress)
}

/// Checks that a path is a file that is not empty.
///
/// # Errors
/// A path that is not a file; an empty file.
pub fn existing(path: &Path) -> Result<(), ReadError> {
    let metadata = std::fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(mismatch!("is not a file"));
    }
    if metadata.len() == 0 {
        return Err(corrupt!("is empty"));
    }
    Ok(())
}
