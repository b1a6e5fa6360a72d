//! Reading measured surfaces: one module per format, identified by the first bytes, never by a file's name.
//!
//! | module | format | holds its pixel | holds its unit |
//! |---|---|---|---|
//! | `npy` | NumPy array, whole or row by row | no | no |
//! | `text` | matrix of numbers; with Gwyddion's header | no; yes | no; yes |
//! | `xyz` | three columns of numbers | yes, in the unit | no |
//! | `x3p` | ISO 25178-72 | yes | yes |
//! | `sdf` | ISO 25178-71 | yes | yes |
//!
//! Where a format holds its unit, a height beyond 1 km is the mark of a missing point. Heights beyond
//! 10 m that are left are refused in every format: there a unit is wrong. The first index of a map is
//! x; files have x running fastest, so that all but `.npy` are transposed. Nothing is mirrored: the
//! first line of a file is the first y.

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

use super::{HeightMap, MapError, Rows, rows};
use crate::npy::{self as array, Mapped};
use crate::numeric::LARGEST;
pub use content::{Measured, Metadata, ReadOptions};
use error::{FORMATS, TALLEST};
pub use error::{ReadError, ReadOptionsError};
use npy::MappedMap;

/// The formats, as their first bytes tell them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Npy,
    Sdf,
    Text,
    X3p,
}

impl Format {
    fn of(path: &Path) -> Result<Self, ReadError> {
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
                "is no height map: it begins with \"{}\"; allowed: {FORMATS}",
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

/// What the header of a file says, checked against its length. A text is read as a whole.
///
/// # Errors
/// As [`height_map`], as far as the header and the length of the file tell.
pub fn metadata(path: &Path) -> Result<Metadata, ReadError> {
    match Format::of(path)? {
        Format::Npy => npy::metadata(path),
        Format::Sdf => sdf::metadata(path),
        Format::Text => Ok(text::measured(path)?.metadata),
        Format::X3p => x3p::metadata(path),
    }
}

/// Reads a map as its file holds it.
///
/// # Errors
/// See [`ReadError`].
pub fn measured(path: &Path) -> Result<Measured, ReadError> {
    match Format::of(path)? {
        Format::Npy => npy::measured(path),
        Format::Sdf => sdf::measured(path),
        Format::Text => text::measured(path),
        Format::X3p => x3p::measured(path),
    }
}

/// Reads a map of heights in metres, with the pixel and the unit of `options` where its format holds none.
///
/// # Errors
/// See [`ReadError`].
pub fn height_map(path: &Path, options: ReadOptions) -> Result<HeightMap, ReadError> {
    let Measured { metadata, mut heights, mut precision } = measured(path)?;
    let pixel = metadata.pixel(&options)?;
    let unit = metadata.unit(&options);
    if unit != 1.0 {
        precision = precision.max(f64::EPSILON);
    }
    check_heights(&mut heights, unit, metadata.has_unit)?;
    Ok(HeightMap::new(metadata.points, pixel, heights, precision)?)
}

/// Whether [`rows()`] leaves a map on disk: a `.npy` in C order.
///
/// # Errors
/// As [`metadata`].
pub fn stays_on_disk(path: &Path) -> Result<bool, ReadError> {
    Ok(Format::of(path)? == Format::Npy && !array::Header::read(path)?.is_fortran())
}

/// Opens a map without reading more of it than must be: one that stays on disk is read row by row, whatever its
/// size.
///
/// # Errors
/// As [`height_map`].
pub fn rows(path: &Path, options: ReadOptions) -> Result<Box<dyn Rows>, ReadError> {
    if !stays_on_disk(path)? {
        return Ok(Box::new(height_map(path, options)?));
    }
    let metadata = npy::metadata(path)?;
    let array = Mapped::open(path)?;
    let map = MappedMap { array, pixel: metadata.pixel(&options)?, unit: metadata.unit(&options) };
    check_rows(&map)?;
    Ok(Box::new(map))
}

/// As [`check_heights`] and [`HeightMap::new`], row by row.
fn check_rows(map: &dyn Rows) -> Result<(), ReadError> {
    HeightMap::check_grid(map.points(), map.pixel())?;
    let tallest = |strip: rows::Strip| {
        let heights = (0..strip.count as isize).filter_map(|k| strip.row(k)).flatten();
        heights.filter(|z| !z.is_nan()).map(|z| z.abs()).reduce(f64::max)
    };
    match rows::strips(map, 0, tallest).into_iter().flatten().reduce(f64::max) {
        None => Err(MapError::AllMissing.into()),
        Some(tallest) if tallest > TALLEST => Err(ReadError::TooTall { tallest, has_unit: false }),
        Some(_) => Ok(()),
    }
}

/// Takes out the marks of missing points, brings heights from the unit of their file to metres, and refuses those that
/// no roughness has.
fn check_heights(heights: &mut [f64], unit: f64, has_unit: bool) -> Result<(), ReadError> {
    /// Beyond it a height in metres is the mark of a missing point, such as 1e10.
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
    if tallest > TALLEST { Err(ReadError::TooTall { tallest, has_unit }) } else { Ok(()) }
}

/// Checks that a path is a file and not empty.
///
/// # Errors
/// A path that is no file, or an empty one.
pub fn existing(path: &Path) -> Result<(), ReadError> {
    let metadata = std::fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(ReadError::Mismatch("is no file".to_owned()));
    }
    if metadata.len() == 0 {
        return Err(ReadError::Corrupt("is empty".to_owned()));
    }
    Ok(())
}
