//! Content of a map file.

use std::fmt;

use super::error::ReadOptionsError;
use super::npy;
use crate::progress::Count;
use crate::topography::Rows;

/// Size, pixel and format of a map, from the header of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Metadata {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Points that are read of the file, of which `points` may be a part.
    pub read: usize,
    /// Distance of neighbouring points along x and y, if the format stores it; in metres if it also stores the unit,
    /// otherwise in the unit of the file.
    pub pixel: Option<[f64; 2]>,
    /// Whether the format stores its unit of length.
    pub has_unit: bool,
    /// Units in the names of columns.
    pub named: NamedUnits,
    /// Labels of a text that are no heights.
    pub left_out: LeftOut,
    /// The channel of a file that may hold several.
    pub channel: Option<ChannelName>,
    /// Name of the format.
    pub format: &'static str,
}

/// Which channel of a file is read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChannelName {
    /// Its name.
    pub name: String,
    /// The others of the file.
    pub others: Vec<OtherChannel>,
}

/// A channel of a file that is not read.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherChannel {
    /// Its name.
    pub name: String,
    /// The unit of its numbers, m of lengths; `None` where the file does not say.
    pub unit: Option<String>,
}

/// Its name, with the unit where that is none of length.
impl fmt::Display for OtherChannel {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.unit.as_deref() {
            None | Some("m") => write!(f, "\"{}\"", self.name),
            Some(unit) => write!(f, "\"{}\" ({unit})", self.name),
        }
    }
}

/// Units of the lengths in a file, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthUnits {
    /// Of coordinates, and of a pixel that the file stores.
    pub xy: f64,
    /// Of heights.
    pub z: f64,
}

impl LengthUnits {
    /// One unit (m) for coordinates and heights.
    pub const fn same(unit: f64) -> Self {
        Self { xy: unit, z: unit }
    }
}

/// Units of length in the names of the columns x, y and z of a text.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum NamedUnits {
    /// There are none.
    #[default]
    None,
    /// Of all columns.
    Known(LengthUnits),
    /// Of some columns only, different ones for x and y, or no units of length.
    Unclear {
        /// Line number, from 1.
        line: usize,
        /// Text of the line.
        found: String,
    },
}

/// Labels of a matrix of numbers in a text, which hold no heights.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LeftOut {
    /// The line of column names, column numbers or coordinates of columns.
    pub header: Option<usize>,
    /// Whether the first column numbers or names the lines, or holds their coordinates.
    pub index_column: bool,
    /// Distance of the columns by that line, and of the lines by that column, in the unit of the file, where they hold coordinates.
    pub spacing: [Option<f64>; 2],
}

/// Pixel and unit for a file whose format does not store them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// Distance of neighbouring points along x and y, m.
    pub pixel: Option<[f64; 2]>,
    /// Units of the lengths in the file; if not given those that names of columns state, or a metre.
    pub unit: Option<LengthUnits>,
}

impl Metadata {
    /// Of a format that stores heights only, in any unit.
    pub(super) fn new(points: [usize; 2], format: &'static str) -> Self {
        let (named, left_out) = (NamedUnits::None, LeftOut::default());
        let read = points[0].saturating_mul(points[1]);
        Self { points, read, pixel: None, has_unit: false, named, left_out, channel: None, format }
    }

    /// Of a map in memory.
    pub fn in_memory(map: &dyn Rows) -> Self {
        Self { pixel: Some(map.pixel()), has_unit: true, ..Self::new(map.points(), "a map in memory") }
    }

    /// Whether x runs along the first index of an array, as in `.npy`, rather than along the lines of a file.
    pub fn has_x_first(&self) -> bool {
        self.format == npy::NAME
    }

    /// The same with x and y exchanged.
    #[must_use]
    pub fn transposed(self) -> Self {
        let swapped = |[x, y]: [f64; 2]| [y, x];
        let [nx, ny] = self.points;
        Self { points: [ny, nx], pixel: self.pixel.map(swapped), ..self }
    }

    /// The pixel along x and y, m.
    ///
    /// # Errors
    /// See [`ReadOptionsError`].
    pub fn pixel(&self, options: &ReadOptions) -> Result<[f64; 2], ReadOptionsError> {
        let Self { format, has_unit, .. } = *self;
        if has_unit && options.unit.is_some() {
            return Err(ReadOptionsError::UnitHeld { format });
        }
        match (self.pixel, options.pixel) {
            (Some(pixel), Some(_)) => Err(ReadOptionsError::PixelHeld { format, pixel, has_unit }),
            (Some(pixel), None) => {
                // A channel of unknown heights has a pixel in metres.
                let unit = if self.channel.is_some() { 1.0 } else { self.units(options)?.xy };
                Ok(pixel.map(|size| size * unit))
            }
            (None, Some(pixel)) => Ok(pixel),
            (None, None) => Err(ReadOptionsError::NoPixel),
        }
    }

    /// The units of the lengths in the file, m.
    ///
    /// # Errors
    /// Names of columns with units that are not clear, where options give none; others than the options give.
    pub fn units(&self, options: &ReadOptions) -> Result<LengthUnits, ReadOptionsError> {
        const METRE: LengthUnits = LengthUnits::same(1.0);
        match (&self.named, options.unit) {
            _ if self.has_unit => Ok(METRE),
            (NamedUnits::Known(named), Some(given)) if *named != given => {
                Err(ReadOptionsError::UnitNamed { named: *named, given })
            }
            (_, Some(units)) => Ok(units),
            (NamedUnits::Known(units), None) => Ok(*units),
            (NamedUnits::None, None) => Ok(METRE),
            (NamedUnits::Unclear { line, found }, None) => {
                Err(ReadOptionsError::UnitsInColumns { line: *line, found: found.clone() })
            }
        }
    }
}

/// A map as stored in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Size, pixel and unit.
    pub metadata: Metadata,
    /// Heights, the y index running fastest; in metres if the format stores its unit, otherwise in the unit of the
    /// file. Missing points are NaN.
    pub heights: Vec<f64>,
    /// What a height of one in the file is in `heights`: other than 1 in a text with a header of units.
    pub scale: f64,
    /// A height, in the same unit, that all are relative to.
    pub offset: f64,
    /// Relative precision of the stored numbers; 0 for unscaled integers.
    pub precision: f64,
}

/// Transposes heights in lines of `points_x` along x, so that the y index runs fastest; `count` is of the heights.
pub(super) fn transposed(lines: &[f64], points_x: usize, mut count: Count) -> Vec<f64> {
    let mut heights = Vec::with_capacity(lines.len());
    // Lines without points may claim any length.
    for ix in 0..points_x.min(lines.len()) {
        let before = heights.len();
        heights.extend(lines.iter().skip(ix).step_by(points_x));
        count.add(heights.len() - before);
    }
    count.end();
    heights
}
