//! Height maps: what a measured surface is, and how asperities are found on it.
//!
//! | module | what lives there |
//! |---|---|
//! | [`read`] | one file a format |
//! | [`level`] | taking out the form |
//! | [`filter`] | Gaussian S and L filters |
//! | [`summits`] | five-point summits and their curvatures |
//! | [`quantisation`] | are the heights on steps of the instrument? |
//! | [`marginal`] | height distributions of generated surfaces |

pub mod filter;
pub mod level;
pub mod marginal;
pub mod quantisation;
pub mod read;
pub mod summits;

use crate::numeric::is_positive;
use crate::numeric::sum::sum_of;

/// Heights on a rectangular grid. A missing point is NaN.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightMap {
    points: [usize; 2],
    pixel: [f64; 2],
    heights: Vec<f64>,
    precision: f64,
}

/// Heights that make no map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapError {
    /// A summit needs neighbours.
    #[error("is no height map: {} x {} points; allowed: at least 3 x 3", .0[0], .0[1])]
    TooSmall([usize; 2]),
    /// As many heights as points.
    #[error("{found} heights for {} x {} points", points[0], points[1])]
    Length {
        /// Points along x and y.
        points: [usize; 2],
        /// Heights found.
        found: usize,
    },
    /// Pixels are positive.
    #[error("pixel {} x {} m; allowed: positive and finite", .0[0], .0[1])]
    Pixel([f64; 2]),
    /// All points are missing.
    #[error("holds no finite height")]
    AllMissing,
}

impl HeightMap {
    /// A map of `points` along x and y, `pixel` (m) apart, of `heights` (m) with the y index running
    /// fastest, stored with the relative `precision` (0 for integers). What is not finite, or too
    /// large to be a height, is missing.
    ///
    /// # Errors
    /// See [`MapError`].
    pub fn new(
        points: [usize; 2],
        pixel: [f64; 2],
        mut heights: Vec<f64>,
        precision: f64,
    ) -> Result<Self, MapError> {
        if points.iter().any(|&count| count < 3) {
            return Err(MapError::TooSmall(points));
        }
        if points[0].checked_mul(points[1]) != Some(heights.len()) {
            return Err(MapError::Length { points, found: heights.len() });
        }
        if !pixel.iter().all(|&size| is_positive(size)) {
            return Err(MapError::Pixel(pixel));
        }
        for z in &mut heights {
            if z.abs() > crate::numeric::LARGEST {
                *z = f64::NAN;
            }
        }
        if heights.iter().all(|z| z.is_nan()) {
            return Err(MapError::AllMissing);
        }
        Ok(Self { points, pixel, heights, precision })
    }

    /// Points along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Distance of neighbouring points along x and y, m.
    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// Heights, m, the y index running fastest; NaN where missing.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Number of missing points.
    pub fn missing(&self) -> usize {
        self.heights.iter().filter(|z| z.is_nan()).count()
    }

    /// The same map with other heights, the same points missing.
    fn with_heights(&self, heights: Vec<f64>) -> Self {
        Self { heights, ..*self }
    }
}

/// Height parameters of a map (ISO 25178-2), about its mean, divided by the number of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// Mean height, m.
    pub mean: f64,
    /// Mean absolute deviation Sa, m.
    pub sa: f64,
    /// Standard deviation Sq, m.
    pub sq: f64,
    /// Skewness Ssk; `None` on a flat map.
    pub ssk: Option<f64>,
    /// Kurtosis Sku (3 if Gaussian); `None` on a flat map.
    pub sku: Option<f64>,
}

impl Moments {
    /// Moments of the points that are present, the same to the bit on any number of threads.
    pub fn of(map: &HeightMap) -> Self {
        let heights = map.heights();
        let count = (heights.len() - map.missing()) as f64;
        let mean_of = |term: &(dyn Fn(f64) -> f64 + Sync)| {
            sum_of(heights.len(), |k| if heights[k].is_nan() { 0.0 } else { term(heights[k]) }) / count
        };
        let mean = mean_of(&|z| z);
        let sq = mean_of(&|z| (z - mean).powi(2)).sqrt();
        let standardised = |power: i32| (sq > 0.0).then(|| mean_of(&|z| ((z - mean) / sq).powi(power)));
        Self { mean, sa: mean_of(&|z| (z - mean).abs()), sq, ssk: standardised(3), sku: standardised(4) }
    }
}
