//! Summits of a map: five-point (Greenwood 1984), or higher than all eight neighbours.

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use serde::Deserialize;

use super::rows::{Boundary, Rows, Strip, count_missing, strips};

/// Which neighbours a summit is higher than.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Neighbours {
    /// The four beside it along x and y: five-point summits (Greenwood 1984).
    #[default]
    Four,
    /// The diagonal ones too.
    Eight,
}

impl Neighbours {
    /// As reports name the summits.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Four => "five-point",
            Self::Eight => "eight-neighbour",
        }
    }

    const fn steps(self) -> &'static [[isize; 2]] {
        match self {
            Self::Four => STEPS.split_at(4).0,
            Self::Eight => &STEPS,
        }
    }
}

/// Steps to the neighbours along x and y, the four nearest first.
const STEPS: [[isize; 2]; 8] = [[-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [-1, 1], [1, -1], [1, 1]];

/// What is found besides height and curvature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Detail {
    /// Both principal curvatures.
    pub principal: bool,
    /// Drops to the four nearest neighbours.
    pub drops: bool,
}

impl Detail {
    /// Everything.
    pub const ALL: Self = Self { principal: true, drops: true };
}

/// The summits of a map, in file order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Summits {
    /// Index of each summit, the y index running fastest; of a plateau its first point.
    pub positions: Vec<usize>,
    /// Heights, m.
    pub heights: Vec<f64>,
    /// Curvatures, 1/m, positive: the mean of those along x and y.
    pub curvatures: Vec<f64>,
    /// Principal curvatures, 1/m, the larger first; empty unless asked for. The smaller one is not
    /// positive where four lower neighbours hide a saddle between them.
    pub principal: Vec<[f64; 2]>,
    /// Drops from the summits to each of their lower neighbours, m; empty unless asked for.
    pub drops: Vec<f64>,
    /// Number of points that were tested: those that are present, inside an open border, and have all
    /// neighbours. The nominal area is this many pixels.
    pub tested: usize,
    /// Plateaus of equal heights among the summits, dropped ones included.
    pub plateaus: usize,
    /// Plateaus left out because their mean curvature is not positive.
    pub dropped: usize,
}

/// Second derivatives at a point with the sign of a curvature, 1/m: along x, along y, mixed.
#[derive(Debug, Clone, Copy, Default)]
struct Bend([f64; 3]);

impl Bend {
    fn curvature(self) -> f64 {
        0.5 * (self.0[0] + self.0[1])
    }

    /// Eigenvalues, the larger first.
    fn principal(self) -> [f64; 2] {
        let [x, y, mixed] = self.0;
        let half = (0.5 * (x - y)).hypot(mixed);
        [self.curvature() + half, self.curvature() - half]
    }
}

/// A point that is as high as some of its neighbours and lower than none.
struct LevelPoint {
    position: usize,
    height: f64,
    bend: Bend,
    /// A bit for each neighbour that is as high.
    equal: u8,
    drops: [f64; 4],
}

/// What one strip of rows holds.
#[derive(Default)]
struct Part {
    summits: Summits,
    level: Vec<LevelPoint>,
}

/// Five-point summits with everything known of them.
pub fn five_point(map: &dyn Rows) -> Summits {
    find(map, Neighbours::Four, Detail::ALL)
}

/// Finds the points that are strictly higher than their neighbours. Equal heights form a plateau: if
/// all points around it are lower, it counts once, at its first point in file order, with the mean of
/// its points' curvatures; where that is not positive it is dropped.
///
/// The curvature of a point is the mean of (2 z0 - zW - zE)/dx^2 and (2 z0 - zS - zN)/dy^2. Principal curvatures
/// take the mixed derivative from the diagonal neighbours, (zNW + zSE - zNE - zSW)/(4 dx dy); where some
/// of these are missing, from the quadrants that are whole.
///
/// Rows are read once, strip by strip; the same on any number of threads.
pub fn find(map: &dyn Rows, neighbours: Neighbours, detail: Detail) -> Summits {
    let finder = Finder {
        points: map.points(),
        pixel: map.pixel(),
        is_periodic: map.boundary() == Boundary::Periodic,
        neighbours,
        detail,
    };
    let arch = Arch::new();
    let mut parts = strips(map, 1, |strip| finder.strip(arch, &strip));
    let level: Vec<LevelPoint> = parts.iter_mut().flat_map(|part| std::mem::take(&mut part.level)).collect();
    let mut found = Summits {
        positions: joined(&parts, |part| &part.summits.positions),
        heights: joined(&parts, |part| &part.summits.heights),
        curvatures: joined(&parts, |part| &part.summits.curvatures),
        principal: joined(&parts, |part| &part.summits.principal),
        drops: joined(&parts, |part| &part.summits.drops),
        tested: parts.iter().map(|part| part.summits.tested).sum(),
        ..Summits::default()
    };
    if !level.is_empty() {
        finder.add_plateaus(&level, &mut found);
    }
    found
}

/// The lists of all parts, one after another.
fn joined<T: Copy + Default + Send + Sync>(parts: &[Part], list: impl Fn(&Part) -> &Vec<T>) -> Vec<T> {
    let mut all = vec![T::default(); parts.iter().map(|part| list(part).len()).sum()];
    let mut rest = &mut all[..];
    let mut places = Vec::new();
    for part in parts {
        let (place, beyond) = rest.split_at_mut(list(part).len());
        places.push((place, &list(part)[..]));
        rest = beyond;
    }
    places.into_par_iter().for_each(|(place, list)| place.copy_from_slice(list));
    all
}

struct Finder {
    points: [usize; 2],
    pixel: [f64; 2],
    is_periodic: bool,
    neighbours: Neighbours,
    detail: Detail,
}

/// A row and the two beside it.
#[derive(Clone, Copy)]
struct Window<'a>([&'a [f64]; 3]);

impl Window<'_> {
    /// The height `step` away from the point `iy` of the middle row; around the border on a periodic map,
    /// beyond which nobody asks on an open one.
    fn at(&self, iy: usize, [dx, dy]: [isize; 2]) -> f64 {
        let row = self.0[(1 + dx) as usize];
        let place = iy.wrapping_add_signed(dy);
        // Beyond the last point comes the first, before the first (which wraps to a huge index) the last.
        row[if place < row.len() {
            place
        } else if dy > 0 {
            0
        } else {
            row.len() - 1
        }]
    }
}

impl Finder {
    fn strip(&self, arch: Arch, strip: &Strip) -> Part {
        let mut part = Part::default();
        let mut flags = vec![false; self.points[1]];
        let is_whole = |row: &[f64]| arch.dispatch(IsWhole(row));
        let mut whole = [strip.row(-1).is_some_and(is_whole), strip.row(0).is_some_and(is_whole), false];
        for k in 0..strip.count as isize {
            whole[2] = strip.row(k + 1).is_some_and(is_whole);
            // An open map ends where there is no next row.
            if let (Some(before), Some(row), Some(after)) = (strip.row(k - 1), strip.row(k), strip.row(k + 1))
            {
                let window = Window([before, row, after]);
                part.summits.tested += self.tested(window, whole == [true; 3]);
                arch.dispatch(Mark { window, neighbours: self.neighbours, flags: &mut flags });
                self.row(window, (strip.first + k as usize) * self.points[1], &mut flags, &mut part);
            }
            whole.rotate_left(1);
        }
        part
    }

    /// How many points of the middle row can be tested.
    fn tested(&self, window: Window, is_whole: bool) -> usize {
        let inside = if self.is_periodic { 0..self.points[1] } else { 1..self.points[1] - 1 };
        if is_whole {
            return inside.len();
        }
        let is_there = |&iy: &usize| {
            let mut around = self.neighbours.steps().iter().map(|&step| window.at(iy, step));
            !window.0[1][iy].is_nan() && around.all(|z| !z.is_nan())
        };
        inside.filter(is_there).count()
    }

    /// Keeps the points of one row that are flagged, and the first and the last of a periodic map where they
    /// should be. The row's first point has the position `start`.
    fn row(&self, window: Window, start: usize, flags: &mut [bool], part: &mut Part) {
        let count = self.points[1];
        let steps = self.neighbours.steps();
        if self.is_periodic {
            for iy in [0, count - 1] {
                flags[iy] = steps.iter().all(|&step| window.0[1][iy] >= window.at(iy, step));
            }
        }
        for (block, some) in flags.chunks(u64::BITS as usize).enumerate() {
            let mut marked = bits(some);
            while marked != 0 {
                self.keep(window, start, block * u64::BITS as usize + marked.trailing_zeros() as usize, part);
                marked &= marked - 1;
            }
        }
    }

    /// Keeps a point that is lower than none of its neighbours.
    #[inline]
    fn keep(&self, window: Window, start: usize, iy: usize, part: &mut Part) {
        let steps = self.neighbours.steps();
        let z = window.0[1][iy];
        let nearest = [0, 1, 2, 3].map(|k| window.at(iy, STEPS[k]));
        let is_level = nearest.contains(&z) || steps[4..].iter().any(|&step| window.at(iy, step) == z);
        let mut bend = self.bend(z, nearest);
        if self.detail.principal {
            bend.0[2] = mixed(window, iy) / (self.pixel[0] * self.pixel[1]);
        }
        let drops = nearest.map(|other| z - other);
        let position = start + iy;
        if is_level {
            let equal = (0..)
                .zip(steps)
                .fold(0, |equal, (bit, &step)| equal | u8::from(window.at(iy, step) == z) << bit);
            part.level.push(LevelPoint { position, height: z, bend, equal, drops });
            return;
        }
        let summits = &mut part.summits;
        summits.positions.push(position);
        summits.heights.push(z);
        summits.curvatures.push(bend.curvature());
        if self.detail.principal {
            summits.principal.push(bend.principal());
        }
        if self.detail.drops {
            summits.drops.extend(drops);
        }
    }

    /// Second derivatives along x and y, of a height and those west, east, south and north of it.
    #[inline]
    fn bend(&self, z: f64, [west, east, south, north]: [f64; 4]) -> Bend {
        let [dx, dy] = self.pixel;
        Bend([(2.0 * z - west - east) / (dx * dx), (2.0 * z - south - north) / (dy * dy), 0.0])
    }

    /// The position `step` away, around the border of a periodic map; `None` beyond an open one.
    fn neighbour(&self, position: usize, step: [isize; 2]) -> Option<usize> {
        let here = [position / self.points[1], position % self.points[1]];
        let mut there = [0; 2];
        for axis in 0..2 {
            let count = self.points[axis] as isize;
            let index = here[axis] as isize + step[axis];
            if !self.is_periodic && !(0..count).contains(&index) {
                return None;
            }
            there[axis] = index.rem_euclid(count) as usize;
        }
        Some(there[0] * self.points[1] + there[1])
    }

    /// Each plateau is walked once, over its points that are lower than none of their neighbours; it is a
    /// summit if all its points are such. `level` is in file order.
    fn add_plateaus(&self, level: &[LevelPoint], found: &mut Summits) {
        // Where each row of the map begins in the list: a neighbour is looked for in its row alone.
        let columns = self.points[1];
        let mut starts = vec![0; self.points[0] + 1];
        for point in level {
            starts[point.position / columns + 1] += 1;
        }
        for row in 0..self.points[0] {
            starts[row + 1] += starts[row];
        }
        let place = |position: usize, from: usize| {
            // On a wide plateau the neighbour along the row is the next of the list.
            for near in [from.wrapping_sub(1), from + 1] {
                if level.get(near).is_some_and(|point| point.position == position) {
                    return Some(near);
                }
            }
            let row = position / columns;
            let found =
                level[starts[row]..starts[row + 1]].binary_search_by_key(&position, |point| point.position);
            found.ok().map(|place| starts[row] + place)
        };
        let mut seen = vec![false; level.len()];
        let mut summits = Vec::new();
        for start in 0..level.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let mut plateau = vec![start];
            let mut is_summit = true;
            let mut next = 0;
            while let Some(&member) = plateau.get(next) {
                next += 1;
                let point = &level[member];
                for (bit, &step) in self.neighbours.steps().iter().enumerate() {
                    if point.equal & (1 << bit) == 0 {
                        continue;
                    }
                    // A point as high that is not in the list is lower than another, or was not tested: the
                    // plateau rises there, or may.
                    let neighbour = self.neighbour(point.position, step);
                    match neighbour.and_then(|position| place(position, member)) {
                        Some(other) if !seen[other] => {
                            seen[other] = true;
                            plateau.push(other);
                        }
                        Some(_) => {}
                        None => is_summit = false,
                    }
                }
            }
            if is_summit {
                summits.push(plateau);
            }
        }
        found.plateaus = summits.len();
        let mut kept = Vec::new();
        for plateau in summits {
            let mut mean = Bend::default();
            for &member in &plateau {
                for (sum, part) in mean.0.iter_mut().zip(level[member].bend.0) {
                    *sum += part / plateau.len() as f64;
                }
            }
            if mean.curvature() <= 0.0 {
                found.dropped += 1;
                continue;
            }
            if self.detail.drops {
                let drops = plateau.iter().flat_map(|&member| level[member].drops);
                found.drops.extend(drops.filter(|&drop| drop > 0.0));
            }
            // Walking began at its first point in file order.
            kept.push((&level[plateau[0]], mean));
        }
        self.merge(found, &kept);
    }

    /// Puts plateaus, which are in file order, among the other summits.
    fn merge(&self, found: &mut Summits, plateaus: &[(&LevelPoint, Bend)]) {
        let strict = found.positions.len();
        let mut order: Vec<(usize, usize)> = found.positions.iter().copied().zip(0..).collect();
        order.extend(plateaus.iter().map(|plateau| plateau.0.position).zip(strict..));
        order.sort_unstable();
        found.heights.extend(plateaus.iter().map(|plateau| plateau.0.height));
        found.curvatures.extend(plateaus.iter().map(|plateau| plateau.1.curvature()));
        found.positions = order.iter().map(|&(position, _)| position).collect();
        found.heights = order.iter().map(|&(_, from)| found.heights[from]).collect();
        found.curvatures = order.iter().map(|&(_, from)| found.curvatures[from]).collect();
        if self.detail.principal {
            found.principal.extend(plateaus.iter().map(|plateau| plateau.1.principal()));
            found.principal = order.iter().map(|&(_, from)| found.principal[from]).collect();
        }
    }
}

/// A bit for each of up to 64 flags.
fn bits(flags: &[bool]) -> u64 {
    /// Gathers the low bits of eight bytes in the highest byte, the first lowest.
    const GATHER: u64 = 0x0102_0408_1020_4080;
    let (bytes, rest) = flags.as_chunks::<8>();
    let eight = |flags: &[bool; 8]| u64::from_le_bytes(flags.map(u8::from)).wrapping_mul(GATHER) >> 56;
    let whole = bytes.iter().enumerate().fold(0, |all, (k, flags)| all | eight(flags) << (8 * k));
    rest.iter().zip(8 * bytes.len()..).fold(whole, |all, (&flag, k)| all | u64::from(flag) << k)
}

/// Marks the inner points of the middle row that are lower than none of their neighbours. Written so that
/// compilers make it comparisons of many points at a time, as wide as the machine has them.
struct Mark<'a> {
    window: Window<'a>,
    neighbours: Neighbours,
    flags: &'a mut [bool],
}

impl WithSimd for Mark<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { window: Window([before, row, after]), neighbours, flags } = self;
        let inner = row.len() - 2;
        (flags[0], flags[inner + 1]) = (false, false);
        let flags = &mut flags[1..=inner];
        let z = &row[1..=inner];
        let beside = [&before[1..=inner], &after[1..=inner], &row[..inner], &row[2..inner + 2]];
        for i in 0..inner {
            let z = z[i];
            flags[i] = (z >= beside[0][i]) & (z >= beside[1][i]) & (z >= beside[2][i]) & (z >= beside[3][i]);
        }
        if neighbours == Neighbours::Eight {
            let beside = [&before[..inner], &before[2..inner + 2], &after[..inner], &after[2..inner + 2]];
            for i in 0..inner {
                let z = z[i];
                flags[i] &=
                    (z >= beside[0][i]) & (z >= beside[1][i]) & (z >= beside[2][i]) & (z >= beside[3][i]);
            }
        }
    }
}

/// Whether a row has no missing point.
struct IsWhole<'a>(&'a [f64]);

impl WithSimd for IsWhole<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        count_missing(self.0) == 0
    }
}

/// The mixed second difference with the sign of a curvature: the mean over the quadrants whose corner is
/// there; 0 if none is.
fn mixed(window: Window, iy: usize) -> f64 {
    let z = window.0[1][iy];
    let quadrant = |&[dx, dy]: &[isize; 2]| {
        let corner = window.at(iy, [dx, dy]);
        let twist = corner - window.at(iy, [dx, 0]) - window.at(iy, [0, dy]) + z;
        (!corner.is_nan()).then_some(-((dx * dy) as f64) * twist)
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for twist in STEPS[4..].iter().filter_map(quadrant) {
        sum += twist;
        count += 1.0;
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::HeightMap;
    use rand::{RngExt, SeedableRng};
    use std::collections::{BTreeMap, BTreeSet};

    fn map(points: [usize; 2], heights: Vec<f64>) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], heights, 0.0).unwrap()
    }

    #[test]
    fn one_summit_and_its_curvature() {
        let mut heights = vec![0.0; 25];
        heights[12] = 4.0;
        heights[11] = 1.0;
        let found = five_point(&map([5, 5], heights));
        assert_eq!((found.positions, found.heights, found.tested), (vec![12], vec![4.0], 9));
        assert_eq!(found.curvatures, [0.5 * (8.0 / 1.0 + 7.0 / 4.0)]);
        assert_eq!(found.drops, [4.0, 4.0, 3.0, 4.0]);
    }

    #[test]
    fn borders_and_points_beside_missing_ones_are_not_tested() {
        let mut heights = vec![0.0; 30];
        heights[1] = 9.0;
        heights[8] = 5.0;
        heights[16] = 5.0;
        heights[22] = f64::NAN;
        let found = five_point(&map([5, 6], heights));
        assert_eq!(found.positions, [8]);
        // 3 x 4 inside the border, less the missing point and its two neighbours inside.
        assert_eq!(found.tested, 12 - 3);
    }

    /// The same by words: every connected set of equal heights, tested point by point.
    fn oracle(map: &HeightMap, neighbours: Neighbours) -> (BTreeMap<usize, f64>, usize, usize, usize) {
        let [nx, ny] = map.points().map(|count| count as isize);
        let is_periodic = map.boundary() == Boundary::Periodic;
        let z = |[ix, iy]: [isize; 2]| map.heights()[(ix.rem_euclid(nx) * ny + iy.rem_euclid(ny)) as usize];
        let around = |[ix, iy]: [isize; 2]| neighbours.steps().iter().map(move |[dx, dy]| [ix + dx, iy + dy]);
        let inside = |[ix, iy]: [isize; 2]| is_periodic || (ix > 0 && iy > 0 && ix + 1 < nx && iy + 1 < ny);
        let is_tested =
            |point| inside(point) && !z(point).is_nan() && around(point).all(|other| !z(other).is_nan());
        let (mut summits, mut tested, mut plateaus, mut dropped) = (BTreeMap::new(), 0, 0, 0);
        for point in (0..nx).flat_map(|ix| (0..ny).map(move |iy| [ix, iy])) {
            tested += usize::from(is_tested(point));
            let mut set = vec![point];
            let mut seen = BTreeSet::from([point]);
            let mut k = 0;
            while k < set.len() {
                for other in around(set[k]) {
                    let is_on = is_periodic || ((0..nx).contains(&other[0]) && (0..ny).contains(&other[1]));
                    let other = [other[0].rem_euclid(nx), other[1].rem_euclid(ny)];
                    if is_on && z(other) == z(point) && seen.insert(other) {
                        set.push(other);
                    }
                }
                k += 1;
            }
            let is_first = set.iter().all(|&other| other >= point);
            let is_top = set
                .iter()
                .all(|&member| is_tested(member) && around(member).all(|other| z(other) <= z(member)));
            if !(is_first && is_top) {
                continue;
            }
            let bend = |[a, b]: [isize; 2]| {
                0.5 * ((2.0 * z([a, b]) - z([a - 1, b]) - z([a + 1, b]))
                    + (2.0 * z([a, b]) - z([a, b - 1]) - z([a, b + 1])) / 4.0)
            };
            let mean = set.iter().map(|&member| bend(member)).sum::<f64>() / set.len() as f64;
            plateaus += usize::from(set.len() > 1);
            if mean > 0.0 {
                summits.insert((point[0] * ny + point[1]) as usize, mean);
            } else {
                dropped += 1;
            }
        }
        (summits, tested, plateaus, dropped)
    }

    #[test]
    fn random_maps_full_of_plateaus() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut all_plateaus = [0; 4];
        for levels in [2, 3, 5, 50, 100_000] {
            for holes in [0.0, 0.02] {
                let heights = (0..45 * 31)
                    .map(|_| {
                        if rng.random_bool(holes) { f64::NAN } else { f64::from(rng.random_range(0..levels)) }
                    })
                    .collect();
                let open = map([45, 31], heights);
                for (k, (map, neighbours)) in [&open, &open.clone().periodic()]
                    .into_iter()
                    .flat_map(|map| [(map, Neighbours::Four), (map, Neighbours::Eight)])
                    .enumerate()
                {
                    let found = find(map, neighbours, Detail::ALL);
                    let (summits, tested, plateaus, dropped) = oracle(map, neighbours);
                    assert_eq!(found.positions, summits.keys().copied().collect::<Vec<_>>());
                    assert!(
                        found.positions.iter().zip(&found.heights).all(|(&at, &z)| map.heights()[at] == z)
                    );
                    for (a, b) in found.curvatures.iter().zip(summits.values()) {
                        assert!((a - b).abs() < 1e-12);
                    }
                    for (curvature, principal) in found.curvatures.iter().zip(&found.principal) {
                        assert!(
                            (0.5 * (principal[0] + principal[1]) - curvature).abs() < 1e-9 * principal[0]
                        );
                    }
                    assert_eq!((found.tested, found.plateaus, found.dropped), (tested, plateaus, dropped));
                    all_plateaus[k] += plateaus;
                }
            }
        }
        assert!(all_plateaus.iter().all(|&count| count > 50), "{all_plateaus:?}");
    }

    /// On a paraboloid with any axes the nine points give both curvatures exactly, also where corners are missing.
    #[test]
    fn principal_curvatures_of_a_paraboloid() {
        for (large, small, angle) in [(3.0, 1.0, 0.0), (3.0, 1.0, 0.4), (2.0, 2.0, 1.0), (5.0, -0.2, 0.3)] {
            let (sin, cos) = f64::sin_cos(angle);
            let height = |k: usize| {
                let (x, y) = ((k / 5) as f64 - 2.0, 2.0 * ((k % 5) as f64 - 2.0));
                let (u, v) = (x * cos + y * sin, y * cos - x * sin);
                -0.5 * (large * u * u + small * v * v)
            };
            for missing in [vec![], vec![6], vec![6, 18], vec![6, 8, 16, 18]] {
                let mut heights: Vec<f64> = (0..25).map(height).collect();
                missing.iter().for_each(|&k: &usize| heights[k] = f64::NAN);
                let found = find(&map([5, 5], heights), Neighbours::Four, Detail::ALL);
                let place = found.positions.iter().position(|&at| at == 12).unwrap();
                let [k1, k2] = found.principal[place];
                if missing.len() < 4 {
                    assert!(
                        (k1 - large).abs() < 1e-12 && (k2 - small).abs() < 1e-12,
                        "{missing:?}: {k1} {k2}"
                    );
                }
                assert!((0.5 * (k1 + k2) - found.curvatures[place]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn one_giant_plateau_is_walked_once() {
        let mut heights = vec![1.0; 1000 * 1000];
        let found = five_point(&map([1000, 1000], heights.clone()));
        assert_eq!((found.positions.len(), found.plateaus), (0, 0));
        // Lower borders make a mesa of it: one summit, at its first point.
        for k in 0..1000 {
            for point in [k, 999_000 + k, k * 1000, k * 1000 + 999] {
                heights[point] = 0.0;
            }
        }
        let found = five_point(&map([1000, 1000], heights));
        assert_eq!((found.positions, found.plateaus), (vec![1001], 1));
    }

    #[test]
    fn zeros_of_both_signs_are_equal() {
        let mut heights = vec![-1.0; 36];
        heights[14] = 0.0;
        heights[15] = -0.0;
        let found = five_point(&map([6, 6], heights));
        assert_eq!((found.positions, found.plateaus), (vec![14], 1));
    }
}
