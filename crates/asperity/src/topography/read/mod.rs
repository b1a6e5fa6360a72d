//! Reading measured surfaces: one module per format, identified by the first bytes of the file, not by its name.
//!
//! | module | format | stores the pixel | stores the unit |
//! |---|---|---|---|
//! | `npy` | NumPy array, whole or row by row | no | no |
//! | `text` | matrix of numbers; with Gwyddion's header | no; yes | no; yes |
//! | `xyz` | three columns of numbers | yes, in the unit | no |
//! | `x3p` | ISO 25178-72 | yes | yes |
//! | `sdf` | ISO 25178-71 | yes | yes |
//!
//! If the format stores its unit, a height beyond 1 km marks a missing point. Other heights beyond 10 m are rejected in
//! every format, since the unit must be wrong. The first index of a map is x; in files x runs fastest, so that all
//! formats but `.npy` are transposed. Nothing is mirrored: the first line of a file is the first y.

mod content;
mod error;
mod npy;
mod sdf;
mod table;
mod text;
mod x3p;
mod xyz;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{HeightMap, MapError, Rows, Watched, rows};
use crate::npy::{self as array, Mapped};
use crate::numeric::LARGEST;
use crate::progress::Progress;
pub use content::{Measured, Metadata, ReadOptions};
use error::{FORMATS, MAX_HEIGHT};
pub use error::{ReadError, ReadOptionsError};
use npy::MappedMap;

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

/// Reads a map of heights in metres, relative to the offset of its file ([`Rows::offset`]), with the pixel and unit of `options` if the format does not store them.
///
/// # Errors
/// See [`ReadError`].
pub fn height_map(path: &Path, options: ReadOptions) -> Result<HeightMap, ReadError> {
    let Measured { metadata, mut heights, offset, mut precision } = measured(path)?;
    let pixel = metadata.pixel(&options)?;
    let unit = metadata.unit(&options);
    if unit != 1.0 {
        precision = precision.max(f64::EPSILON);
    }
    check_heights(&mut heights, unit, metadata.has_unit)?;
    Ok(HeightMap::new(metadata.points, pixel, heights, precision)?.with_offset(offset * unit))
}

/// Whether [`rows()`] leaves a map on disk: a `.npy` in C order.
///
/// # Errors
/// As [`metadata`].
pub fn stays_on_disk(path: &Path) -> Result<bool, ReadError> {
    Ok(Format::detect(path)? == Format::Npy && !array::Header::read(path)?.is_fortran())
}

/// Opens a map for reading by rows. One that stays on disk ([`stays_on_disk`]) may be larger than memory; its heights are
/// checked, one unit of work for `progress`.
///
/// # Errors
/// As [`height_map`].
pub fn rows(path: &Path, options: ReadOptions, progress: &dyn Progress) -> Result<Box<dyn Rows>, ReadError> {
    let map = unchecked_rows(path, options)?;
    if stays_on_disk(path)? {
        check_rows(&Watched { map: &*map, progress })?;
    }
    Ok(map)
}

/// The same without reading the heights of a map that stays on disk: of one that is read in parts, which are checked with
/// [`check_rows`] each.
///
/// # Errors
/// As [`height_map`].
pub fn unchecked_rows(path: &Path, options: ReadOptions) -> Result<Box<dyn Rows>, ReadError> {
    if !stays_on_disk(path)? {
        return Ok(Box::new(height_map(path, options)?));
    }
    let metadata = npy::metadata(path)?;
    let array = Mapped::open(path)?;
    Ok(Box::new(MappedMap { array, pixel: metadata.pixel(&options)?, unit: metadata.unit(&options) }))
}

/// Checks size, units and heights of a map, or of a part of one, that was read row by row.
///
/// # Errors
/// As [`height_map`]; [`MapError::AllMissing`] without a single height.
pub fn check_rows(map: &dyn Rows) -> Result<(), ReadError> {
    HeightMap::check_grid(map.points(), map.pixel())?;
    let tallest = |strip: rows::Strip| {
        let heights = (0..strip.count as isize).filter_map(|k| strip.row(k)).flatten();
        heights.filter(|z| !z.is_nan()).map(|z| z.abs()).reduce(f64::max)
    };
    match rows::strips(map, 0, tallest).into_iter().flatten().reduce(f64::max) {
        None => Err(MapError::AllMissing.into()),
        Some(tallest) if tallest > MAX_HEIGHT => Err(ReadError::TooTall { tallest, has_unit: false }),
        Some(_) => Ok(()),
    }
}

/// Replaces marks of missing points by NaN, converts heights from the unit of their file to metres, and rejects those
/// too large for a rough surface.
fn check_heights(heights: &mut [f64], unit: f64, has_unit: bool) -> Result<(), ReadError> {
    /// A larger height in metres marks a missing point, such as 1e10.
    const MARK: f64 = 1e3;
    let mark = if has_unit { MARK } else { LARGEST };
    let mut tallest = 0.0f64;
    for z in heights {
        if z.abs() <= mark {
            *z *= unit;
            tallest = tallest.max(z.abs());
        } else {
            *z = f64::NAN;
        }
    }
    if tallest > MAX_HEIGHT { Err(ReadError::TooTall { tallest, has_unit }) } else { Ok(()) }
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
