//! The rectangular part of a map that is used.

use std::ops::Range;

use super::error::ReadError;

/// A part of a map by lengths from its first point, m: points at `from <= x < to`, so that the part is as long as its ends are
/// apart. `None` along an axis that is not cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Crop {
    /// Ends along x.
    pub x: Option<[f64; 2]>,
    /// Ends along y.
    pub y: Option<[f64; 2]>,
}

impl Crop {
    /// Whether nothing is cut off.
    pub fn is_whole(&self) -> bool {
        *self == Self::default()
    }

    /// The indices along x and y of the points of the part.
    ///
    /// # Errors
    /// Ends beyond the map or in descending order; fewer than three points between them.
    pub fn ranges(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<[Range<usize>; 2], ReadError> {
        /// Of a pixel, by which a length that is a multiple of it may miss it.
        const ROUNDING: f64 = 1e-6;
        let range = |axis: usize, ends: Option<[f64; 2]>| {
            let Some(ends) = ends else { return Ok(0..points[axis]) };
            let [first, end] = ends.map(|length| (length / pixel[axis] - ROUNDING).ceil());
            if first >= 0.0 && end - first >= 3.0 && end <= points[axis] as f64 {
                Ok(first as usize..end as usize)
            } else {
                let side = points[axis] as f64 * pixel[axis];
                Err(ReadError::Crop { axis: ["x", "y"][axis], ends, side, pixel: pixel[axis] })
            }
        };
        Ok([range(0, self.x)?, range(1, self.y)?])
    }
}

/// The heights of a part of a map of `ny` points along y.
pub(super) fn part(heights: &[f64], ny: usize, [xs, ys]: &[Range<usize>; 2]) -> Vec<f64> {
    xs.clone().flat_map(|ix| &heights[ix * ny..][ys.clone()]).copied().collect()
}
