//! Division of a map into blocks that are long compared with its correlation length.

use super::{CorrelationLengths, Rows, Strip, strips};

/// The smallest number of blocks.
pub const MIN_BLOCKS: usize = 16;

/// The smallest side of a block in correlation lengths: about three of the longest waves of a self-affine surface. The
/// experiment `coverage` shows that intervals from such blocks hold.
pub const BLOCK_LENGTHS: f64 = 9.0;

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
    /// of at least [`BLOCK_LENGTHS`] correlation lengths, of the heights and of the amplitude of the roughness.
    ///
    /// # Errors
    /// The map is too small.
    pub fn new(
        points: [usize; 2],
        pixel: [f64; 2],
        correlation: CorrelationLengths,
    ) -> Result<Self, TooSmall> {
        let longest = correlation.longest();
        let sides = [0, 1].map(|axis| points[axis] as f64 * pixel[axis]);
        // In units of the shortest block allowed.
        let lengths = [0, 1].map(|axis| sides[axis] / (BLOCK_LENGTHS * longest[axis]));
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
            let shortest = longest.map(|length| side * length);
            TooSmall { correlation, area_needed: shortest[0] * shortest[1] }
        })
    }

    /// Both halves of a map of `points` with `pixel` (m), divided along its longer side.
    pub fn halves(points: [usize; 2], pixel: [f64; 2]) -> Self {
        let is_along_y = points[1] as f64 * pixel[1] > points[0] as f64 * pixel[0];
        Self::halves_along(points, usize::from(is_along_y))
    }

    /// Both halves of a map of `points`, divided across an axis.
    pub fn halves_along(points: [usize; 2], axis: usize) -> Self {
        Self { points, counts: if axis == 0 { [2, 1] } else { [1, 2] } }
    }

    /// The share of each block in the points of `map` that are present.
    pub fn shares(&self, map: &dyn Rows) -> Vec<f64> {
        let ([_, ny], [_, by]) = (self.points, self.counts);
        // The places along y at which a block begins, and the end.
        let begins: Vec<usize> = (0..=by).map(|block| (block * ny).div_ceil(by)).collect();
        let count = |strip: Strip| {
            let mut present = vec![0usize; self.count()];
            for row in 0..strip.count {
                let first = self.of_point((strip.first + row) * ny);
                let Some(heights) = strip.row(row as isize) else { continue };
                for (present, ends) in present[first..].iter_mut().zip(begins.windows(2)) {
                    *present += heights[ends[0]..ends[1]].iter().filter(|z| !z.is_nan()).count();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(x: f64, y: f64) -> CorrelationLengths {
        CorrelationLengths { lengths: [x, y], patches: None }
    }

    #[test]
    fn as_few_blocks_as_there_must_be_of_equal_relative_sides() {
        let counts = |points, x, y| Blocks::new(points, [1.0; 2], lengths(x, y)).map(|blocks| blocks.counts);
        assert_eq!(counts([512, 512], 10.0, 10.0), Ok([4, 4]));
        assert_eq!(counts([1600, 100], 10.0, 10.0), Ok([16, 1]));
        // Correlated along y: strips.
        assert_eq!(counts([512, 512], 3.0, f64::INFINITY), Ok([16, 1]));
        assert_eq!(counts([640, 480], 10.0, 10.0), Ok([5, 4]));
        let error = counts([512, 512], 30.0, 30.0).unwrap_err();
        assert!((error.area_needed - (4.0 * BLOCK_LENGTHS * 30.0).powi(2)).abs() < 1e-6);
        // Roughness whose amplitude varies over longer distances.
        let patchy = CorrelationLengths { patches: Some([30.0, 5.0]), ..lengths(10.0, 10.0) };
        let counts_of = |points| Blocks::new(points, [1.0; 2], patchy).map(|blocks| blocks.counts).ok();
        assert_eq!([counts_of([512, 512]), counts_of([1200, 512])], [None, Some([4, 4])]);
        assert_eq!(counts([512, 512], f64::INFINITY, f64::INFINITY).unwrap_err().area_needed, f64::INFINITY);
    }

    #[test]
    fn the_longer_side_is_halved() {
        let halves = |points, pixel| Blocks::halves(points, pixel);
        assert_eq!(halves([4, 6], [1.0, 1.0]).counts, [1, 2]);
        let along_x = halves([4, 6], [2.0, 1.0]);
        assert_eq!(along_x.counts, [2, 1]);
        assert_eq!([0, 11, 12, 23].map(|point| along_x.of_point(point)), [0, 0, 1, 1]);
    }
}
