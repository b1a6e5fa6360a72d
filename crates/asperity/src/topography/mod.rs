//! Height maps: reading, levelling, filtering and generating them, and finding their summits.
//!
//! | item | content |
//! |---|---|
//! | [`HeightMap`], [`Rows`], [`Watched`], [`Continued`] | heights in memory; heights row by row, for maps larger than memory; with progress; continued periodically |
//! | [`read`] | measured maps, one file per format |
//! | [`mod@write`] | maps for other programs, one file per format |
//! | [`thumbnail`], [`Sampled`], [`Window`] | a coarse map of a map; every n-th point of it; a part of it |
//! | [`Level`], [`Filter`] | removing the form; Gaussian S and L filters |
//! | [`tip`] | what the stylus or tip of the instrument could not reach |
//! | [`summits`] | summits and their curvatures |
//! | [`RoughnessParameters`], [`Moments`], [`Drops`] | height and spectral moments, the autocorrelation at neighbours |
//! | [`RadialSpectrum`], [`Autocorrelation`] | power spectrum and autocorrelation of a map |
//! | [`CorrelationLengths`] | of the heights, and of the amplitude of a roughness that is patchy |
//! | [`Blocks`] | division of a map into blocks that are long compared with its correlation lengths |
//! | [`theory`] | the summits of a Gaussian surface of given spectral moments or autocorrelation |
//! | [`Quantisation`] | height steps of the instrument |
//! | [`fitness`] | whether a map may carry a verdict: spikes, form, lines, steps, resolution |
//! | [`generate`], [`spectrum`] | random rough surfaces and their spectra |

mod correlation;
mod correlation_lengths;
mod filter;
pub mod fitness;
mod fourier;
pub mod generate;
mod height_transform;
pub mod joint;
mod level;
mod pair;
mod part;
mod quantisation;
pub mod read;
mod roughness;
mod rows;
pub mod spectrum;
pub mod summits;
pub mod theory;
pub mod tip;
pub mod write;

use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::Path;

use crate::memory::zeros;
use crate::npy;
use crate::numeric::is_positive;
use crate::numeric::parallel::for_each_row;
use crate::numeric::sum::CHUNK;
pub use correlation::{Autocorrelation, RadialSpectrum};
pub use correlation_lengths::CorrelationLengths;
pub use filter::{Filter, FilterError};
pub use level::{Form, Level, Levelled, Undetermined};
pub use pair::{LEAST_OVERLAP, PairError, Placement, RoughPair};
pub use part::{BLOCK_LENGTHS, Blocks, MIN_BLOCKS, Sampled, TooSmall, Window, thumbnail};
pub use quantisation::{HeightPlace, Quantisation, SHARED, SharedHeight};
pub use roughness::{Drops, Moments, RoughnessParameters};
pub use rows::{Boundary, Continued, Rows, Strip, Watched, strips};

/// Heights on a rectangular grid. A missing point is NaN.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    points: [usize; 2],
    pixel: [f64; 2],
    heights: Vec<f64>,
    precision: f64,
    boundary: Boundary,
    offset: f64,
}

/// Values that form no valid map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapError {
    /// There must be at least 3 x 3 points.
    #[error("is not a height map: {} x {} points; allowed: at least 3 x 3", .0[0], .0[1])]
    TooSmall([usize; 2]),
    /// There must be as many heights as points.
    #[error("{found} heights for {} x {} points", points[0], points[1])]
    Length {
        /// Points along x and y.
        points: [usize; 2],
        /// Heights found.
        found: usize,
    },
    /// Pixels must be positive and finite.
    #[error("pixel {} x {} m; allowed: positive and finite", .0[0], .0[1])]
    Pixel([f64; 2]),
    /// All points are missing.
    #[error("holds no finite height: every point is NaN, infinite or beyond 1e30, which mark missing points")]
    AllMissing,
}

impl HeightMap {
    /// A map of `points` along x and y at a distance of `pixel` (m), from `heights` (m) with the y index running
    /// fastest and the relative `precision` of their storage (0 for integers). Values that are not finite, or too large
    /// to be a height, count as missing.
    ///
    /// # Errors
    /// See [`MapError`].
    pub fn new(
        points: [usize; 2],
        pixel: [f64; 2],
        mut heights: Vec<f64>,
        precision: f64,
    ) -> Result<Self, MapError> {
        Self::check_grid(points, pixel)?;
        if points[0].checked_mul(points[1]) != Some(heights.len()) {
            return Err(MapError::Length { points, found: heights.len() });
        }
        for_each_row(&mut heights, CHUNK, &|_, heights| {
            for z in heights {
                if z.abs() > crate::numeric::LARGEST {
                    *z = f64::NAN;
                }
            }
        });
        if heights.iter().all(|z| z.is_nan()) {
            return Err(MapError::AllMissing);
        }
        Ok(Self { points, pixel, heights, precision, boundary: Boundary::Open, offset: 0.0 })
    }

    /// Checks a grid of `points` at a distance of `pixel` (m).
    ///
    /// # Errors
    /// Fewer than 3 points along an axis, or a pixel that is not positive and finite.
    pub fn check_grid(points: [usize; 2], pixel: [f64; 2]) -> Result<(), MapError> {
        if points.iter().any(|&count| count < 3) {
            return Err(MapError::TooSmall(points));
        }
        if !pixel.iter().all(|&size| is_positive(size)) {
            return Err(MapError::Pixel(pixel));
        }
        Ok(())
    }

    /// Reads all rows of `map` into memory.
    pub fn from_rows(map: &dyn Rows) -> Self {
        let points = map.points();
        let mut heights = zeros(points[0] * points[1]);
        for_each_row(&mut heights, points[1], &|ix, row| {
            map.progress().advance((points[0] as f64).recip());
            map.read(ix, row);
        });
        Self::like(map, heights)
    }

    /// Heights (m) on an open grid that is that of another map.
    fn of_checked(points: [usize; 2], pixel: [f64; 2], heights: Vec<f64>) -> Self {
        Self { points, pixel, heights, precision: f64::EPSILON, boundary: Boundary::Open, offset: 0.0 }
    }

    /// Other heights (m) on the grid of `map`.
    fn like(map: &dyn Rows, heights: Vec<f64>) -> Self {
        Self {
            points: map.points(),
            pixel: map.pixel(),
            heights,
            precision: map.precision(),
            boundary: map.boundary(),
            offset: map.offset(),
        }
    }

    /// Heights (m) on a grid `factor` times as fine over the same area.
    pub(crate) fn regridded(&self, factor: usize, heights: Vec<f64>) -> Self {
        let points = self.points.map(|count| factor * count);
        let pixel = self.pixel.map(|side| side / factor as f64);
        Self { points, pixel, heights, ..*self }
    }

    /// The same heights, relative to a height of `offset` (m) that is kept apart.
    #[must_use]
    pub fn with_offset(self, offset: f64) -> Self {
        Self { offset, ..self }
    }

    /// The same map with periodic boundaries.
    #[must_use]
    pub fn periodic(self) -> Self {
        Self { boundary: Boundary::Periodic, ..self }
    }

    /// Points along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Distance of neighbouring points along x and y, m.
    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// Heights, m, relative to [`Rows::offset`], the y index running fastest; NaN where missing.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The heights, m, with the y index running fastest.
    pub fn into_heights(self) -> Vec<f64> {
        self.heights
    }

    /// Writes the heights (m) as a NumPy array of float64 whose first index is x, missing points being NaN. A `.npy`
    /// file does not store the pixel size.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_npy(&self, path: &Path) -> io::Result<()> {
        // The sum would lose the sign of zeros.
        let absolute = |&z: &f64| if self.offset == 0.0 { z } else { z + self.offset };
        npy::write(File::create(path)?, self.points, self.heights.iter().map(absolute))
    }

    /// `of(height)` on a grid of at least as many `points`; zero where a height is missing.
    fn embedded(&self, points: [usize; 2], of: impl Fn(f64) -> f64 + Sync) -> Vec<f64> {
        let mut field = zeros(points[0] * points[1]);
        let ny = self.points[1];
        for_each_row(&mut field[..self.points[0] * points[1]], points[1], &|ix, row| {
            for (value, &z) in row.iter_mut().zip(&self.heights[ix * ny..(ix + 1) * ny]) {
                *value = if z.is_nan() { 0.0 } else { of(z) };
            }
        });
        field
    }
}

impl Rows for HeightMap {
    fn points(&self) -> [usize; 2] {
        self.points
    }

    fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    fn precision(&self) -> f64 {
        self.precision
    }

    fn boundary(&self) -> Boundary {
        self.boundary
    }

    fn offset(&self) -> f64 {
        self.offset
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        row.copy_from_slice(self.block(ix..ix + 1).unwrap_or_default());
    }

    fn block(&self, rows: Range<usize>) -> Option<&[f64]> {
        self.heights.get(rows.start * self.points[1]..rows.end * self.points[1])
    }
}
