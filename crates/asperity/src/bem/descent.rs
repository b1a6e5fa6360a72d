//! Pressures under a load on one grid: conjugate gradients on the points in contact, projected to the admissible
//! pressures.
//!
//! The pressures p minimise p K p/2 - p h subject to 0 <= p <= H and a given sum. Differences from Polonsky and Keer
//! (1999): the direction is kept when points enter or leave the contact, and made conjugate to the last one; a stencil of
//! 3 x 3 points approximates the inverse of K; the load is kept by projection, which also serves a cap; and gaps follow
//! the changes of the pressures in single precision, from pressures and to those found in double precision.
//!
//! A step needs one convolution, that of its direction, from which the gap follows. Pressures clamped after a step would need
//! another; so the last step length is tried along the conjugate direction first, and where pressures leave their bounds there,
//! the direction leads to the projection of that end instead. Between both all pressures are admissible, and the step ends there
//! at the latest. The first step of the coarsest grid, and of all below a cap, is not bounded but corrected; so is one after a
//! direction that led hardly down.

use std::{array, mem};

use rayon::prelude::*;

use super::active::{Points, members};
use super::convolution::Convolution;
use super::preconditioner::Stencil;
use super::projection::project;
use crate::memory::zeros;
use crate::progress::Progress;

/// Rows of one task.
pub const ROWS: usize = 8;

/// The part of the last error of gaps in double precision that those in single precision can follow: their rounding is some
/// 1e-7 of the displacements that changed.
const SINGLE: f64 = 1e-4;

/// Steps after which they are found in double precision whatever their error: where the displacements are far larger than the
/// heights, rounding may hold it up.
const FOLLOWED: usize = 16;

/// Targets that are near rounding, and steps in which a tenth of such a target is tried for: residues of single precision in the
/// pressures exceed those of the gaps.
const NEAR_ROUNDING: f64 = 1e-11;
const MORE: usize = 4;

/// The part of the way to projected pressures from which on a step goes all of it: points that are to leave the contact would
/// keep a small pressure else, and hold up the next steps.
const NEARLY: f64 = 0.9;

/// The part of its reach that a direction to projected pressures leads down at least, or the next one is not bounded: the
/// projection may turn away from the residual where many points enter or leave.
const WORTH: f64 = 0.1;

/// The part of the mean pressure of active points up to which a pressure is small.
const SMALL: f64 = 0.1;

/// The reach of the first direction from a coarser grid, over the pressure of a point per displacement. Not below a cap, where
/// all points are active first.
const FIRST_REACH: f64 = 0.25;

/// A grid of heights with the response to pressures on it.
pub struct Grid<'a> {
    pub points: [usize; 2],
    /// m.
    pub heights: &'a [f64],
    /// Their standard deviation, m.
    pub deviation: f64,
    pub convolution: &'a Convolution,
    pub stencil: Stencil,
    /// Whether a point on the border has its neighbours at the opposite one.
    pub wraps: bool,
    /// Whoever watches.
    pub progress: &'a dyn Progress,
}

/// What a descent is to reach.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Mean pressure, Pa.
    pub pressure: f64,
    /// The highest pressure of a point, Pa; infinite where nothing yields.
    pub cap: f64,
    /// Dual gap relative to the mean pressure times the standard deviation of the heights.
    pub error: f64,
    /// Steps after which it is given up.
    pub steps: usize,
    /// Whether the start is that of a coarser grid: the points that carry pressure are nearly those of the contact then.
    pub is_near: bool,
}

/// Where a descent ended.
#[derive(Debug, Clone)]
pub struct Descent {
    /// Pa.
    pub pressures: Vec<f64>,
    /// Displacement less height, m.
    pub gaps: Vec<f64>,
    /// The gap at points in contact, m.
    pub level: f64,
    pub error: f64,
    pub steps: usize,
    pub convolutions: usize,
}

/// Sums over the points of one row, added in the order of the rows.
#[derive(Clone, Copy)]
pub struct Sums<const N: usize>(pub [f64; N]);

/// Their sum, row by row.
pub fn total<const N: usize>(rows: &[Sums<N>]) -> [f64; N] {
    rows.iter().fold([0.0; N], |mut total, row| {
        total.iter_mut().zip(row.0).for_each(|(total, value)| *total += value);
        total
    })
}

/// The state of a descent.
struct State<'a> {
    grid: &'a Grid<'a>,
    target: Target,
    pressures: Vec<f64>,
    gaps: Vec<f64>,
    direction: Vec<f32>,
    /// Displacements under the direction.
    response: Vec<f32>,
    /// Between transforms the preconditioned residual, then the pressures of active points at the reach of the direction: without
    /// one those before the step.
    waves: Vec<f64>,
    single_waves: Vec<f32>,
    /// Points whose pressure may change.
    active: Points,
    /// The gap at points in contact.
    level: f64,
    /// Step along the direction that the gaps have not followed yet.
    step: f64,
    /// direction . response of the last step; 0 before the first.
    curvature: f64,
    /// The step length that pressures are bounded for: that to the minimum along the last direction; 0 where it is of no use.
    reach: f64,
    convolutions: usize,
}

/// What a look at all points finds.
struct Contact {
    error: f64,
    /// Active points.
    count: f64,
    /// Mean gap of active points.
    mean_gap: f64,
    /// Load of points that stay at the cap.
    fixed_load: f64,
}

impl Grid<'_> {
    /// Minimises from the pressures `start`, which need not have the load of `target`. `watch` sees the error of each step.
    /// Gives up after the steps of `target`: the error then exceeds that asked for.
    pub fn descend(&self, start: Vec<f64>, target: Target, watch: &dyn Fn(f64)) -> Descent {
        let count = self.points[0] * self.points[1];
        // All others are without pressure, of which rounding of the load would give them some. Below a cap these may not carry it.
        let has_cap = target.cap.is_finite();
        let active = Points::selected(self.points, |k| has_cap || start[k] > 0.0);
        let mut state = State {
            grid: self,
            target,
            pressures: start,
            gaps: self.heights.par_iter().map(|height| -height).collect(),
            direction: zeros(count),
            response: zeros(count),
            waves: self.convolution.waves(),
            single_waves: self.convolution.single_waves(),
            active,
            level: 0.0,
            step: 0.0,
            curvature: 0.0,
            reach: if target.is_near && !has_cap { FIRST_REACH * self.stencil.centre } else { 0.0 },
            convolutions: 0,
        };
        state.keep_load(0.0);
        // From none.
        state.follow();
        // The last error of gaps in double precision, or the first one, and the step at which they were found.
        let (mut exact, mut exact_at) = (f64::NAN, 0);
        let (mut steps, mut is_exact, mut followed) = (0, false, f64::INFINITY);
        let mut more = if target.error < NEAR_ROUNDING { MORE } else { 0 };
        loop {
            let contact = state.find_contact();
            let error = contact.error;
            watch(error);
            if exact.is_nan() {
                exact = error;
            }
            let is_within = error <= target.error;
            let is_reached = is_within && (more == 0 || error <= 0.1 * target.error);
            // A single point has its pressure.
            let is_due = error < SINGLE * exact || steps >= exact_at + FOLLOWED || contact.count <= 1.0;
            if !is_exact && (is_due || is_reached && target.error < SINGLE) {
                state.settle(&contact);
                state.find_gaps();
                (is_exact, followed) = (true, error);
                continue;
            }
            if is_reached || steps >= target.steps || !error.is_finite() {
                let State { pressures, gaps, level, convolutions, .. } = state;
                return Descent { pressures, gaps, level, error, steps, convolutions };
            }
            if is_exact {
                (exact, exact_at) = (error, steps);
                if error > 2.0 * followed {
                    // What is left is rounding, which the last direction knows nothing of: of few points it would leave none.
                    state.curvature = 0.0;
                }
            }
            let is_bounded = state.turn(&contact);
            if is_bounded {
                state.bound(contact.fixed_load);
            }
            if state.advance(&contact, is_bounded) {
                state.keep_load(contact.fixed_load);
                state.follow();
            }
            is_exact = false;
            steps += 1;
            more = more.saturating_sub(usize::from(is_within));
        }
    }
}

impl State<'_> {
    fn width(&self) -> usize {
        self.grid.points[1]
    }

    fn load(&self) -> f64 {
        self.target.pressure * (self.grid.points[0] * self.grid.points[1]) as f64
    }

    /// Projects the active pressures so that they carry the load, less what fixed points do.
    fn keep_load(&mut self, fixed: f64) {
        let (width, load) = (self.width(), self.load());
        project(&mut self.pressures, width, &self.active, load - fixed, self.target.cap);
    }

    /// Takes the small pressures of points that would be open without them, of which a step that ended before its reach has left a
    /// part, and restores the load, which rounding has changed too: points without pressure stay so, or they would count as contacts.
    fn settle(&mut self, contact: &Contact) {
        let &Contact { count, fixed_load: fixed, .. } = contact;
        let (ny, level, centre) = (self.width(), self.level, self.grid.stencil.centre);
        let (pressures, gaps) = (&self.pressures, &self.gaps);
        let small = SMALL * (self.load() - fixed) / count;
        let least = |gap: f64| (centre * (gap - level)).clamp(0.0, small.max(0.0));
        let carrying = self.active.that(ny, |k| pressures[k] > least(gaps[k]));
        let (rows, active) = (self.pressures.par_chunks_mut(ny), self.active.rows());
        rows.zip(active).zip(carrying.rows()).with_min_len(ROWS).for_each(
            |((pressures, active), carrying)| {
                for (k, (active, carrying)) in active.iter().zip(carrying).enumerate() {
                    members(&[active & !carrying]).for_each(|bit| pressures[64 * k + bit] = 0.0);
                }
            },
        );
        let active = mem::replace(&mut self.active, carrying);
        self.keep_load(fixed);
        self.active = active;
    }

    /// The gaps under the pressures.
    fn find_gaps(&mut self) {
        let ny = self.width();
        let (pressures, heights, active, cap) =
            (&self.pressures, self.grid.heights, &self.active, self.target.cap);
        let sums = self.grid.convolution.apply(
            self.grid.progress,
            |i, row| row.copy_from_slice(&pressures[i * ny..][..ny]),
            &mut self.gaps,
            &mut self.waves,
            |i, gaps| {
                gaps.iter_mut().zip(&heights[i * ny..][..ny]).for_each(|(gap, height)| *gap -= height);
                free(gaps, &pressures[i * ny..][..ny], active.row(i), cap)
            },
        );
        self.set_level(&sums);
    }

    /// Changes the gaps with the pressures of active points, which were those in `waves` before.
    fn follow(&mut self) {
        let ny = self.width();
        let (pressures, before, active, cap) = (&self.pressures, &self.waves, &self.active, self.target.cap);
        let sums = self.grid.convolution.apply_in_single(
            self.grid.progress,
            |i, row| {
                let change = |k: usize| (pressures[k] - before[k]) as f32;
                members(active.row(i)).for_each(|j| row[j] = change(i * ny + j));
            },
            &mut self.gaps,
            &mut self.single_waves,
            |i, changes, gaps| {
                gaps.iter_mut().zip(changes).for_each(|(gap, &change)| *gap += f64::from(change));
                free(gaps, &pressures[i * ny..][..ny], active.row(i), cap)
            },
        );
        self.set_level(&sums);
    }

    /// The level of the flat: the mean gap of points that carry pressure below the cap, `sums` being their number and their gaps. Where
    /// there are none, it lies halfway between the highest gap at the cap and the lowest without pressure: no point leaves its
    /// bounds, or one on each side does and they share the load anew.
    fn set_level(&mut self, sums: &[Sums<2>]) {
        self.convolutions += 1;
        self.step = 0.0;
        let [count, gaps] = total(sums);
        self.level = if count > 0.0 {
            gaps / count
        } else {
            let points = || self.gaps.iter().zip(&self.pressures);
            let capped = points()
                .filter(|&(_, &p)| p > 0.0)
                .fold(f64::NEG_INFINITY, |highest, (&gap, _)| highest.max(gap));
            let open =
                points().filter(|&(_, &p)| p <= 0.0).fold(f64::INFINITY, |lowest, (&gap, _)| lowest.min(gap));
            0.5 * (capped + open)
        };
    }

    /// Moves the gaps along the last step, finds the points that are active and forgets the direction of those that are
    /// not.
    fn find_contact(&mut self) -> Contact {
        let (ny, cap, level, step) = (self.width(), self.target.cap, self.level, self.step);
        let has_cap = cap.is_finite();
        let rows: Vec<(Sums<6>, f64)> = self
            .gaps
            .par_chunks_mut(ny)
            .zip(self.response.par_chunks(ny))
            .zip(self.pressures.par_chunks(ny))
            .zip(self.direction.par_chunks_mut(ny))
            .zip(self.active.rows_mut())
            .with_min_len(ROWS)
            .map(|((((gaps, response), pressures), direction), words)| {
                if step != 0.0 {
                    gaps.iter_mut().zip(response).for_each(|(gap, &r)| *gap -= step * f64::from(r));
                }
                let (mut sums, mut lowest) = ([0.0; 6], f64::INFINITY);
                let points = gaps.chunks(64).zip(pressures.chunks(64));
                for ((k, (gaps, pressures)), word) in points.enumerate().zip(words) {
                    let low = least(gaps);
                    lowest = lowest.min(low);
                    let mut now = 0;
                    // Points that carry pressure are active or, where there is a cap, may have stayed there.
                    let mut touching = *word;
                    if has_cap {
                        touching |= bits(pressures, |p| p > 0.0);
                    }
                    if low < level {
                        touching |= bits(gaps, |gap| gap < level);
                    }
                    for bit in members(&[touching]) {
                        let (gap, p) = (gaps[bit], pressures[bit]);
                        let above = gap - level;
                        if p <= 0.0 && above >= 0.0 {
                            continue;
                        }
                        // Load, load times gap; the dual gap under a cap.
                        sums[0] += p;
                        sums[1] += p * above;
                        sums[2] += if above > 0.0 { p * above } else { (cap - p) * -above };
                        if p >= cap && above <= 0.0 {
                            sums[3] += p;
                        } else {
                            now |= 1 << bit;
                            sums[4] += 1.0;
                            sums[5] += gap;
                        }
                    }
                    for j in members(&[*word & !now]) {
                        direction[64 * k + j] = 0.0;
                    }
                    *word = now;
                }
                (Sums(sums), lowest)
            })
            .collect();
        let lowest = rows.iter().fold(f64::INFINITY, |lowest, row| lowest.min(row.1));
        let sums: Vec<Sums<6>> = rows.iter().map(|row| row.0).collect();
        let [load, energy, bounded, fixed_load, count, gaps] = total(&sums);
        // Both bound the distance from the minimum; without a cap the second is infinite, or not a number.
        let dual_gap = (energy - (lowest - level) * load).min(bounded);
        Contact { error: dual_gap / (load * self.grid.deviation), count, mean_gap: gaps / count, fixed_load }
    }

    /// The next direction: the preconditioned residual, made conjugate to the last direction. Whether a pressure leaves its bounds
    /// within its reach.
    fn turn(&mut self, contact: &Contact) -> bool {
        let (ny, cap, reach) = (self.width(), self.target.cap, self.reach);
        let nx = self.grid.points[0];
        let &Contact { count, mean_gap, .. } = contact;
        let (grid, gaps, active) = (self.grid, &self.gaps, &self.active);
        let (response, direction) = (&self.response, &self.direction);
        let residual = |k: usize| gaps[k] - mean_gap;
        let z = &mut self.waves[..nx * ny];
        let rows: Vec<Sums<4>> = z
            .par_chunks_mut(ny)
            .zip(direction.par_chunks(ny))
            .zip(response.par_chunks(ny))
            .enumerate()
            .with_min_len(ROWS)
            .map_init(
                || Stencil::rows(ny),
                |rows, (i, ((z, direction), response))| {
                    let mut sums = [0.0; 4];
                    grid.stencil.apply_row(
                        rows,
                        (grid.points, grid.wraps),
                        active,
                        i,
                        residual,
                        |j, value| {
                            z[j] = value;
                            sums[0] += value;
                            sums[1] += value * f64::from(response[j]);
                            sums[2] += f64::from(response[j]);
                            sums[3] += f64::from(direction[j]);
                        },
                    );
                    Sums(sums)
                },
            )
            .collect();
        let [z_sum, z_response, response_sum, direction_sum] = total(&rows);
        let (z_mean, direction_mean) = (z_sum / count, direction_sum / count);
        let beta = if self.curvature > 0.0 {
            ((z_mean * response_sum - z_response) / self.curvature).max(0.0)
        } else {
            0.0
        };
        let is_out: Vec<bool> = self
            .direction
            .par_chunks_mut(ny)
            .zip(z.par_chunks_mut(ny))
            .zip(self.pressures.par_chunks(ny))
            .zip(active.rows())
            .with_min_len(ROWS)
            .map(|(((direction, z), pressures), words)| {
                members(words).fold(false, |is_out, j| {
                    let conjugate = beta * (f64::from(direction[j]) - direction_mean);
                    direction[j] = (z[j] - z_mean + conjugate) as f32;
                    z[j] = pressures[j] - reach * f64::from(direction[j]);
                    is_out | (z[j] < 0.0) | (z[j] > cap)
                })
            })
            .collect();
        is_out.into_iter().any(|is_out| is_out)
    }

    /// Turns the direction to the projection of the pressures at its reach. `fixed` is the load of fixed points.
    fn bound(&mut self, fixed: f64) {
        let (ny, cap, reach) = (self.width(), self.target.cap, self.reach);
        let load = self.load() - fixed;
        let ends = &mut self.waves[..self.pressures.len()];
        project(ends, ny, &self.active, load, cap);
        self.direction
            .par_chunks_mut(ny)
            .zip(ends.par_chunks(ny))
            .zip(self.pressures.par_chunks(ny))
            .zip(self.active.rows())
            .with_min_len(ROWS)
            .for_each(|(((direction, ends), pressures), words)| {
                members(words).for_each(|j| direction[j] = ((pressures[j] - ends[j]) / reach) as f32);
            });
    }

    /// Goes to the minimum along the direction, or to its reach if pressures leave their bounds beyond. Whether they left them
    /// without a reach.
    fn advance(&mut self, contact: &Contact, is_bounded: bool) -> bool {
        let ny = self.width();
        let &Contact { count, mean_gap, .. } = contact;
        let (gaps, direction, active) = (&self.gaps, &self.direction, &self.active);
        let rows = self.grid.convolution.apply_in_single(
            self.grid.progress,
            |i, row| members(active.row(i)).for_each(|j| row[j] = direction[i * ny + j]),
            &mut self.response,
            &mut self.single_waves,
            |i, found, response| {
                response.copy_from_slice(found);
                let (gaps, direction) = (&gaps[i * ny..][..ny], &direction[i * ny..][..ny]);
                let mut sums = [0.0; 3];
                for j in members(active.row(i)) {
                    let (response, direction) = (f64::from(response[j]), f64::from(direction[j]));
                    sums[0] += (gaps[j] - mean_gap) * direction;
                    sums[1] += response * direction;
                    sums[2] += response;
                }
                Sums(sums)
            },
        );
        self.convolutions += 1;
        let [slope, curvature, response] = total(&rows);
        self.curvature = curvature;
        let (step, reach) = (slope / curvature, self.reach);
        let (leads_down, is_worth) = (step > 0.0, step > WORTH * reach);
        // That of pressures at their bounds may be any.
        self.reach = if is_worth { step.min(self.grid.stencil.centre) } else { 0.0 };
        if reach > 0.0 && !leads_down {
            (self.curvature, self.step) = (0.0, 0.0);
            return false;
        }
        let is_beyond = is_bounded && step > NEARLY * reach || self.change_pressures(step);
        let stops = is_beyond && reach > 0.0;
        if stops {
            let (pressures, ends) = (self.pressures.par_chunks_mut(ny), self.waves.par_chunks(ny));
            pressures
                .zip(ends)
                .zip(self.active.rows())
                .with_min_len(ROWS)
                .for_each(|((pressures, ends), words)| members(words).for_each(|j| pressures[j] = ends[j]));
        }
        self.step = if stops { reach } else { step };
        self.level = mean_gap - self.step * response / count;
        is_beyond && !stops
    }

    /// Changes the pressures by a step along the direction; whether one leaves its bounds.
    fn change_pressures(&mut self, step: f64) -> bool {
        let (ny, cap) = (self.width(), self.target.cap);
        let is_out: Vec<bool> = self
            .pressures
            .par_chunks_mut(ny)
            .zip(self.direction.par_chunks(ny))
            .zip(self.active.rows())
            .with_min_len(ROWS)
            .map(|((pressures, direction), words)| {
                members(words).fold(false, |is_out, j| {
                    pressures[j] -= step * f64::from(direction[j]);
                    is_out | (pressures[j] < 0.0) | (pressures[j] > cap)
                })
            })
            .collect();
        is_out.into_iter().any(|is_out| is_out)
    }
}

/// Number and gaps of the points of a row among `active` that carry pressure below the cap.
fn free(gaps: &[f64], pressures: &[f64], active: &[u64], cap: f64) -> Sums<2> {
    Sums(members(active).fold([0.0; 2], |[count, sum], j| {
        if pressures[j] > 0.0 && pressures[j] < cap { [count + 1.0, sum + gaps[j]] } else { [count, sum] }
    }))
}

/// A bit for each of up to 64 values.
fn bits(values: &[f64], is_set: impl Fn(f64) -> bool) -> u64 {
    values.iter().enumerate().fold(0, |bits, (k, &value)| bits | u64::from(is_set(value)) << k)
}

/// The least of some gaps, infinite for none: of eight at once, which a fold of one after the other is not.
fn least(gaps: &[f64]) -> f64 {
    let least = |a: f64, b: f64| if b < a { b } else { a };
    let (eights, rest) = gaps.as_chunks::<8>();
    let lanes =
        eights.iter().fold([f64::INFINITY; 8], |lanes, gaps| array::from_fn(|k| least(lanes[k], gaps[k])));
    lanes.into_iter().chain(rest.iter().copied()).fold(f64::INFINITY, least)
}
