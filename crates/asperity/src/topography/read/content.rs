//! A map as its file holds it.

use super::error::GivenError;

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

    pub(super) fn unit(&self, given: &Given) -> f64 {
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

/// Heights with the y index running fastest, of heights in lines of `points_x` along x.
pub(super) fn transposed(lines: &[f64], points_x: usize) -> Vec<f64> {
    (0..points_x).flat_map(|ix| lines.iter().skip(ix).step_by(points_x)).copied().collect()
}
