//! Maps derived from a map: a coarse one, every n-th point of it, a part of it, and blocks that are long compared with its correlation
//! length.

use super::rows::rows_from;
use super::{Boundary, CorrelationLengths, HeightMap, Rows, Strip, strips};

/// A map of at most `most` points along each axis: each the mean of a block of points that are there.
pub fn thumbnail(map: &dyn Rows, most: usize) -> HeightMap {
    HeightMap::from_rows(&Means { map, block: map.points().map(|count| count.div_ceil(most)) })
}

/// Means over blocks of points.
struct Means<'a> {
    map: &'a dyn Rows,
    block: [usize; 2],
}

impl Rows for Means<'_> {
    rows_from!(map: boundary offset progress is_whole);

    fn points(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.map.points()[axis].div_ceil(self.block[axis]))
    }

    fn pixel(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.map.pixel()[axis] * self.block[axis] as f64)
    }

    fn precision(&self) -> f64 {
        f64::EPSILON
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        let [nx, ny] = self.map.points();
        let mut line = vec![0.0; ny];
        let mut sums = vec![(0.0, 0.0); row.len()];
        for i in ix * self.block[0]..nx.min((ix + 1) * self.block[0]) {
            self.map.read(i, &mut line);
            for (sum, block) in sums.iter_mut().zip(line.chunks(self.block[1])) {
                for z in block.iter().filter(|z| !z.is_nan()) {
                    sum.0 += z;
                    sum.1 += 1.0;
                }
            }
        }
        for (z, (sum, count)) in row.iter_mut().zip(sums) {
            // A block without a point is missing: 0/0.
            *z = sum / count;
        }
    }
}

/// Every so many points of a map along x and y, from the first: the same surface at a larger sampling interval. Periodic where
/// the map is and the interval divides its points.
pub struct Sampled<'a> {
    /// The map.
    pub map: &'a dyn Rows,
    /// The interval in points of the map, at least 1.
    pub every: usize,
}

impl Rows for Sampled<'_> {
    rows_from!(map: precision offset progress is_whole);

    fn points(&self) -> [usize; 2] {
        self.map.points().map(|count| count.div_ceil(self.every))
    }

    fn pixel(&self) -> [f64; 2] {
        self.map.pixel().map(|pixel| pixel * self.every as f64)
    }

    fn boundary(&self) -> Boundary {
        let is_whole = self.map.points().iter().all(|count| count.is_multiple_of(self.every));
        if is_whole { self.map.boundary() } else { Boundary::Open }
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        let first = ix * self.every;
        let mut read = Vec::new();
        let whole = self.map.block(first..first + 1).unwrap_or_else(|| {
            read = vec![0.0; self.map.points()[1]];
            self.map.read(first, &mut read);
            &read
        });
        row.iter_mut().zip(whole.iter().step_by(self.every)).for_each(|(z, height)| *z = *height);
    }

    fn block(&self, rows: std::ops::Range<usize>) -> Option<&[f64]> {
        if self.every == 1 { self.map.block(rows) } else { None }
    }
}

/// A rectangular part of a map, with open borders.
pub struct Window<'a> {
    /// The map.
    pub map: &'a dyn Rows,
    /// Index of its first point along x and y.
    pub first: [usize; 2],
    /// Number of its points along x and y, within the map.
    pub points: [usize; 2],
}

impl<'a> Window<'a> {
    /// The middle of a map, of at most `most` points along each axis.
    pub fn centre(map: &'a dyn Rows, most: usize) -> Self {
        let points = map.points().map(|count| count.min(most));
        let first = [0, 1].map(|axis| (map.points()[axis] - points[axis]) / 2);
        Self { map, first, points }
    }

    /// Both halves of a map, divided along its longer side.
    pub fn halves(map: &'a dyn Rows) -> [Self; 2] {
        let (all, pixel) = (map.points(), map.pixel());
        let axis = usize::from(all[1] as f64 * pixel[1] > all[0] as f64 * pixel[0]);
        let mut halves = [[0; 2]; 2].map(|first| Self { map, first, points: all });
        halves[0].points[axis] = all[axis] / 2;
        halves[1].points[axis] = all[axis] - all[axis] / 2;
        halves[1].first[axis] = all[axis] / 2;
        halves
    }
}

impl Rows for Window<'_> {
    rows_from!(map: pixel precision offset progress is_whole);

    fn points(&self) -> [usize; 2] {
        self.points
    }

    fn boundary(&self) -> Boundary {
        if self.points == self.map.points() { self.map.boundary() } else { Boundary::Open }
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        let mut whole = vec![0.0; self.map.points()[1]];
        self.map.read(self.first[0] + ix, &mut whole);
        row.copy_from_slice(&whole[self.first[1]..self.first[1] + self.points[1]]);
    }

    fn block(&self, rows: std::ops::Range<usize>) -> Option<&[f64]> {
        let is_whole = self.points[1] == self.map.points()[1];
        if is_whole { self.map.block(self.first[0] + rows.start..self.first[0] + rows.end) } else { None }
    }
}

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
    use crate::topography::HeightMap;

    fn map(points: [usize; 2], height: impl Fn(usize) -> f64) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], (0..points[0] * points[1]).map(height).collect(), 0.0).unwrap()
    }

    #[test]
    fn a_picture_has_the_means_of_the_points_that_are_there() {
        let height = |k: usize| if [0, 6, 24].contains(&k) { f64::NAN } else { k as f64 };
        let small = thumbnail(&map([5, 5], height), 3);
        assert_eq!((small.points(), small.pixel()), ([3, 3], [2.0, 4.0]));
        assert_eq!(small.heights()[..8], [3.0, 5.0, 6.5, 13.0, 15.0, 16.5, 20.5, 22.5]);
        assert!(small.heights()[8].is_nan());
        assert_eq!(thumbnail(&small, 3).heights()[..8], small.heights()[..8]);
    }

    #[test]
    fn every_second_and_third_point_of_a_map() {
        let map = map([6, 8], |k| k as f64).periodic();
        let sampled = |every| Sampled { map: &map, every };
        let heights = |every| HeightMap::from_rows(&sampled(every)).into_heights();
        assert_eq!((sampled(2).points(), sampled(2).pixel()), ([3, 4], [2.0, 4.0]));
        assert_eq!(heights(2), [0.0, 2.0, 4.0, 6.0, 16.0, 18.0, 20.0, 22.0, 32.0, 34.0, 36.0, 38.0]);
        assert_eq!(heights(3), [0.0, 3.0, 6.0, 24.0, 27.0, 30.0]);
        assert_eq!(heights(1), map.heights());
        // Three does not divide eight: the last interval along y is shorter.
        let boundaries = [1, 2, 3].map(|every| sampled(every).boundary());
        assert_eq!(boundaries, [Boundary::Periodic, Boundary::Periodic, Boundary::Open]);
        // Rows that are not in memory.
        let part = Window { map: &map, first: [1, 1], points: [5, 7] };
        let of_part = HeightMap::from_rows(&Sampled { map: &part, every: 3 }).into_heights();
        assert_eq!(of_part, [9.0, 12.0, 15.0, 33.0, 36.0, 39.0]);
    }

    #[test]
    fn the_middle_and_the_halves_of_a_map() {
        let map = map([7, 9], |k| k as f64);
        let heights = |window: &Window| HeightMap::from_rows(window).into_heights();
        let middle = Window::centre(&map, 4);
        assert_eq!((middle.points, heights(&middle)[0], heights(&middle)[15]), ([4, 4], 11.0, 41.0));
        assert_eq!(heights(&Window::centre(&map, 9)), map.heights());
        let [first, second] = Window::halves(&map);
        assert_eq!((first.points, second.points, heights(&second)[0]), ([7, 4], [7, 5], 4.0));
        let rows = Window { map: &map, first: [2, 0], points: [3, 9] };
        assert_eq!(rows.block(1..2), Some(&map.heights()[27..36]));
    }

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
