//! Maps derived from a map: a coarse one, every n-th point of it, and a part of it.

use super::rows::rows_from;
use super::{Boundary, HeightMap, Rows};

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
