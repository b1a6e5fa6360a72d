//! Content of a map file.

use super::error::ReadOptionsError;
use crate::topography::Rows;

/// Size, pixel and format of a map, from the header of its file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metadata {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Distance of neighbouring points along x and y, if the format stores it; in metres if it also stores the unit,
    /// otherwise in the unit of the file.
    pub pixel: Option<[f64; 2]>,
    /// Whether the format stores its unit of length.
    pub has_unit: bool,
    /// Name of the format.
    pub format: &'static str,
}

/// Pixel and unit for a file whose format does not store them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// Distance of neighbouring points along x and y, m.
    pub pixel: Option<[f64; 2]>,
    /// Unit of all lengths in the file, m; a metre if it is not given.
    pub unit: Option<f64>,
}

impl Metadata {
    /// Of a map in memory.
    pub fn in_memory(map: &dyn Rows) -> Self {
        Self { points: map.points(), pixel: Some(map.pixel()), has_unit: true, format: "a map in memory" }
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
            (Some(pixel), None) => Ok(pixel.map(|size| size * self.unit(options))),
            (None, Some(pixel)) => Ok(pixel),
            (None, None) => Err(ReadOptionsError::NoPixel),
        }
    }

    pub(super) fn unit(&self, options: &ReadOptions) -> f64 {
        if self.has_unit { 1.0 } else { options.unit.unwrap_or(1.0) }
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
    /// A height, in the same unit, that all are relative to.
    pub offset: f64,
    /// Relative precision of the stored numbers; 0 for unscaled integers.
    pub precision: f64,
}

/// Transposes heights in lines of `points_x` along x, so that the y index runs fastest.
pub(super) fn transposed(lines: &[f64], points_x: usize) -> Vec<f64> {
    (0..points_x).flat_map(|ix| lines.iter().skip(ix).step_by(points_x)).copied().collect()
}
