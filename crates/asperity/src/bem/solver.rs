//! The contact of a height map with a flat, load by load.

use std::borrow::Cow;
use std::cell::Cell;

use super::active::{Points, filled};
use super::compliance::ElasticPair;
use super::contact::Contact;
use super::convolution::Convolution;
use super::descent::{Descent, Grid, Target};
use super::patch::PatchGrid;
use super::preconditioner::Stencil;
use super::refine::{coarser, coarser_points, finer};
use super::tangent::Tangent;
use super::{Boundary, Options, SolverError};
use crate::literature::{self, Paper};
use crate::numeric::is_positive;
use crate::numeric::lanes::Real;
use crate::numeric::sum::{Terms, sums_over};
use crate::progress::Progress;
use crate::topography::HeightMap;

/// Points along the shorter side of a map that is solved without a coarser one.
const COARSEST: usize = 48;

/// Error at which the solution on a coarser grid ends.
const COARSE_ERROR: f64 = 1e-3;

/// Steps after which a load is given up.
const STEPS: usize = 2000;

/// How far the load of a solution may be from what is asked for: more was lost in rounding.
const LOAD_ERROR: f64 = 1e-9;

/// Part of the progress of a load on coarser grids.
const COARSE_PROGRESS: f64 = 0.3;

/// The largest part of missing points that are interpolated.
pub const MOST_MISSING: f64 = 0.01;

/// The contact of one height map with a flat body, at any number of loads.
pub struct Solver<'a> {
    /// The map, then every second point of it, and so on.
    levels: Vec<Level<'a>>,
    /// m.
    pixel: [f64; 2],
    boundary: Boundary,
    error: f64,
    cap: f64,
    interpolated: usize,
    reduced_modulus: f64,
    is_layered: bool,
}

struct Level<'a> {
    points: [usize; 2],
    heights: Cow<'a, [f64]>,
    /// Mean and standard deviation, m.
    moments: [f64; 2],
    convolution: Convolution,
    stencil: Stencil,
}

impl<'a> Level<'a> {
    fn new(
        heights: Cow<'a, [f64]>,
        points: [usize; 2],
        pixel: [f64; 2],
        pair: &ElasticPair,
        boundary: Boundary,
    ) -> Self {
        Self {
            points,
            moments: moments(&heights),
            heights,
            convolution: Convolution::new(points, pixel, pair, boundary),
            stencil: Stencil::new(pixel, pair, 0.0),
        }
    }
}

/// Mean and standard deviation.
fn moments(heights: &[f64]) -> [f64; 2] {
    let count = heights.len() as f64;
    let sums = |mean: f64| sums_over([heights], Powers { mean }).map(|sum| sum / count);
    let [mean, _] = sums(0.0);
    [mean, sums(mean)[1].sqrt()]
}

/// Heights above a mean, and their squares.
#[derive(Clone, Copy)]
struct Powers {
    mean: f64,
}

impl Terms<1, 2> for Powers {
    #[inline(always)]
    fn of<N: Real>(self, [height]: [N; 1]) -> [N; 2] {
        let above = height - self.mean;
        [above, above * above]
    }
}

/// Pressures, and the gaps of points without.
#[derive(Clone, Copy)]
struct LoadAndGap {
    level: f64,
}

impl Terms<2, 2> for LoadAndGap {
    #[inline(always)]
    fn of<N: Real>(self, [pressure, gap]: [N; 2]) -> [N; 2] {
        let zero = pressure.splat(0.0);
        let above = gap - self.level;
        let is_open = pressure.le(zero) & zero.lt(above);
        [pressure, N::select(is_open, above, zero)]
    }
}

impl<'a> Solver<'a> {
    /// A solver for `map` under `pair`. Missing points are interpolated, for the solver alone.
    ///
    /// # Errors
    /// More than 1 % of the points missing; equal heights; a cap under a layer; options out of range.
    pub fn new(map: &'a HeightMap, pair: &ElasticPair, options: &Options) -> Result<Self, SolverError> {
        let Options { boundary, error, cap } = *options;
        if !(Options::ERRORS.contains(&error)) {
            return Err(SolverError::Error(error));
        }
        if let Some(cap) = cap {
            if !is_positive(cap) {
                return Err(SolverError::Cap(cap));
            }
            if pair.is_layered() {
                return Err(SolverError::CapUnderLayer);
            }
        }
        let (heights, points) = (map.heights(), map.points());
        let interpolated = heights.iter().filter(|z| z.is_nan()).count();
        if interpolated as f64 > MOST_MISSING * heights.len() as f64 {
            return Err(SolverError::Missing { missing: interpolated, points: heights.len() });
        }
        let heights = if interpolated > 0 { filled(heights, points).into() } else { Cow::Borrowed(heights) };
        let mut pixel = map.pixel();
        let mut levels = vec![Level::new(heights, points, pixel, pair, boundary)];
        let [_, deviation] = levels[0].moments;
        if deviation.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
            return Err(SolverError::Flat);
        }
        while let Some(finest) = levels.last().filter(|level| level.points.iter().all(|&n| n >= 2 * COARSEST))
        {
            pixel = pixel.map(|side| 2.0 * side);
            let heights = coarser(&finest.heights, finest.points);
            let points = coarser_points(finest.points);
            levels.push(Level::new(heights.into(), points, pixel, pair, boundary));
        }
        let reduced_modulus = pair.reduced_modulus();
        let (pixel, cap) = (map.pixel(), cap.unwrap_or(f64::INFINITY));
        let is_layered = pair.is_layered();
        Ok(Self { levels, pixel, boundary, error, cap, interpolated, reduced_modulus, is_layered })
    }

    /// E* of two half-spaces, Pa; `None` under a layer.
    pub fn half_space_modulus(&self) -> Option<f64> {
        (!self.is_layered).then_some(self.reduced_modulus)
    }

    /// Missing points that were interpolated.
    pub fn interpolated(&self) -> usize {
        self.interpolated
    }

    /// The contact under a mean pressure (Pa) on the nominal area: one unit of progress.
    ///
    /// # Errors
    /// A pressure that is not positive, not below the cap, or lost in rounding; no convergence.
    pub fn at_pressure(&self, pressure: f64, progress: &dyn Progress) -> Result<Contact, SolverError> {
        // On a thread of the pool: each parallel pass would wake one and wait for it otherwise.
        rayon::join(|| self.solved(pressure, progress), || ()).0
    }

    fn solved(&self, pressure: f64, progress: &dyn Progress) -> Result<Contact, SolverError> {
        if !is_positive(pressure) || pressure >= self.cap {
            return Err(SolverError::Pressure { pressure, cap: self.cap });
        }
        // All of the load on one point would move that by less than rounding of the heights.
        let Level { heights, moments: [_, deviation], stencil, .. } = &self.levels[0];
        if pressure * heights.len() as f64 <= f64::EPSILON * deviation * stencil.centre {
            return Err(SolverError::TooLight(pressure));
        }
        let mut coarser: Option<Vec<f64>> = None;
        for (depth, level) in self.levels.iter().enumerate().rev() {
            let is_finest = depth == 0;
            let error = if is_finest { self.error } else { self.error.max(COARSE_ERROR) };
            let target = Target { pressure, cap: self.cap, error, steps: STEPS, is_near: coarser.is_some() };
            let of_level = if is_finest { 1.0 - COARSE_PROGRESS } else { 0.0 };
            let start = |i: usize, row: &mut [f64]| match &coarser {
                Some(pressures) => finer(pressures, level.points, self.boundary.wraps(), i, row),
                None => row.fill(pressure),
            };
            let descent = level.descend(start, target, self.boundary, of_level, progress);
            if is_finest {
                return self.contact(pressure, descent);
            }
            coarser = Some(descent.pressures);
            progress.advance(COARSE_PROGRESS / (self.levels.len() - 1) as f64);
        }
        Err(SolverError::Flat)
    }

    fn contact(&self, pressure: f64, descent: Descent) -> Result<Contact, SolverError> {
        let Descent { pressures, gaps, level, error, steps, convolutions } = descent;
        if !error.is_finite() {
            return Err(SolverError::TooLight(pressure));
        }
        if error > self.error {
            return Err(SolverError::NotConverged { pressure, error, steps, wanted: self.error });
        }
        let count = pressures.len() as f64;
        let [load, mean_gap] = sums_over([&pressures, &gaps], LoadAndGap { level }).map(|sum| sum / count);
        if (load / pressure - 1.0).abs() > LOAD_ERROR {
            return Err(SolverError::TooLight(pressure));
        }
        Ok(Contact {
            points: self.levels[0].points,
            pixel: self.pixel,
            boundary: self.boundary,
            is_layered: self.is_layered,
            cap: self.cap,
            mean_gap,
            approach: level,
            mean_height: self.levels[0].moments[0],
            pressures,
            error,
            steps,
            convolutions,
        })
    }

    /// How `contact`, one of this solver, changes with the load: a linear solution on its points in contact below the cap. `None`
    /// where there are no such points, and in full contact of a map that repeats, which moves without a change of its gap. Shows to
    /// `progress` that it goes on.
    pub fn tangent(&self, contact: &Contact, progress: &dyn Progress) -> Option<Tangent> {
        let Level { points, convolution, stencil, .. } = &self.levels[0];
        if self.boundary != Boundary::Finite && contact.pressures.iter().all(|&p| p > 0.0) {
            return None;
        }
        let grid = PatchGrid {
            points: *points,
            convolution,
            stencil: *stencil,
            wraps: self.boundary.wraps(),
            film: 0.0,
            progress,
        };
        let response = grid.respond(&Tangent::patch(contact), self.error, STEPS)?;
        Some(Tangent::new(contact, response))
    }

    /// The sources of the method; of the perfectly plastic limit with a cap.
    pub fn papers(has_cap: bool) -> Vec<Paper> {
        let mut papers = vec![literature::POLONSKY_KEER_1999, literature::YASTREBOV_2017];
        papers.extend(has_cap.then_some(literature::ALMQVIST_2007));
        papers
    }

    /// Bytes that a solver for a map of `points` needs beside the map.
    pub fn memory(points: [usize; 2], boundary: Boundary) -> u128 {
        let count = (points[0] * points[1]) as u128;
        // Bytes of a point in full contact: gaps, a response, waves in both precisions, which become the pressures, and what is kept of an
        // active point and while its pressure is projected. A finite map is transformed as four. A tangent takes less. Responses are
        // those of both precisions.
        let (arrays, response): (u128, u128) = match boundary {
            Boundary::Periodic => (80, 3),
            Boundary::Mirrored => (80, 12),
            Boundary::Finite => (92, 12),
        };
        // Heights and responses of the coarser grids make a third.
        count * (arrays + response + (8 + response).div_ceil(3)) + Points::memory(points)
    }
}

impl Level<'_> {
    /// The pressures of this grid, from `start`. `share` is the progress of a whole descent.
    fn descend(
        &self,
        start: impl Fn(usize, &mut [f64]) + Sync,
        target: Target,
        boundary: Boundary,
        share: f64,
        progress: &dyn Progress,
    ) -> Descent {
        let grid = Grid {
            points: self.points,
            heights: &self.heights,
            deviation: self.moments[1],
            convolution: &self.convolution,
            stencil: self.stencil,
            wraps: boundary.wraps(),
            progress,
        };
        // Errors fall about as a power of the steps.
        let (first, done) = (Cell::new(f64::NAN), Cell::new(0.0));
        let descent = grid.descend(start, target, &|error| {
            if first.get().is_nan() {
                first.set(error);
            }
            let now = ((first.get() / error).ln() / (first.get() / target.error).ln()).clamp(0.0, 1.0);
            if now > done.get() {
                progress.advance(share * (now - done.get()));
                done.set(now);
            }
        });
        progress.advance(share * (1.0 - done.get()));
        descent
    }
}
