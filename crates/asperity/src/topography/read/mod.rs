//! Reading measured surfaces: one file a format, told apart by the first bytes, never by a file's name.
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
use crate::npy::{self as array, Mapped, NpyError};
use crate::numeric::LARGEST;
use npy::MappedMap;

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
        /// What stands in it.
        found: String,
    },
    /// What is given beside the file does not go with it.
    #[error(transparent)]
    Given(#[from] GivenError),
}

/// What is given beside a file does not go with what it holds.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum GivenError {
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

/// What the head of a file says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Distance of neighbouring points along x and y, where the format holds it: in metres where it
    /// holds its unit, in the unit of the file where it does not.
    pub pixel: Option<[f64; 2]>,
    /// Whether the format holds its unit of length.
    pub has_unit: bool,
    /// What the format is called.
    pub format: &'static str,
}

/// What is given beside a file that does not hold it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Given {
    /// Distance of neighbouring points along x and y, m.
    pub pixel: Option<[f64; 2]>,
    /// Unit of all lengths in the file, m; a metre if it is not given.
    pub unit: Option<f64>,
}

impl Head {
    /// The pixel along x and y, m.
    ///
    /// # Errors
    /// See [`GivenError`].
    pub fn pixel(&self, given: &Given) -> Result<[f64; 2], GivenError> {
        let Self { format, has_unit, .. } = *self;
        if has_unit && given.unit.is_some() {
            return Err(GivenError::UnitHeld { format });
        }
        match (self.pixel, given.pixel) {
            (Some(pixel), Some(_)) => Err(GivenError::PixelHeld { format, pixel, has_unit }),
            (Some(pixel), None) => Ok(pixel.map(|size| size * self.unit(given))),
            (None, Some(pixel)) => Ok(pixel),
            (None, None) => Err(GivenError::NoPixel),
        }
    }

    fn unit(&self, given: &Given) -> f64 {
        if self.has_unit { 1.0 } else { given.unit.unwrap_or(1.0) }
    }
}

/// A map as a file holds it.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Size, pixel and unit.
    pub head: Head,
    /// Heights, the y index running fastest; in metres where the format holds its unit, in the unit of
    /// the file where it does not. Missing points are NaN.
    pub heights: Vec<f64>,
    /// Relative precision of the stored numbers; 0 for integers that are not scaled.
    pub precision: f64,
}

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

/// Bytes that are looked at to tell the formats apart.
const BEGIN: u64 = 4096;
const FORMATS: &str = ".npy, X3P, SDF, a matrix of numbers or columns x y z as text";

/// What the head of a file says, checked against its length. A text is read as a whole.
///
/// # Errors
/// As [`height_map`], as far as the head and the length of the file tell.
pub fn head(path: &Path) -> Result<Head, ReadError> {
    match Format::of(path)? {
        Format::Npy => npy::head(path),
        Format::Sdf => sdf::head(path),
        Format::Text => Ok(text::measured(path)?.head),
        Format::X3p => x3p::head(path),
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

/// Reads a map of heights in metres, with the pixel and the unit `given` where its format holds none.
///
/// # Errors
/// See [`ReadError`].
pub fn height_map(path: &Path, given: Given) -> Result<HeightMap, ReadError> {
    let Measured { head, mut heights, mut precision } = measured(path)?;
    let pixel = head.pixel(&given)?;
    let unit = head.unit(&given);
    if unit != 1.0 {
        precision = precision.max(f64::EPSILON);
    }
    check_heights(&mut heights, unit, head.has_unit)?;
    Ok(HeightMap::new(head.points, pixel, heights, precision)?)
}

/// Whether [`rows()`] leaves a map on disk: a `.npy` in C order.
///
/// # Errors
/// As [`head`].
pub fn stays_on_disk(path: &Path) -> Result<bool, ReadError> {
    Ok(Format::of(path)? == Format::Npy && !array::Header::read(path)?.is_fortran())
}

/// Opens a map without reading more of it than must be: one that stays on disk is read row by row, whatever its
/// size.
///
/// # Errors
/// As [`height_map`].
pub fn rows(path: &Path, given: Given) -> Result<Box<dyn Rows>, ReadError> {
    if !stays_on_disk(path)? {
        return Ok(Box::new(height_map(path, given)?));
    }
    let head = npy::head(path)?;
    let array = Mapped::open(path)?;
    let map = MappedMap { array, pixel: head.pixel(&given)?, unit: head.unit(&given) };
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

/// No rough surface is so high (m): its unit is wrong.
const TALLEST: f64 = 10.0;

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

fn too_large() -> ReadError {
    ReadError::Corrupt("claims to hold more numbers than any file can".to_owned())
}

/// What was found, not too long for a message.
fn shortened(text: &str) -> String {
    text.trim().chars().take(40).collect()
}

/// Heights with the y index running fastest, of heights in lines of `points_x` along x.
fn transposed(lines: &[f64], points_x: usize) -> Vec<f64> {
    (0..points_x).flat_map(|ix| lines.iter().skip(ix).step_by(points_x)).copied().collect()
}

/// A file that is there and not empty, or why not.
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
