//! Heights row by row, for maps larger than memory.

use std::cell::Cell;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use crate::numeric::parallel::Results;
use crate::progress::{Progress, Silent};

/// The boundary condition of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// Unknown heights beyond the border.
    #[default]
    Open,
    /// Periodic: the opposite border follows.
    Periodic,
}

/// A source of heights on a rectangular grid, read by rows of constant x. A missing point is NaN.
pub trait Rows: Send + Sync {
    /// Points along x and y.
    fn points(&self) -> [usize; 2];

    /// Distance of neighbouring points along x and y, m.
    fn pixel(&self) -> [f64; 2];

    /// Relative precision of the stored heights; 0 for integers.
    fn precision(&self) -> f64;

    /// The boundary condition.
    fn boundary(&self) -> Boundary;

    /// A height (m) that all heights are relative to: kept apart, so that it costs them no digits.
    fn offset(&self) -> f64 {
        0.0
    }

    /// Whether all heights that were asked for could be read: not where the file of a map became shorter meanwhile. Those that
    /// could not are missing points.
    fn is_whole(&self) -> bool {
        true
    }

    /// Writes the heights (m) at the x index `ix` to `row`, in the order of y.
    fn read(&self, ix: usize, row: &mut [f64]);

    /// Whoever watches the passes over the map. A pass is one unit of work.
    fn progress(&self) -> &dyn Progress {
        &Silent
    }

    /// The heights of contiguous rows, if they are in memory.
    fn block(&self, _rows: Range<usize>) -> Option<&[f64]> {
        None
    }
}

/// Methods of [`Rows`] that a map has from the map in its field `$map`.
macro_rules! rows_from {
    ($map:tt: $($method:ident)*) => {$(
        $crate::topography::rows::rows_from!(@$method $map);
    )*};
    (@points $map:tt) => {
        fn points(&self) -> [usize; 2] {
            self.$map.points()
        }
    };
    (@pixel $map:tt) => {
        fn pixel(&self) -> [f64; 2] {
            self.$map.pixel()
        }
    };
    (@precision $map:tt) => {
        fn precision(&self) -> f64 {
            self.$map.precision()
        }
    };
    (@boundary $map:tt) => {
        fn boundary(&self) -> $crate::topography::Boundary {
            self.$map.boundary()
        }
    };
    (@offset $map:tt) => {
        fn offset(&self) -> f64 {
            self.$map.offset()
        }
    };
    (@is_whole $map:tt) => {
        fn is_whole(&self) -> bool {
            self.$map.is_whole()
        }
    };
    (@progress $map:tt) => {
        fn progress(&self) -> &dyn $crate::progress::Progress {
            self.$map.progress()
        }
    };
}
pub(super) use rows_from;

/// A map that continues periodically beyond its border, as simulated surfaces do.
pub struct Continued(pub Arc<dyn Rows>);

impl Rows for Continued {
    rows_from!(0: points pixel precision offset is_whole);

    fn boundary(&self) -> Boundary {
        Boundary::Periodic
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.0.read(ix, row);
    }

    fn block(&self, rows: Range<usize>) -> Option<&[f64]> {
        self.0.block(rows)
    }
}

/// A map whose passes are watched.
pub struct Watched<'a> {
    /// The map.
    pub map: &'a dyn Rows,
    /// Whoever watches.
    pub progress: &'a dyn Progress,
}

impl Rows for Watched<'_> {
    rows_from!(map: points pixel precision boundary offset is_whole);

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.map.read(ix, row);
    }

    fn progress(&self) -> &dyn Progress {
        self.progress
    }

    fn block(&self, rows: Range<usize>) -> Option<&[f64]> {
        self.map.block(rows)
    }
}

/// Rows per task. Fixed, so that sums do not depend on the number of threads.
const STRIP: usize = 32;

/// Strips processed at a time.
const TURN: usize = 16;

/// Consecutive rows of a map with a halo of neighbouring rows.
pub struct Strip<'a> {
    /// Index of the first row.
    pub first: usize,
    /// Number of rows.
    pub count: usize,
    /// Number of halo rows before the first.
    before: usize,
    columns: usize,
    is_periodic: bool,
    heights: &'a [f64],
}

impl Strip<'_> {
    /// Whether the map is periodic.
    pub fn is_periodic(&self) -> bool {
        self.is_periodic
    }

    /// Row `k` of the strip, halo included: from -halo to count + halo. `None` beyond an open border.
    pub fn row(&self, k: isize) -> Option<&[f64]> {
        let place = usize::try_from(k + self.before as isize).ok()?;
        self.heights.get(place * self.columns..(place + 1) * self.columns)
    }
}

/// Calls `part` with each strip of a map and `halo` rows on both sides of it, in parallel; its results are in the order
/// of the strips, which do not depend on the number of threads. On a periodic map the halo wraps around the border.
pub fn strips<T: Send + Sync>(rows: &dyn Rows, halo: usize, part: impl Fn(Strip) -> T + Sync) -> Vec<T> {
    let results = Results::new(count(rows));
    for_each_strip(rows, halo, 0..count(rows), &|index, strip| results.set(index, part(strip)));
    results.into_vec()
}

fn for_each_strip(rows: &dyn Rows, halo: usize, indices: Range<usize>, task: &(dyn Fn(usize, Strip) + Sync)) {
    indices.into_par_iter().for_each(|index| {
        let nx = rows.points()[0];
        rows.progress().advance(STRIP.min(nx - index * STRIP) as f64 / nx as f64);
        with_buffer(|buffer| task(index, strip(rows, halo, index * STRIP, STRIP, buffer)));
    });
}

/// [`strips`] for large results: `part` adds to an empty result; `take` receives each result in the order of the
/// strips, with the fraction of strips done, and empties it for reuse of its memory.
pub fn strips_in_turn<T: Send + Default>(
    rows: &dyn Rows,
    halo: usize,
    part: impl Fn(Strip, &mut T) + Sync,
    mut take: impl FnMut(&mut T, f64) + Send,
) {
    let count = count(rows);
    let mut taken = 0;
    let mut take_all = |answers: &mut [Mutex<T>]| {
        for answer in answers {
            taken += 1;
            take(answer.get_mut().unwrap_or_else(PoisonError::into_inner), taken as f64 / count as f64);
        }
    };
    let (mut filled, mut other) = (Vec::new(), Vec::new());
    for begin in (0..count).step_by(TURN) {
        let end = count.min(begin + TURN);
        other.resize_with(end - begin, Mutex::default);
        let task = |index: usize, strip: Strip| {
            // One task an answer: nobody waits for the lock.
            part(strip, &mut other[index - begin].lock().unwrap_or_else(PoisonError::into_inner));
        };
        let fill = || for_each_strip(rows, halo, begin..end, &task);
        rayon::join(fill, || take_all(&mut filled));
        std::mem::swap(&mut filled, &mut other);
    }
    take_all(&mut filled);
}

/// Computes `values`, one for each point of a map, by strips of `size` rows with a halo as in [`strips`]: `task` writes
/// those of a strip.
pub fn fill_strips(
    rows: &dyn Rows,
    halo: usize,
    size: usize,
    values: &mut [f64],
    task: &(dyn Fn(Strip, &mut [f64]) + Sync),
) {
    values.par_chunks_mut(size * rows.points()[1]).enumerate().for_each(|(index, values)| {
        let part = values.len() as f64 / (rows.points()[0] * rows.points()[1]) as f64;
        rows.progress().advance(part);
        with_buffer(|buffer| task(strip(rows, halo, index * size, size, buffer), values));
    });
}

/// Calls `task` with a buffer of this thread, which keeps its memory: a new one for each pass over a map costs as much as reading it.
fn with_buffer(task: impl FnOnce(&mut Vec<f64>)) {
    /// Values of the largest buffer that is kept.
    const MOST_KEPT: usize = 1 << 20;
    thread_local! {
        static BUFFER: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
    }
    let mut buffer = BUFFER.take();
    task(&mut buffer);
    if buffer.capacity() <= MOST_KEPT {
        BUFFER.set(buffer);
    }
}

/// Number of strips of a map.
fn count(rows: &dyn Rows) -> usize {
    rows.points()[0].div_ceil(STRIP)
}

/// The strip of at most `size` rows from `first` on, read into `buffer` unless it is in memory.
fn strip<'a>(
    rows: &'a dyn Rows,
    halo: usize,
    first: usize,
    size: usize,
    buffer: &'a mut Vec<f64>,
) -> Strip<'a> {
    let [nx, columns] = rows.points();
    let is_periodic = rows.boundary() == Boundary::Periodic;
    let count = size.min(nx - first);
    let inside = first.saturating_sub(halo)..nx.min(first + count + halo);
    let is_whole = inside.len() == count + 2 * halo;
    let range = if is_periodic {
        first as isize - halo as isize..(first + count + halo) as isize
    } else {
        inside.start as isize..inside.end as isize
    };
    let before = (first as isize - range.start) as usize;
    let in_memory = if is_whole || !is_periodic { rows.block(inside) } else { None };
    let heights = match in_memory {
        Some(heights) => heights,
        None => {
            buffer.resize(range.len() * columns, 0.0);
            for (row, ix) in buffer.chunks_mut(columns).zip(range) {
                rows.read(ix.rem_euclid(nx as isize) as usize, row);
            }
            buffer
        }
    };
    Strip { first, count, before, columns, is_periodic, heights }
}

/// The first present height, m; 0 if all are missing.
pub fn first_present(map: &dyn Rows) -> f64 {
    let [nx, ny] = map.points();
    let mut row = vec![0.0; ny];
    (0..nx)
        .find_map(|ix| {
            map.read(ix, &mut row);
            row.iter().copied().find(|z| !z.is_nan())
        })
        .unwrap_or_default()
}

/// Whether a row has no missing point.
pub struct IsWhole<'a>(pub &'a [f64]);

impl WithSimd for IsWhole<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        count_missing(self.0) == 0
    }
}

/// Number of missing points of a row.
#[inline(always)]
pub fn count_missing(row: &[f64]) -> usize {
    row.iter().filter(|z| z.is_nan()).count()
}
