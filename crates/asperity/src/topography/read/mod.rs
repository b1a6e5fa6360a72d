//! Reading measured surfaces: one module per format, identified by the first bytes of the file, not by its name.
//!
//! | module | format | stores the pixel | stores the unit |
//! |---|---|---|---|
//! | `npy` | NumPy array, whole or row by row | no | no |
//! | `text` | matrix of numbers; with Gwyddion's header | no; yes | no; yes |
//! | `xyz` | three columns of numbers | yes, in the unit | in the names of columns |
//! | `x3p` | ISO 25178-72 | yes | yes |
//! | `datx` | Zygo DATX | yes | yes |
//! | `nanoscope` | Bruker, Veeco, Digital Instruments Nanoscope | yes | yes |
//! | `sdf` | ISO 25178-71 | yes | yes |
//!
//! If the format stores its unit, a height beyond 1 km marks a missing point. Other heights beyond 10 m are rejected in
//! every format, since the unit must be wrong. The first index of a map is x; in files x runs fastest, so that all
//! formats but `.npy` are transposed. Nothing is mirrored: the first line of a file is the first y. A height far from all
//! others, such as -9999, is an error until it is stated whether it marks missing points.

mod channel;
mod columns;
mod content;
mod datx;
mod error;
mod file;
mod labels;
mod marks;
mod nanoscope;
mod npy;
mod opd;
mod sdf;
mod separation;
mod source;
mod table;
mod text;
mod x3p;
mod xyz;

use std::path::Path;

use super::{HeightMap, Rows};
use crate::progress::Progress;
use channel::{Channel, Channels};
pub use content::{ChannelName, LeftOut, LengthUnits, Measured, Metadata, NamedUnits, ReadOptions};
pub use error::{ReadError, ReadOptionsError};
pub use file::MapFile;
use source::Source;

/// A format of files.
struct Format {
    /// With an article, as in "is an SDF file".
    name: &'static str,
    /// Whether a file is of this format, by its content.
    is: fn(&Source) -> bool,
    read: Reader,
}

/// How a format is read.
enum Reader {
    /// One map, or what its user says of it.
    Map {
        metadata: fn(&Path) -> Result<Metadata, ReadError>,
        measured: fn(&Path) -> Result<Measured, ReadError>,
    },
    /// Several channels, of which one is chosen.
    Channels(fn(&Source) -> Result<Vec<Channel>, ReadError>),
}

/// All formats, in the order in which a file is tried: texts last.
static FORMATS: &[&Format] =
    &[&datx::FORMAT, &nanoscope::FORMAT, &npy::FORMAT, &opd::FORMAT, &sdf::FORMAT, &x3p::FORMAT, &text::FORMAT];

impl Format {
    fn detect(source: &Source) -> Result<&'static Self, ReadError> {
        let begin = source.begin();
        if let Some(found) = FORMATS.iter().find(|format| (format.is)(source)) {
            return Ok(found);
        }
        if begin.starts_with(b"\xff\xfe") || begin.starts_with(b"\xfe\xff") {
            return Err(ReadError::Unsupported("is a text in UTF-16; allowed: UTF-8 or Latin-1".to_owned()));
        }
        let bytes: String = begin.iter().take(12).map(|byte| byte.escape_ascii().to_string()).collect();
        Err(ReadError::Mismatch(format!(
            "is not a height map: it begins with \"{bytes}\"; allowed: {}",
            Self::names()
        )))
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
        return Err(ReadError::Mismatch("is not a file".to_owned()));
    }
    if metadata.len() == 0 {
        return Err(ReadError::Corrupt("is empty".to_owned()));
    }
    Ok(())
}
