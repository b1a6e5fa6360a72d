//! Spikes: points that the instrument got wrong, as opposed to sharp but real summits.

use std::collections::{BTreeMap, BTreeSet};

use super::NORMAL;
use crate::numeric::median;
use crate::topography::rows::rows_from;
use crate::topography::{Boundary, Rows, Strip, strips};

/// Half the side of the window (in points) whose median is the local height.
const REACH: isize = 4;

/// The largest group of points that is a spike: a square of six points; wider ones are features of the surface.
const MOST_POINTS: usize = 36;

/// A spike deviates from the local height by at least this many robust standard deviations of all such deviations. On
/// Gaussian surfaces the largest is 6; the heaviest tails tested (exponential heights) reach more, but not with steep walls.
const LEAST_DEVIATION: f64 = 15.0;

/// The same of a single point that is narrower than the shortest waves of the map.
const LEAST_NARROW_DEVIATION: f64 = 6.0;

/// A single point that deviates by less, but by at least this, is suspect: a verdict must not depend on it.
const LEAST_SUSPECT_DEVIATION: f64 = 2.5;

/// The most points that are suspect, the highest ones.
const MOST_SUSPECTS: usize = 100;

/// A single point is narrower than the shortest waves if the part of its deviation that is one pixel wide along both axes
/// ([`Local::narrow`]) is at least this share of it. Of summits whose shortest waves are three pixels long the share is at most 0.1 on
/// Gaussian surfaces, 0.5 with exponential heights, where one deviates by more than 4 robust standard deviations; that of
/// a wrong point is about 1.
const LEAST_NARROWNESS: f64 = 0.7;

/// The grid resolves the shortest waves if the robust standard deviation of the parts that are one pixel wide is at most this share of that of
/// the deviations: 0.04 to 0.14 with waves of three to four pixels, 0.24 with two, 0.5 with noise or height steps.
const RESOLVED: f64 = 0.2;

/// A spike falls by at least this share of its height, on average, within the one pixel around it. Summits that the grid
/// resolves fall by at most 0.5 of it there, sharp pits of a measured surface by 0.6, spikes of a single point by all of it.
const LEAST_WALL: f64 = 0.7;

/// Rows around a strip that a spike in it can depend on: the climb to its peak, its points, and the window of a median.
const HALO: isize = 2 * MOST_POINTS as isize + REACH;

/// Points along each axis of the sample that the scale of deviations is taken from.
const SAMPLED: usize = 100;

/// The spikes of a map: groups of at most 36 points that stand above or below their surroundings by steep walls on all sides.
///
/// A deviation is that of a point from the median of the 9 x 9 points around it. A spike is the set of connected points around
/// a local extremum whose deviation is above half of the extremum's A. A exceeds 15 robust standard deviations of the
/// deviations of the map, or 6 where a single point is narrower than waves that the grid resolves; and from the points of the set to those
/// around it the deviation falls by 0.7 A on average.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spikes {
    /// Indices of the points, ascending, the y index running fastest.
    pub points: Vec<usize>,
    /// The highest or lowest point of each spike, in the same order.
    pub peaks: Vec<usize>,
    /// The largest deviation of a spike, m.
    pub largest: f64,
    /// Single points that are as narrow as spikes but lower: at most the hundred highest above or below their surroundings; ascending.
    pub suspects: Vec<usize>,
}

impl Spikes {
    /// The spikes of `map` as measured; bit-identical for any number of threads.
    pub fn find(map: &dyn Rows) -> Self {
        let scale = Scale::new(map);
        let mut all = Self::default();
        if scale.deviation <= 0.0 {
            return all;
        }
        let mut suspects = Vec::new();
        for (part, suspect) in strips(map, HALO as usize, |strip| Local::new(map, &strip).spikes(&scale)) {
            all.points.extend(part.points);
            all.peaks.extend(part.peaks);
            all.largest = all.largest.max(part.largest);
            suspects.extend(suspect);
        }
        all.points.sort_unstable();
        all.points.dedup();
        all.peaks.sort_unstable();
        suspects.sort_by(|a: &(usize, f64), b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        all.suspects = suspects.into_iter().take(MOST_SUSPECTS).map(|(point, _)| point).collect();
        all.suspects.sort_unstable();
        all
    }

    /// Robust standard deviation (m) of the deviations of the points of `map` from the medians around them, in which those of spikes are
    /// measured.
    pub fn scale(map: &dyn Rows) -> f64 {
        Scale::new(map).deviation
    }

    /// Number of spikes.
    pub fn count(&self) -> usize {
        self.peaks.len()
    }
}

/// What deviations are measured in.
struct Scale {
    /// Robust standard deviation of the deviations from local medians, m; at least a fifth of that of the differences between
    /// neighbours, because a point of a smooth slope is the median of those around it.
    deviation: f64,
    /// Whether the grid resolves the shortest waves.
    is_resolved: bool,
}

impl Scale {
    /// From a sample of the points.
    fn new(map: &dyn Rows) -> Self {
        let strides = map.points().map(|count| count.div_ceil(SAMPLED));
        let sampled = |strip: Strip| {
            let local = Local::new(map, &strip);
            let rows =
                (0..strip.count as isize).filter(|k| (strip.first + *k as usize).is_multiple_of(strides[0]));
            let points =
                rows.flat_map(|k| (0..local.columns).step_by(strides[1]).map(move |j| [k, j as isize]));
            let at = |[row, column]: Point| {
                let deviation = local.deviation([row, column])?.abs();
                let step = local.height([row, column + 1])? - local.height([row, column])?;
                Some([deviation, step.abs(), local.narrow([row, column])?.abs()])
            };
            points.filter_map(at).collect::<Vec<[f64; 3]>>()
        };
        let sample = strips(map, REACH as usize, sampled).concat();
        if sample.is_empty() {
            return Self { deviation: 0.0, is_resolved: false };
        }
        let robust = |which: usize| {
            let mut values: Vec<f64> = sample.iter().map(|at| at[which]).collect();
            // On height steps most may be zero.
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            median(&mut values).filter(|middle| *middle > 0.0).map_or(mean, |middle| NORMAL * middle)
        };
        let deviation = robust(0);
        Self { deviation: deviation.max(0.2 * robust(1)), is_resolved: robust(2) <= RESOLVED * deviation }
    }
}

/// The points around a strip, by row (from the first of the strip) and column.
struct Local<'a> {
    strip: &'a Strip<'a>,
    columns: usize,
    is_periodic: bool,
}

type Point = [isize; 2];

impl<'a> Local<'a> {
    fn new(map: &dyn Rows, strip: &'a Strip<'a>) -> Self {
        Self { strip, columns: map.points()[1], is_periodic: map.boundary() == Boundary::Periodic }
    }

    /// Height of a point, m; `None` beyond an open border or where it is missing.
    fn height(&self, [row, column]: Point) -> Option<f64> {
        let column = if self.is_periodic { column.rem_euclid(self.columns as isize) } else { column };
        let z = *self.strip.row(row)?.get(usize::try_from(column).ok()?)?;
        (!z.is_nan()).then_some(z)
    }

    /// Height above the median of the window around a point, m.
    fn deviation(&self, point: Point) -> Option<f64> {
        const SIDE: usize = 2 * REACH as usize + 1;
        let z = self.height(point)?;
        let (mut window, mut count) = ([0.0; SIDE * SIDE], 0);
        for row in point[0] - REACH..=point[0] + REACH {
            for column in point[1] - REACH..=point[1] + REACH {
                if let Some(height) = self.height([row, column]) {
                    window[count] = height;
                    count += 1;
                }
            }
        }
        Some(z - median(&mut window[..count])?)
    }

    /// The part of the height of a point (m) that is one pixel wide along both axes: a quarter of its second difference along x of
    /// the second differences along y, which is the height of a single point on a plane. `None` at a border or beside a missing
    /// point.
    fn narrow(&self, [row, column]: Point) -> Option<f64> {
        let rows = [-1, 0, 1].map(|step| self.strip.row(row + step));
        let first = usize::try_from(column - 1).ok()?;
        let [before, at, after] = rows.map(|row| row?.get(first..first + 3).map(second));
        Some(0.25 * (before? - 2.0 * at? + after?)).filter(|narrow| !narrow.is_nan())
    }

    /// The spikes that have their peaks in the strip, and the suspects with their deviations (m).
    fn spikes(&self, scale: &Scale) -> (Spikes, Vec<(usize, f64)>) {
        let mut found = Spikes::default();
        let mut suspects = Vec::new();
        let mut deviations = BTreeMap::new();
        let mut peaks = BTreeSet::new();
        let mut at = |point: Point| *deviations.entry(point).or_insert_with(|| self.deviation(point));
        let mut add = |points: Vec<Point>, peak: Point, height: f64| {
            found.peaks.extend(self.index(peak));
            found.largest = found.largest.max(height);
            found.points.extend(points.into_iter().filter_map(|point| self.index(point)));
        };
        for point in self.walls(LEAST_WALL * LEAST_DEVIATION * scale.deviation) {
            let Some(deviation) =
                at(point).filter(|deviation| deviation.abs() > LEAST_DEVIATION * scale.deviation)
            else {
                continue;
            };
            let mut above = |point: Point| at(point).map(|other| deviation.signum() * other);
            let peak = climb(point, &mut above);
            if !(0..self.strip.count as isize).contains(&peak[0]) || !peaks.insert(peak) {
                continue;
            }
            if let Some((points, height)) = group(peak, &mut above) {
                add(points, peak, height);
            }
        }
        for (point, narrow) in self.narrow_points(scale) {
            let mut above = |point: Point| at(point).map(|deviation| narrow.signum() * deviation);
            let Some((points, height)) = group(point, &mut above) else { continue };
            let is_narrow = points.len() == 1 && narrow.abs() >= LEAST_NARROWNESS * height;
            if !is_narrow || peaks.contains(&point) {
                continue;
            }
            if height > LEAST_NARROW_DEVIATION * scale.deviation {
                add(points, point, height);
            } else if height > LEAST_SUSPECT_DEVIATION * scale.deviation {
                suspects.extend(self.index(point).map(|point| (point, height)));
            }
        }
        (found, suspects)
    }

    /// The points of the strip that may be narrow suspects, with the part of their heights (m) that is one pixel wide; none where
    /// the grid does not resolve the shortest waves.
    fn narrow_points(&self, scale: &Scale) -> Vec<(Point, f64)> {
        let least = LEAST_NARROWNESS * LEAST_SUSPECT_DEVIATION * scale.deviation;
        let rows = if scale.is_resolved { 0..self.strip.count as isize } else { 0..0 };
        let points = rows.flat_map(|row| (1..self.columns as isize - 1).map(move |column| [row, column]));
        points
            .filter_map(|point| Some((point, self.narrow(point)?)))
            .filter(|(_, narrow)| narrow.abs() >= least)
            .collect()
    }

    /// The points on both sides of each step of at least `height` (m) between neighbours; a spike that has its peak in the
    /// strip has one within reach.
    fn walls(&self, height: f64) -> Vec<Point> {
        let reach = MOST_POINTS as isize;
        let mut points = Vec::new();
        for row in -reach..self.strip.count as isize + reach {
            let Some(heights) = self.strip.row(row) else { continue };
            let steps =
                heights.windows(2).enumerate().filter(|(_, pair)| (pair[1] - pair[0]).abs() >= height);
            for (column, _) in steps {
                points.extend([[row, column as isize], [row, column as isize + 1]]);
            }
            let Some(next) = self.strip.row(row + 1) else { continue };
            let steps = heights
                .iter()
                .zip(next)
                .enumerate()
                .filter(|(_, (below, above))| (*above - *below).abs() >= height);
            for (column, _) in steps {
                points.extend([[row, column as isize], [row + 1, column as isize]]);
            }
        }
        points
    }

    /// Index of a point of the map.
    fn index(&self, [row, column]: Point) -> Option<usize> {
        let row = usize::try_from(self.strip.first as isize + row).ok()?;
        let column = usize::try_from(column).ok().filter(|column| *column < self.columns)?;
        Some(row * self.columns + column)
    }
}

/// The second difference of three heights.
fn second(heights: &[f64]) -> f64 {
    heights[0] - 2.0 * heights[1] + heights[2]
}

/// The eight neighbours of a point.
fn around([row, column]: Point) -> impl Iterator<Item = Point> {
    const STEPS: [isize; 3] = [-1, 0, 1];
    let all = STEPS.into_iter().flat_map(|i| STEPS.into_iter().map(move |j| [i, j]));
    all.filter(|step| *step != [0, 0]).map(move |[i, j]| [row + i, column + j])
}

/// The local maximum that is reached from a point by steps to the highest neighbour.
fn climb(mut point: Point, above: &mut dyn FnMut(Point) -> Option<f64>) -> Point {
    for _ in 0..MOST_POINTS {
        let here = above(point).unwrap_or(f64::NEG_INFINITY);
        let mut highest = (here, point);
        for next in around(point) {
            let height = above(next).unwrap_or(f64::NEG_INFINITY);
            if height > highest.0 {
                highest = (height, next);
            }
        }
        if highest.1 == point {
            break;
        }
        point = highest.1;
    }
    point
}

/// The points of a spike around its `peak`, and the height of the peak; `None` where there is no spike.
fn group(peak: Point, above: &mut dyn FnMut(Point) -> Option<f64>) -> Option<(Vec<Point>, f64)> {
    let height = above(peak)?;
    let mut points = vec![peak];
    let mut next = 0;
    while let Some(&point) = points.get(next) {
        next += 1;
        for neighbour in around(point) {
            if !points.contains(&neighbour) && above(neighbour).is_some_and(|above| above > 0.5 * height) {
                points.push(neighbour);
            }
        }
        if points.len() > MOST_POINTS {
            return None;
        }
    }
    let (mut falls, mut count) = (0.0, 0);
    for &[row, column] in &points {
        for outside in [[row - 1, column], [row + 1, column], [row, column - 1], [row, column + 1]] {
            let Some(level) = above(outside).filter(|_| !points.contains(&outside)) else { continue };
            falls += above([row, column])? - level;
            count += 1;
        }
    }
    (count > 0 && falls > LEAST_WALL * height * f64::from(count)).then_some((points, height))
}

/// A map with some of its points missing.
pub struct Without<'a> {
    /// The map.
    pub map: &'a dyn Rows,
    /// Indices of the points left out, ascending, the y index running fastest.
    pub points: &'a [usize],
}

impl Rows for Without<'_> {
    rows_from!(map: points pixel precision boundary offset progress is_whole);

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.map.read(ix, row);
        let (first, end) = (ix * row.len(), (ix + 1) * row.len());
        let start = self.points.partition_point(|&point| point < first);
        for &point in self.points[start..].iter().take_while(|&&point| point < end) {
            row[point - first] = f64::NAN;
        }
    }

    fn block(&self, rows: std::ops::Range<usize>) -> Option<&[f64]> {
        let columns = self.map.points()[1];
        let start = self.points.partition_point(|&point| point < rows.start * columns);
        let is_touched = self.points.get(start).is_some_and(|&point| point < rows.end * columns);
        if is_touched { None } else { self.map.block(rows) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::HeightMap;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    const POINTS: [usize; 2] = [200, 150];

    /// A surface of unit variance with the cut-off at `cut_off` points.
    fn surface(cut_off: f64, seed: u8) -> Vec<f64> {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 32.0, cut_off };
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid(POINTS, [1.0; 2]);
        gaussian(&spectrum, 1.0, [seed; 32])
    }

    fn map(heights: Vec<f64>) -> HeightMap {
        HeightMap::new(POINTS, [1.0; 2], heights, 0.0).unwrap()
    }

    #[test]
    fn planted_spikes_are_found_point_by_point() {
        for cut_off in [2.0, 4.0, 8.0] {
            let mut heights = surface(cut_off, 1);
            assert!(Spikes::find(&map(heights.clone())).points.is_empty());
            // Single points, two beside each other, a square of five, one at the border, one across a strip.
            let square = (0..25).map(|k| (100 + k / 5) * 150 + 70 + k % 5);
            let mut planted: Vec<usize> = vec![20 * 150 + 30, 0, 50 * 150 + 149, 60 * 150 + 9, 60 * 150 + 10];
            planted.extend([31 * 150 + 77, 32 * 150 + 77]);
            planted.extend(square);
            for (k, &point) in planted.iter().enumerate() {
                heights[point] += if k == 2 { -12.0 } else { 12.0 };
            }
            let found = Spikes::find(&map(heights));
            planted.sort_unstable();
            assert_eq!(found.points, planted, "{cut_off}");
            assert!(found.largest > 9.0 && found.largest < 18.0, "{}", found.largest);
        }
    }

    /// Points 6 robust standard deviations high and more are found where the grid resolves the waves, lower ones suspected; on a clean
    /// map none is.
    #[test]
    fn low_points_narrower_than_the_waves_are_found_or_suspected() {
        let raised = |cut_off: f64, deviations: f64| {
            let mut heights = surface(cut_off, 1);
            let clean = map(heights.clone());
            let scale = Spikes::scale(&clean);
            let planted: Vec<usize> = (0..20).map(|k| (9 * k + 7) * 150 + 5 * k + 20).collect();
            for &point in &planted {
                let mut around: Vec<f64> =
                    (0..81).map(|k| clean.heights()[point + 150 * (k / 9) + k % 9 - 4 * 150 - 4]).collect();
                heights[point] = median(&mut around).unwrap() + deviations * scale;
            }
            let found = Spikes::find(&map(heights));
            assert!(found.points.iter().chain(&found.suspects).all(|point| planted.contains(point)));
            [found.count(), found.suspects.len()]
        };
        for cut_off in [3.0, 4.0, 8.0] {
            assert_eq!(raised(cut_off, 12.0), [20, 0], "{cut_off}");
            let [spikes, suspects] = raised(cut_off, 5.0);
            assert!(spikes == 0 && suspects > 10, "{cut_off} {spikes} {suspects}");
        }
        assert_eq!(raised(2.0, 10.0), [0, 0], "as narrow as the waves");
        assert_eq!(raised(2.0, 17.0)[0], 20);
        for (cut_off, seed) in [(3.0, 2), (4.0, 3), (8.0, 4)] {
            let clean = surface(cut_off, seed);
            let tailed = clean.iter().map(|z| (0.8 * z).exp()).collect();
            assert_eq!([clean, tailed].map(|z| Spikes::find(&map(z)).suspects.len()), [0; 2], "{cut_off}");
        }
    }

    /// Heavy tails are resolved summits, not spikes: exponential heights, and bumps of two points' width.
    #[test]
    fn sharp_but_real_summits_are_no_spikes() {
        for (cut_off, seed) in [(4.0, 1), (4.0, 2), (8.0, 3), (16.0, 4)] {
            let tailed: Vec<f64> = surface(cut_off, seed).into_iter().map(|z| (0.8 * z).exp()).collect();
            assert_eq!(Spikes::find(&map(tailed)).count(), 0, "{cut_off}");
        }
        let mut heights = surface(8.0, 5);
        for (i, j) in (0..200).flat_map(|i| (0..150).map(move |j| (i, j))) {
            let square = (f64::from(i) - 90.0).powi(2) + (f64::from(j) - 80.0).powi(2);
            heights[(i * 150 + j) as usize] += 20.0 * (-0.5 * square / 1.5f64.powi(2)).exp();
        }
        assert_eq!(Spikes::find(&map(heights)).count(), 0);
    }

    #[test]
    fn removed_points_are_missing_and_nothing_else_changes() {
        let map = map(surface(8.0, 6));
        let points = [3, 150, 151, 29_999];
        let without = HeightMap::from_rows(&Without { map: &map, points: &points });
        for (k, (now, before)) in without.heights().iter().zip(map.heights()).enumerate() {
            assert!(if points.contains(&k) { now.is_nan() } else { now == before }, "{k}");
        }
        let without = Without { map: &map, points: &points };
        assert!(without.block(0..1).is_none() && without.block(5..190).is_some());
    }

    #[test]
    fn a_flat_map_has_none() {
        assert_eq!(Spikes::find(&map(vec![1.0; 200 * 150])), Spikes::default());
    }
}
