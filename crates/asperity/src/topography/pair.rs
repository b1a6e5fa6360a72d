//! Two rough bodies as one: the sum of both heights.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Boundary, Filter, FilterError, HeightMap, Rows};
use crate::numeric::parallel::for_each_row;

/// Two rough bodies in contact. Elastic half-spaces without friction touch as the sum of their heights touches a flat: the gap is
/// the separation less z1 + z2, each height measured from its own body towards the other (Johnson 1985, chapter 4). Each map is seen from
/// outside its body, so that the x axis of the second is mirrored.
///
/// How the bodies lie to each other is not known: a [`Placement`] is one of the ways. Maps that repeat are shifted around their border;
/// of others the overlap counts, which is at least [`LEAST_OVERLAP`] of the shorter side along each axis.
#[derive(Debug)]
pub struct RoughPair {
    first: HeightMap,
    /// Mirrored, on the grid of the first; of maps that may be rotated also by 90, 180 and 270 degrees.
    second: Vec<HeightMap>,
}

/// How the second body lies on the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Placement {
    /// Quarter turns of the second body.
    pub turns: usize,
    /// Position of its first point in points of the first body.
    pub shift: [isize; 2],
}

/// Part of the shorter side of two maps that overlaps at least, along each axis.
pub const LEAST_OVERLAP: f64 = 0.75;

/// Nesting index of the S filter before a map is resampled, in points of the coarser grid: shorter waves it cannot hold.
const SHORTEST_WAVE: f64 = 2.0;

/// Relative difference of pixels that count as equal.
const SAME_PIXEL: f64 = 1e-9;

/// Two maps that make no pair.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum PairError {
    /// Maps that repeat must do so in the same way.
    #[error(
        "found maps that repeat after {} x {} points of {} µm and {} x {} points of {} µm; allowed: the same grid, or one map at \
             least that does not repeat",
        points[0][0], points[0][1], micrometres(pixel[0]), points[1][0], points[1][1], micrometres(pixel[1])
    )]
    Periods { points: [[usize; 2]; 2], pixel: [f64; 2] },
    /// Only square grids fall on themselves when they are turned by 90 degrees.
    #[error(
        "found a grid of {} x {} points of {} x {} µm to rotate; allowed: square pixels, and of maps that repeat as many points along both axes", points[0], points[1], micrometres(pixel[0]), micrometres(pixel[1])
    )]
    NotSquare { points: [usize; 2], pixel: [f64; 2] },
    /// A finer map cannot be filtered to the coarser grid.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// The overlap of both maps is too small.
    #[error("the overlap of both maps has {} x {} points; allowed: at least 3 x 3", .0[0], .0[1])]
    TooSmall([usize; 2]),
}

/// A pixel (m) in µm, to a picometre.
fn micrometres(pixel: f64) -> f64 {
    (1e12 * pixel).round() * 1e-6
}

impl RoughPair {
    /// Checks two grids of `points` at a distance of `pixel` (m), of which both or not both `repeat`; `rotates` is whether the second may be
    /// rotated by 90 degrees.
    ///
    /// # Errors
    /// See [`PairError`].
    pub fn check(
        points: [[usize; 2]; 2],
        pixel: [[f64; 2]; 2],
        repeat: bool,
        rotates: bool,
    ) -> Result<(), PairError> {
        let same_pixel = (0..2).all(|axis| is_same(pixel[0][axis], pixel[1][axis]));
        if repeat && (points[0] != points[1] || !same_pixel) {
            return Err(PairError::Periods { points, pixel: [pixel[0][0], pixel[1][0]] });
        }
        let coarser = coarser(pixel);
        let has_square_period = !repeat || points[0][0] == points[0][1];
        if rotates && !(is_same(coarser[0], coarser[1]) && has_square_period) {
            return Err(PairError::NotSquare { points: points[0], pixel: coarser });
        }
        Ok(())
    }

    /// Of the prepared maps of both bodies; `rotates` is whether the second may be rotated by 90 degrees. Different pixels are resampled to
    /// the coarser after an S filter of the nesting index `s` (m), at least two coarse pixels.
    ///
    /// # Errors
    /// See [`PairError`].
    pub fn new(first: HeightMap, second: HeightMap, s: f64, rotates: bool) -> Result<Self, PairError> {
        let repeat = first.boundary() == Boundary::Periodic && second.boundary() == Boundary::Periodic;
        Self::check([first.points, second.points], [first.pixel, second.pixel], repeat, rotates)?;
        let pixel = coarser([first.pixel, second.pixel]);
        let boundary = if repeat { Boundary::Periodic } else { Boundary::Open };
        let on_grid =
            |map: HeightMap| Ok::<_, PairError>(HeightMap { boundary, ..resampled(map, pixel, s)? });
        let (first, second) = (on_grid(first)?, mirrored(&on_grid(second)?));
        let second = if rotates {
            let quarter = rotated(&second);
            let half = rotated(&quarter);
            let three = rotated(&half);
            vec![second, quarter, half, three]
        } else {
            vec![second]
        };
        let pair = Self { first, second };
        let least = [0, 1].map(|axis| (0..pair.second.len()).map(|k| pair.least(k, axis)).min().unwrap_or(0));
        if least.iter().any(|&count| count < 3) { Err(PairError::TooSmall(least)) } else { Ok(pair) }
    }

    /// Whether both maps repeat.
    fn repeats(&self) -> bool {
        self.first.boundary == Boundary::Periodic
    }

    /// The least overlap along an axis, in points.
    fn least(&self, turns: usize, axis: usize) -> usize {
        let shorter = self.first.points[axis].min(self.second[turns].points[axis]);
        if self.repeats() { shorter } else { (LEAST_OVERLAP * shorter as f64).ceil() as usize }
    }

    /// The positions that the first point of the second body may have along an axis, first and last.
    pub fn range(&self, turns: usize, axis: usize) -> [isize; 2] {
        let [first, second] = [&self.first, &self.second[turns]].map(|map| map.points[axis] as isize);
        let least = self.least(turns, axis) as isize;
        if self.repeats() { [0, first - 1] } else { [least - second, first - least] }
    }

    /// A random placement.
    pub fn place(&self, seed: [u8; 32]) -> Placement {
        let mut rng = ChaCha8Rng::from_seed(seed);
        let turns = rng.random_range(0..self.second.len());
        let shift = [0, 1].map(|axis| {
            let [low, high] = self.range(turns, axis);
            rng.random_range(low as i64..=high as i64) as isize
        });
        Placement { turns, shift }
    }

    /// Points of the sum along x and y.
    pub fn overlap(&self, at: Placement) -> [usize; 2] {
        if self.repeats() {
            return self.first.points;
        }
        let second = &self.second[at.turns % self.second.len()];
        [0, 1].map(|axis| {
            let [of_first, of_second] = [&self.first, second].map(|map| map.points[axis] as isize);
            let [start, end] = [at.shift[axis].max(0), of_first.min(at.shift[axis] + of_second)];
            (end - start).max(0) as usize
        })
    }

    /// The sum of both heights where both are, at a placement within [`Self::range`]; missing where one is.
    pub fn sum(&self, at: Placement) -> HeightMap {
        let second = &self.second[at.turns % self.second.len()];
        let of_second = second.points.map(|count| count as isize);
        let start = if self.repeats() { [0; 2] } else { at.shift.map(|shift| shift.max(0)) };
        let points = self.overlap(at);
        let mut heights = vec![f64::NAN; points[0] * points[1]];
        for_each_row(&mut heights, points[1].max(1), &|ix, row| {
            for (iy, z) in row.iter_mut().enumerate() {
                let place = [0, 1].map(|axis| start[axis] + [ix, iy][axis] as isize);
                let other = [0, 1].map(|axis| (place[axis] - at.shift[axis]).rem_euclid(of_second[axis]));
                *z = self.first.at(place) + second.at(other);
            }
        });
        let precision = self.first.precision.max(second.precision);
        let offset = self.first.offset + second.offset;
        HeightMap {
            points,
            pixel: self.first.pixel,
            heights,
            precision,
            boundary: self.first.boundary,
            offset,
        }
    }

    /// Points of the map that has fewer of them.
    pub fn fewest_points(&self) -> usize {
        self.first.heights.len().min(self.second[0].heights.len())
    }

    /// Distance of the points, m.
    pub fn pixel(&self) -> [f64; 2] {
        self.first.pixel
    }
}

impl HeightMap {
    fn at(&self, [ix, iy]: [isize; 2]) -> f64 {
        self.heights[ix as usize * self.points[1] + iy as usize]
    }

    fn rearranged(&self, points: [usize; 2], from: impl Fn(usize, usize) -> [usize; 2] + Sync) -> Self {
        let mut heights = vec![0.0; self.heights.len()];
        for_each_row(&mut heights, points[1], &|ix, row| {
            row.iter_mut().enumerate().for_each(|(iy, z)| *z = self.at(from(ix, iy).map(|k| k as isize)));
        });
        let pixel = if points == self.points { self.pixel } else { [self.pixel[1], self.pixel[0]] };
        Self { points, pixel, heights, ..*self }
    }
}

/// The map with its x axis mirrored.
fn mirrored(map: &HeightMap) -> HeightMap {
    let last = map.points[0] - 1;
    map.rearranged(map.points, |ix, iy| [last - ix, iy])
}

/// The map rotated by 90 degrees.
fn rotated(map: &HeightMap) -> HeightMap {
    let [nx, ny] = map.points;
    map.rearranged([ny, nx], |ix, iy| [iy, ny - 1 - ix])
}

fn is_same(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < SAME_PIXEL
}

/// The coarser of two pixels along each axis.
fn coarser([first, second]: [[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|axis| first[axis].max(second[axis]))
}

/// The map on a coarser grid; the same where the grid is its own.
fn resampled(map: HeightMap, pixel: [f64; 2], s: f64) -> Result<HeightMap, FilterError> {
    if [0, 1].iter().all(|&axis| is_same(map.pixel[axis], pixel[axis])) {
        return Ok(map);
    }
    let s = s.max(SHORTEST_WAVE * pixel[0].max(pixel[1]));
    let smooth = Filter::new(Some(s), None)?.apply(&map)?;
    let ratio = [0, 1].map(|axis| pixel[axis] / map.pixel[axis]);
    let points = [0, 1].map(|axis| ((map.points[axis] - 1) as f64 / ratio[axis]) as usize + 1);
    let mut heights = vec![0.0; points[0] * points[1]];
    for_each_row(&mut heights, points[1], &|ix, row| {
        for (iy, z) in row.iter_mut().enumerate() {
            *z = smooth.between([ix as f64 * ratio[0], iy as f64 * ratio[1]]);
        }
    });
    Ok(HeightMap { points, pixel, heights, ..smooth })
}

impl HeightMap {
    /// The height between points by cubic convolution (Keys 1981), with the border continued; missing beside missing points.
    fn between(&self, place: [f64; 2]) -> f64 {
        let base = place.map(f64::floor);
        let weights = [0, 1].map(|axis| cubic(place[axis] - base[axis]));
        let index = |axis: usize, k: usize| {
            (base[axis] as isize + k as isize - 1).clamp(0, self.points[axis] as isize - 1)
        };
        let along_y =
            |i: usize| -> f64 { (0..4).map(|j| weights[1][j] * self.at([index(0, i), index(1, j)])).sum() };
        (0..4).map(|i| weights[0][i] * along_y(i)).sum()
    }
}

/// Weights of the points at -1, 0, 1 and 2 for a place from 0 to 1.
fn cubic(t: f64) -> [f64; 4] {
    [
        -0.5 * t * (1.0 - t) * (1.0 - t),
        1.0 + t * t * (1.5 * t - 2.5),
        t * (0.5 + t * (2.0 - 1.5 * t)),
        -0.5 * t * t * (1.0 - t),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(points: [usize; 2], pixel: f64, of: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |k: usize| of((k / points[1]) as f64, (k % points[1]) as f64);
        HeightMap::new(points, [pixel; 2], (0..points[0] * points[1]).map(at).collect(), 0.0).unwrap()
    }

    fn pair(first: HeightMap, second: HeightMap) -> RoughPair {
        RoughPair::new(first, second, 0.0, false).unwrap()
    }

    const HERE: Placement = Placement { turns: 0, shift: [0; 2] };

    /// The heights of a map and of its negative, mirrored, cancel everywhere.
    #[test]
    fn a_map_and_its_mirrored_negative_cancel() {
        let of = |x: f64, y: f64| (0.7 * x).sin() + 0.3 * (x * y).cos();
        let body = map([8, 6], 1.0, of);
        let negative = map([8, 6], 1.0, |x, y| -of(7.0 - x, y));
        for (body, negative) in [(body.clone(), negative.clone()), (body.periodic(), negative.periodic())] {
            assert!(pair(body, negative).sum(HERE).heights.iter().all(|z| z.abs() < 1e-15));
        }
    }

    #[test]
    fn maps_that_do_not_repeat_count_where_they_overlap() {
        let pair = pair(map([8, 8], 1.0, |x, _| x), map([4, 16], 1.0, |_, y| 100.0 * y));
        assert_eq!(([0, 1].map(|axis| pair.range(0, axis))), [[-1, 5], [-10, 2]]);
        let sum = pair.sum(Placement { turns: 0, shift: [5, -10] });
        assert_eq!((sum.points, sum.at([0, 0]), sum.at([2, 5])), ([3, 6], 5.0 + 1000.0, 7.0 + 1500.0));
        for k in 0..50 {
            let placement = pair.place([k; 32]);
            let sum = pair.sum(placement);
            assert!(sum.points[0] >= 3 && sum.points[1] >= 6 && sum.heights.iter().all(|z| z.is_finite()));
        }
    }

    #[test]
    fn maps_that_repeat_are_shifted_around() {
        let pair =
            pair(map([4, 4], 1.0, |_, _| 0.0).periodic(), map([4, 4], 1.0, |x, y| 10.0 * x + y).periodic());
        let sum = pair.sum(Placement { turns: 0, shift: [1, 2] });
        assert_eq!(sum.boundary(), Boundary::Periodic);
        // Mirrored, 0 is 3 along x.
        assert_eq!((sum.at([1, 2]), sum.at([0, 0])), (30.0, 2.0));
    }

    #[test]
    fn a_body_may_be_rotated() {
        let flat = || map([5, 5], 1.0, |_, _| 0.0);
        let made = RoughPair::new(flat(), map([5, 5], 1.0, |x, _| x), 0.0, true).unwrap();
        let corners = |turns: usize| {
            let sum = made.sum(Placement { turns, shift: [0; 2] });
            [sum.at([0, 0]), sum.at([4, 0]), sum.at([4, 4]), sum.at([0, 4])]
        };
        let mut found = corners(0);
        for turns in 1..4 {
            // Each corner goes to the next one.
            found.rotate_right(1);
            assert_eq!(corners(turns), found, "{turns}");
        }
        let oblong = HeightMap::new([5, 5], [1.0, 2.0], vec![0.0; 25], 0.0).unwrap();
        assert_eq!(
            RoughPair::new(flat(), oblong, 0.0, true).unwrap_err(),
            PairError::NotSquare { points: [5; 2], pixel: [1.0, 2.0] }
        );
        // Random placements take all rotations.
        let turns: std::collections::HashSet<usize> = (0..50).map(|k| made.place([k; 32]).turns).collect();
        assert_eq!(turns.len(), 4);
        let other = RoughPair::new(flat().periodic(), map([5, 6], 1.0, |_, _| 0.0).periodic(), 0.0, false);
        assert!(matches!(other, Err(PairError::Periods { .. })));
    }

    /// Long waves are the same on the coarser grid, and short ones are gone.
    #[test]
    fn a_finer_map_is_resampled() {
        let wave = |length: f64| move |x: f64, _: f64| (std::f64::consts::TAU * x / length).sin();
        let resample = |map: HeightMap| resampled(map, [3.0; 2], 0.0).unwrap();
        let long = resample(map([301, 31], 1.0, wave(100.0)));
        assert_eq!((long.points, long.pixel), ([101, 11], [3.0; 2]));
        for ix in 20..80 {
            assert!((long.at([ix, 5]) - wave(100.0)(3.0 * ix as f64, 0.0)).abs() < 5e-3, "{ix}");
        }
        let short = resample(map([301, 31], 1.0, wave(2.5)));
        assert!((20..80).all(|ix| short.at([ix, 5]).abs() < 0.05));
        // The S filter of the coarser map holds for it, too.
        let [all, filtered] =
            [0.0, 30.0].map(|s| resampled(map([301, 61], 1.0, wave(12.0)), [3.0; 2], s).unwrap());
        let highest = |map: &HeightMap| (20..80).map(|ix| map.at([ix, 5]).abs()).fold(0.0, f64::max);
        assert!(highest(&all) > 0.7 && highest(&filtered) < 0.05);
        let own = map([9, 9], 3.0, wave(9.0));
        assert_eq!(resample(own.clone()).heights, own.heights);
    }
}
