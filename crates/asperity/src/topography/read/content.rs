//! Content of a map file.

use std::fmt;

use super::error::ReadOptionsError;
use super::npy;
use crate::progress::Count;
use crate::topography::Rows;
use crate::units::Dimension;

/// Size, pixel and format of a map, from the header of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Metadata {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Points that are read of the file, of which `points` may be a part.
    pub read: usize,
    /// Distance of neighbouring points along x and y, if the file states it; in metres if it also states the unit of that,
    /// otherwise in the unit of the file.
    pub pixel: Option<[f64; 2]>,
    /// Whether the pixel is in metres, because the file states its unit.
    pub pixel_has_unit: bool,
    /// Whether heights are in metres, because the file states their unit.
    pub has_unit: bool,
    /// The units that the file states, of what is in metres.
    pub stated: LengthUnits,
    /// Units in the names of columns.
    pub named: NamedUnits,
    /// Labels of a text that are no heights.
    pub left_out: LeftOut,
    /// What a reader should know of how the file was read: predicates of the map, each a sentence without its full stop.
    pub notes: Vec<String>,
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
    /// Of coordinates, and of a pixel that the file states.
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

/// "um", or "um of x and y, nm of z".
impl fmt::Display for LengthUnits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let length = Dimension::Length;
        let name = |unit: f64| {
            let found = length.documented().iter().find(|name| length.factor(name) == Some(unit));
            found.map_or_else(|| format!("{unit:e} m"), |name| (*name).to_owned())
        };
        let [xy, z] = [self.xy, self.z].map(name);
        if xy == z { f.write_str(&z) } else { write!(f, "{xy} of x and y, {z} of z") }
    }
}

/// Where the unit of heights comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitOrigin {
    /// The options give it.
    Given,
    /// The file states it.
    Stated,
    /// Neither does: numbers of a text or of `.npy` are taken for metres, and for other files a unit is asked for.
    Assumed,
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

/// Pixel and unit of a file that does not state them, or states wrong ones: what is given here counts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// Distance of neighbouring points along x and y, m.
    pub pixel: Option<[f64; 2]>,
    /// Units of the lengths in the file, in place of those that it states: of the numbers that it stores, times their own factors. Two that are
    /// equal, for a file that states the unit of its pixel only, are that of its heights.
    pub unit: Option<LengthUnits>,
}

impl Metadata {
    /// Of a format that stores heights only, in any unit.
    pub(super) fn new(points: [usize; 2], format: &'static str) -> Self {
        Self {
            points,
            read: points[0].saturating_mul(points[1]),
            pixel: None,
            pixel_has_unit: false,
            has_unit: false,
            stated: LengthUnits::same(1.0),
            named: NamedUnits::None,
            left_out: LeftOut::default(),
            notes: Vec::new(),
            channel: None,
            format,
        }
    }

    /// Of a format that states a pixel in metres, and heights in metres.
    pub(super) fn in_metres(points: [usize; 2], pixel: [f64; 2], format: &'static str) -> Self {
        Self { pixel: Some(pixel), pixel_has_unit: true, has_unit: true, ..Self::new(points, format) }
    }

    /// Of a map in memory.
    pub fn in_memory(map: &dyn Rows) -> Self {
        Self::in_metres(map.points(), map.pixel(), "a map in memory")
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

    /// The pixel along x and y, m: the one given, else that of the file.
    ///
    /// # Errors
    /// See [`ReadOptionsError`].
    pub fn pixel(&self, options: &ReadOptions) -> Result<[f64; 2], ReadOptionsError> {
        let unit = self.units(options)?.xy;
        let own = self.pixel.map(|pixel| pixel.map(|size| size * unit));
        options.pixel.or(own).ok_or(ReadOptionsError::NoPixel)
    }

    /// What lengths of one are in metres: of coordinates and the pixel, and of heights as they are read. One where the file states the unit
    /// and the options give no other.
    ///
    /// # Errors
    /// No unit of heights of a file that states one of its pixel; names of columns with units that are not clear. Neither where options give
    /// units.
    pub fn units(&self, options: &ReadOptions) -> Result<LengthUnits, ReadOptionsError> {
        match (options.unit, &self.named) {
            (Some(given), _) => Ok(LengthUnits {
                xy: match self.pixel_has_unit {
                    true if !self.has_unit && given.xy == given.z => 1.0,
                    true => given.xy / self.stated.xy,
                    false => given.xy,
                },
                z: if self.has_unit { given.z / self.stated.z } else { given.z },
            }),
            (None, NamedUnits::Known(units)) => Ok(*units),
            (None, NamedUnits::Unclear { line, found }) => {
                Err(ReadOptionsError::UnitsInColumns { line: *line, found: found.clone() })
            }
            (None, NamedUnits::None) if self.pixel_has_unit && !self.has_unit => {
                let channel = self.channel.as_ref().map(|channel| channel.name.clone());
                Err(ReadOptionsError::NoUnit { channel })
            }
            (None, NamedUnits::None) => Ok(LengthUnits::same(1.0)),
        }
    }

    /// The units that the file states and the options replace by others.
    pub fn replaced_units(&self, options: &ReadOptions) -> Option<LengthUnits> {
        let stated = match self.named {
            NamedUnits::Known(units) => units,
            _ if self.has_unit => self.stated,
            _ => return None,
        };
        options.unit.is_some_and(|given| given != stated).then_some(stated)
    }

    /// Where the unit of heights comes from.
    pub fn unit_origin(&self, options: &ReadOptions) -> UnitOrigin {
        match options.unit {
            Some(_) => UnitOrigin::Given,
            None if self.has_unit || matches!(self.named, NamedUnits::Known(_)) => UnitOrigin::Stated,
            None => UnitOrigin::Assumed,
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
