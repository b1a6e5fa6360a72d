//! Summits of a map: five-point (Greenwood 1984), or higher than all eight neighbours.

use crate::named_enum;

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

mod plateau;
#[cfg(test)]
mod tests;

use plateau::LevelPoint;

use super::rows::{Boundary, IsWhole, Rows, Strip, strips_in_turn};
use crate::memory::reserve;

named_enum! {
    /// The neighbours that a summit must be higher than.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum Neighbours {
        /// The four nearest along x and y: five-point summits (Greenwood 1984).
        #[default]
        Four = "five-point",
        /// Also the four diagonal ones.
        Eight = "eight-neighbour",
    }
}

impl Neighbours {
    pub(super) const fn steps(self) -> &'static [[isize; 2]] {
        match self {
            Self::Four => STEPS.split_at(4).0,
            Self::Eight => &STEPS,
        }
    }
}

/// Steps to the neighbours along x and y, the four nearest first.
const STEPS: [[isize; 2]; 8] = [[-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [-1, 1], [1, -1], [1, 1]];

/// Properties computed for each summit besides height and curvature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Detail {
    /// Positions of the summits.
    pub positions: bool,
    /// Both principal curvatures.
    pub principal: bool,
    /// Drops to the four nearest neighbours.
    pub drops: bool,
}

impl Detail {
    /// All details.
    pub const ALL: Self = Self { positions: true, principal: true, drops: true };
}

/// The summits of a map, in file order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Summits {
    /// Index of each summit, the y index running fastest; for a plateau, of its first point. Empty unless requested.
    pub positions: Vec<usize>,
    /// Heights, m.
    pub heights: Vec<f64>,
    /// Curvatures, 1/m, positive: the mean of those along x and y.
    pub curvatures: Vec<f64>,
    /// Principal curvatures, 1/m, the larger first; empty unless requested. The smaller one is not positive at a saddle
    /// between the four lower neighbours.
    pub principal: Vec<[f64; 2]>,
    /// Drops from the summits to each of their lower neighbours, m; empty unless requested.
    pub drops: Vec<f64>,
    /// Number of points tested: those present with all neighbours present, inside an open border. The nominal area is
    /// this number of pixels.
    pub tested: usize,
    /// Number of plateaus of equal heights, including dropped ones.
    pub plateaus: usize,
    /// Number of plateaus dropped because their mean curvature is not positive.
    pub dropped: usize,
}

/// Curvature tensor at a point, 1/m: along x, along y, mixed.
#[derive(Debug, Clone, Copy, Default)]
struct CurvatureTensor([f64; 3]);

impl CurvatureTensor {
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

/// Summits of one strip of rows, or of all strips so far.
#[derive(Default)]
struct Part {
    summits: Summits,
    level: Vec<LevelPoint>,
}

impl Part {
    /// Appends the summits of the next strip, after which the fraction `done` of the map has been searched.
    fn append(&mut self, part: &mut Self, done: f64) {
        let (summits, more) = (&mut self.summits, &mut part.summits);
        // The rank of a plateau includes the summits of previous strips.
        let before = summits.heights.len();
        self.level
            .extend(part.level.drain(..).map(|point| LevelPoint { rank: before + point.rank, ..point }));
        append(&mut summits.positions, &mut more.positions, done);
        append(&mut summits.heights, &mut more.heights, done);
        append(&mut summits.curvatures, &mut more.curvatures, done);
        append(&mut summits.principal, &mut more.principal, done);
        append(&mut summits.drops, &mut more.drops, done);
        summits.tested += std::mem::take(&mut more.tested);
    }
}

/// Appends a list, reserving memory by extrapolation of the number of summits.
fn append<T>(list: &mut Vec<T>, more: &mut Vec<T>, done: f64) {
    let count = list.len() + more.len();
    if count > list.capacity() {
        let expected = 1.2 * count as f64 / done;
        reserve(list, (expected as usize).min(16 * count));
    }
    list.append(more);
}

/// The five-point summits of a map (Greenwood 1984), with all details.
pub fn five_point(map: &dyn Rows) -> Summits {
    find(map, Neighbours::Four, Detail::ALL)
}

/// Finds the points that are strictly higher than their neighbours. Equal heights form a plateau: if all points around
/// it are lower, it counts as one summit, at its first point in file order, with the mean curvature of its points; if
/// that is not positive, it is dropped.
///
/// The curvature of a point is the mean of (2 z0 - zW - zE)/dx^2 and (2 z0 - zS - zN)/dy^2. Principal curvatures take
/// the mixed derivative from the diagonal neighbours, (zNW + zSE - zNE - zSW)/(4 dx dy); where some of these are
/// missing, from the complete quadrants.
///
/// Rows are read once, strip by strip. The result does not depend on the number of threads.
pub fn find(map: &dyn Rows, neighbours: Neighbours, detail: Detail) -> Summits {
    find_in_rows(map, 0..map.points()[0], neighbours, detail)
}

/// The same, of the summits and tested points in some `rows` of the map alone: parts of a map, each with a halo of rows on
/// either side, have the summits of the whole. A plateau belongs to the row of its first point; one that is longer than the
/// halo is not found.
pub fn find_in_rows(map: &dyn Rows, rows: Range<usize>, neighbours: Neighbours, detail: Detail) -> Summits {
    let finder = Finder {
        rows,
        points: map.points(),
        pixel: map.pixel(),
        is_periodic: map.boundary() == Boundary::Periodic,
        neighbours,
        detail,
    };
    let arch = Arch::new();
    let mut all = Part::default();
    strips_in_turn(
        map,
        1,
        |strip, part| finder.strip(arch, &strip, part),
        |part, done| all.append(part, done),
    );
    let Part { mut summits, level } = all;
    if !level.is_empty() {
        finder.add_plateaus(&level, &mut summits);
    }
    summits
}

struct Finder {
    /// Whose summits are kept.
    rows: Range<usize>,
    points: [usize; 2],
    pixel: [f64; 2],
    is_periodic: bool,
    neighbours: Neighbours,
    detail: Detail,
}

/// A row and its two neighbours.
#[derive(Clone, Copy)]
struct Window<'a>([&'a [f64]; 3]);

impl Window<'_> {
    /// The height at `step` from the point `iy` of the middle row, wrapped around the border (which is not reached on
    /// an open map).
    fn at(&self, iy: usize, [dx, dy]: [isize; 2]) -> f64 {
        let row = self.0[(1 + dx) as usize];
        let place = iy.wrapping_add_signed(dy);
        // The first point follows the last; before the first (an index that wraps to a huge one) is the last.
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
    fn strip(&self, arch: Arch, strip: &Strip, part: &mut Part) {
        let mut flags = vec![false; self.points[1]];
        let is_whole = |row: &[f64]| arch.dispatch(IsWhole(row));
        let mut whole = [strip.row(-1).is_some_and(is_whole), strip.row(0).is_some_and(is_whole), false];
        for k in 0..strip.count as isize {
            whole[2] = strip.row(k + 1).is_some_and(is_whole);
            // The first and last rows of an open map lack a neighbour.
            if let (Some(before), Some(row), Some(after)) = (strip.row(k - 1), strip.row(k), strip.row(k + 1))
            {
                let window = Window([before, row, after]);
                let is_own = self.rows.contains(&(strip.first + k as usize));
                if is_own {
                    part.summits.tested += self.tested(window, whole == [true; 3]);
                }
                arch.dispatch(Mark { window, neighbours: self.neighbours, flags: &mut flags });
                self.row(window, (strip.first + k as usize) * self.points[1], is_own, &mut flags, part);
            }
            whole.rotate_left(1);
        }
    }

    /// Number of points of the middle row that can be tested.
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

    /// Keeps the flagged points of one row and, on a periodic map, its first and last point if they qualify. The row's
    /// first point has the position `start`.
    fn row(&self, window: Window, start: usize, is_own: bool, flags: &mut [bool], part: &mut Part) {
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
                let iy = block * u64::BITS as usize + marked.trailing_zeros() as usize;
                self.keep(window, start, iy, is_own, part);
                marked &= marked - 1;
            }
        }
    }

    /// Keeps a point that is not lower than any of its neighbours: of a row that is not the finder's own, only to complete
    /// plateaus.
    #[inline]
    fn keep(&self, window: Window, start: usize, iy: usize, is_own: bool, part: &mut Part) {
        let steps = self.neighbours.steps();
        let z = window.0[1][iy];
        let nearest = [0, 1, 2, 3].map(|k| window.at(iy, STEPS[k]));
        let is_level = nearest.contains(&z) || steps[4..].iter().any(|&step| window.at(iy, step) == z);
        let mut curvature_tensor = self.curvature_tensor(z, nearest);
        if self.detail.principal {
            curvature_tensor.0[2] = mixed(window, iy) / (self.pixel[0] * self.pixel[1]);
        }
        let drops = nearest.map(|other| z - other);
        let position = start + iy;
        if is_level {
            let equal = (0..)
                .zip(steps)
                .fold(0, |equal, (bit, &step)| equal | u8::from(window.at(iy, step) == z) << bit);
            let rank = part.summits.heights.len();
            part.level.push(LevelPoint { position, rank, height: z, curvature_tensor, equal, drops });
            return;
        }
        if !is_own {
            return;
        }
        let summits = &mut part.summits;
        if self.detail.positions {
            summits.positions.push(position);
        }
        summits.heights.push(z);
        summits.curvatures.push(curvature_tensor.curvature());
        if self.detail.principal {
            summits.principal.push(curvature_tensor.principal());
        }
        if self.detail.drops {
            summits.drops.extend(drops);
        }
    }

    /// Curvatures along x and y from a height and its four nearest neighbours.
    #[inline]
    fn curvature_tensor(&self, z: f64, [west, east, south, north]: [f64; 4]) -> CurvatureTensor {
        let [dx, dy] = self.pixel;
        CurvatureTensor([(2.0 * z - west - east) / (dx * dx), (2.0 * z - south - north) / (dy * dy), 0.0])
    }
}

/// Packs up to 64 flags into bits.
fn bits(flags: &[bool]) -> u64 {
    /// Multiplier that gathers the low bits of eight bytes in the highest byte, in order.
    const GATHER: u64 = 0x0102_0408_1020_4080;
    let (bytes, rest) = flags.as_chunks::<8>();
    let eight = |flags: &[bool; 8]| u64::from_le_bytes(flags.map(u8::from)).wrapping_mul(GATHER) >> 56;
    let whole = bytes.iter().enumerate().fold(0, |all, (k, flags)| all | eight(flags) << (8 * k));
    rest.iter().zip(8 * bytes.len()..).fold(whole, |all, (&flag, k)| all | u64::from(flag) << k)
}

/// Marks the inner points of the middle row that are not lower than any of their neighbours. Written to be vectorised
/// by the compiler.
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

/// The mixed curvature, 1/m: the mean over the quadrants whose corner is present; 0 if none is.
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
