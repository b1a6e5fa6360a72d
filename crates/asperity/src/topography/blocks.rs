//! Division of a map into blocks that are long compared with its correlation length.

use super::{Autocorrelation, Rows, Strip, strips};

/// The correlation length is the lag at which the autocorrelation has decayed to this value.
const DECAY: f64 = 0.2;

/// The smallest number of blocks.
pub const MIN_BLOCKS: usize = 16;

/// The smallest side of a block in correlation lengths: about three of the longest waves of a self-affine surface. The
/// experiment `[coverage]` shows that intervals from such blocks hold.
pub const BLOCK_LENGTHS: f64 = 9.0;

/// Correlation lengths of a map along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrelationLengths {
    /// Along x and y, m; infinite where the autocorrelation does not decay within half of the map.
    pub lengths: [f64; 2],
}

impl CorrelationLengths {
    /// The lags at which `autocorrelation` has decayed to 0.2 along x and y.
    pub fn of(autocorrelation: &Autocorrelation) -> Self {
        let decay = |points: &[(f64, f64)]| {
            let first = points.iter().position(|&(_, value)| value < DECAY)?;
            let [before, after] = [first.checked_sub(1)?, first].map(|k| points[k]);
            Some(before.0 + (after.0 - before.0) * (before.1 - DECAY) / (before.1 - after.1))
        };
        let axis = |points: &[(f64, f64)]| decay(points).unwrap_or(f64::INFINITY);
        Self { lengths: [axis(&autocorrelation.along_x), axis(&autocorrelation.along_y)] }
    }
}

/// A division of a map of `points` into equal blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Blocks {
    /// Number of points of the map along x and y.
    pub points: [usize; 2],
    /// Number of blocks along x and y.
    pub counts: [usize; 2],
}

impl Blocks {
    /// At least [`MIN_BLOCKS`] blocks of a map of `points` with `pixel` (m), as few and as long as possible: each of a side
    /// of at least [`BLOCK_LENGTHS`] correlation lengths.
    ///
    /// # Errors
    /// The map is too small.
    pub fn new(
        points: [usize; 2],
        pixel: [f64; 2],
        correlation: CorrelationLengths,
    ) -> Result<Self, TooSmall> {
        let sides = [0, 1].map(|axis| points[axis] as f64 * pixel[axis]);
        // In units of the shortest block allowed.
        let lengths = [0, 1].map(|axis| sides[axis] / (BLOCK_LENGTHS * correlation.lengths[axis]));
        let along_x = 1..=(lengths[0].floor() as usize).clamp(1, points[0]);
        let of = |nx: usize| {
            let ny = MIN_BLOCKS.div_ceil(nx);
            let relative = (lengths[0] / nx as f64).min(lengths[1] / ny as f64);
            // One block along an axis needs no length.
            let fits = [(nx, 0), (ny, 1)].into_iter().all(|(n, axis)| n == 1 || lengths[axis] >= n as f64);
            (fits && ny <= points[1]).then_some(([nx, ny], relative))
        };
        let best = along_x.take(MIN_BLOCKS).filter_map(of).max_by(|a, b| a.1.total_cmp(&b.1));
        best.map(|(counts, _)| Self { points, counts }).ok_or_else(|| {
            let side = (MIN_BLOCKS as f64).sqrt() * BLOCK_LENGTHS;
            let shortest = correlation.lengths.map(|length| side * length);
            TooSmall { correlation, area_needed: shortest[0] * shortest[1] }
        })
    }

    /// The share of each block in the points of `map` that are present.
    pub fn shares(&self, map: &dyn Rows) -> Vec<f64> {
        let count = |strip: Strip| {
            let mut present = vec![0usize; self.count()];
            for row in 0..strip.count {
                let first = (strip.first + row) * self.points[1];
                let heights = strip.row(row as isize).unwrap_or_default();
                for (k, _) in heights.iter().enumerate().filter(|(_, z)| !z.is_nan()) {
                    present[self.of_point(first + k)] += 1;
                }
            }
            present
        };
        let parts = strips(map, 0, count);
        let present = |block: usize| parts.iter().map(|part| part[block]).sum::<usize>() as f64;
        let present: Vec<f64> = (0..self.count()).map(present).collect();
        let all: f64 = present.iter().sum();
        present.into_iter().map(|count| count / all).collect()
    }

    /// Number of blocks.
    pub fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// The block of the point `index`, the y index running fastest.
    pub fn of_point(&self, index: usize) -> usize {
        let [nx, ny] = self.points;
        let [bx, by] = self.counts;
        let block = |place: usize, count: usize, blocks: usize| place * blocks / count;
        block(index / ny, nx, bx) * by + block(index % ny, ny, by)
    }
}

/// A map that does not hold [`MIN_BLOCKS`] blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooSmall {
    /// Its correlation lengths.
    pub correlation: CorrelationLengths,
    /// The area (m^2) that would hold them; infinite where the correlation does not decay.
    pub area_needed: f64,
}
