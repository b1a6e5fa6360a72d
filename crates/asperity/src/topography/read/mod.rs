//! Reading measured surfaces: one module per format, identified by the first bytes of the file, not by its name.
//!
//! | module | format | stores the pixel | stores the unit |
//! |---|---|---|---|
//! | `npy` | NumPy array, whole or row by row | no | no |
//! | `text` | matrix of numbers; with Gwyddion's header | no; yes | no; yes |
//! | `xyz` | three columns of numbers | yes, in the unit | in the names of columns |
//! | `x3p` | ISO 25178-72 | yes | yes |
//! | `sdf` | ISO 25178-71 | yes | yes |
//!
//! If the format stores its unit, a height beyond 1 km marks a missing point. Other heights beyond 10 m are rejected in
//! every format, since the unit must be wrong. The first index of a map is x; in files x runs fastest, so that all
//! formats but `.npy` are transposed. Nothing is mirrored: the first line of a file is the first y. A height far from all
//! others, such as -9999, is an error until it is stated whether it marks missing points.

mod columns;
mod content;
mod error;
mod file;
mod labels;
mod marks;
mod npy;
mod sdf;
mod separation;
mod table;
mod text;
mod x3p;
mod xyz;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{HeightMap, Rows};
use crate::npy as array;
use crate::progress::Progress;
pub use content::{LeftOut, LengthUnits, Measured, Metadata, NamedUnits, ReadOptions};
use error::FORMATS;
pub use error::{ReadError, ReadOptionsError};
pub use file::MapFile;

/// The formats, identified by their first bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Npy,
    Sdf,
    Text,
    X3p,
}

impl Format {
    fn detect(path: &Path) -> Result<Self, ReadError> {
        existing(path)?;
        let mut begin = Vec::new();
        File::open(path)?.take(BEGIN).read_to_end(&mut begin)?;
        if begin.starts_with(array::MAGIC) {
            Ok(Self::Npy)
        } else if sdf::is_sdf(&begin) {
            Ok(Self::Sdf)
        } else if begin.starts_with(x3p::MAGIC) {
            Ok(Self::X3p)
        } else if begin.starts_with(b"\xff\xfe") || begin.starts_with(b"\xfe\xff") {
            Err(ReadError::Unsupported("is a text in UTF-16; allowed: UTF-8 or Latin-1".to_owned()))
        } else if begin.iter().all(|&byte| byte >= b' ' || byte.is_ascii_whitespace()) {
            Ok(Self::Text)
        } else {
            Err(ReadError::Mismatch(format!(
                "is not a height map: it begins with \"{}\"; allowed: {FORMATS}",
                begin
                    .iter()
                    .take(12)
                    .copied()
                    .map(|byte| byte.escape_ascii().to_string())
                    .collect::<String>()
            )))
        }
    }
}

/// Bytes that identify the format.
const BEGIN: u64 = 4096;

/// Size, pixel and format from the header of a file, checked against its length. A text is read completely.
///
/// # Errors
/// Those of [`height_map`] that follow from the header and the length of the file.
pub fn metadata(path: &Path) -> Result<Metadata, ReadError> {
    match Format::detect(path)? {
        Format::Npy => npy::metadata(path),
        Format::Sdf => sdf::metadata(path),
        Format::Text => Ok(text::measured(path)?.metadata),
        Format::X3p => x3p::metadata(path),
    }
}

/// Reads a map as stored in its file.
///
/// # Errors
/// See [`ReadError`].
pub fn measured(path: &Path) -> Result<Measured, ReadError> {
    match Format::detect(path)? {
        Format::Npy => npy::measured(path),
        Format::Sdf => sdf::measured(path),
        Format::Text => text::measured(path),
        Format::X3p => x3p::measured(path),
    }
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
