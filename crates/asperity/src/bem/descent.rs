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
use super::preconditioner::project;
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

/// A point whose pressure may change: those of a row stand side by side, since they are few among all.
struct Active {
    /// Its place in the row.
    column: u32,
    direction: f32,
    /// Displacement under the direction.
    response: f32,
    pressure: f64,
    gap: f64,
}

impl Active {
    fn column(&self) -> usize {
        self.column as usize
    }
}

/// The state of a descent.
struct State<'a> {
    grid: &'a Grid<'a>,
    target: Target,
    /// The active points of each row, in order. All others are at their bounds.
    active: Vec<Vec<Active>>,
    /// The preconditioned residual of each, then its pressure at the reach of the direction: without one that before the step.
    ends: Vec<Vec<f64>>,
    /// Points that stay at the cap.
    fixed: Points,
    gaps: Vec<f64>,
    /// Displacements under the direction.
    response: Vec<f32>,
    /// Those of double precision, once they are needed: on coarser grids they seldom are.
    waves: Vec<f64>,
    single_waves: Vec<f32>,
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
    /// Minimises from the pressures that `start` writes to row i, which need not have the load of `target`. `watch` sees the error
    /// of each step. Gives up after the steps of `target`: the error then exceeds that asked for.
    pub fn descend(
        &self,
        start: impl Fn(usize, &mut [f64]) + Sync,
        target: Target,
        watch: &dyn Fn(f64),
    ) -> Descent {
        let [nx, ny] = self.points;
        // All others are without pressure, of which rounding of the load would give them some. Below a cap these may not carry it.
        let has_cap = target.cap.is_finite();
        let rows = (0..nx).into_par_iter().with_min_len(ROWS).map_init(
            || vec![0.0; ny],
            |row, i| {
                start(i, row);
                let active = row.iter().enumerate().filter(|&(_, &pressure)| has_cap || pressure > 0.0);
                let point = |(j, &pressure): (usize, &f64)| Active {
                    column: j as u32,
                    direction: 0.0,
                    response: 0.0,
                    pressure,
                    gap: 0.0,
                };
                let active: Vec<Active> = active.map(point).collect();
                let none = vec![0.0; active.len()];
                (active, none)
            },
        );
        let (active, ends) = rows.unzip();
        let mut state = State {
            grid: self,
            target,
            active,
            ends,
            fixed: Points::none(self.points),
            gaps: zeros(nx * ny),
            response: zeros(nx * ny),
            waves: Vec::new(),
            single_waves: self.convolution.single_waves(),
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
                return state.end(error, steps);
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

    /// The pressures of row `i`, given as zeros.
    fn fill(&self, i: usize, row: &mut [f64]) {
        members(self.fixed.row(i)).for_each(|j| row[j] = self.target.cap);
        self.active[i].iter().for_each(|point| row[point.column()] = point.pressure);
    }

    fn end(mut self, error: f64, steps: usize) -> Descent {
        let ny = self.width();
        let mut pressures = mem::take(&mut self.waves);
        pressures.resize(self.gaps.len(), 0.0);
        pressures.par_chunks_mut(ny).enumerate().with_min_len(ROWS).for_each(|(i, row)| {
            row.fill(0.0);
            self.fill(i, row);
        });
        let Self { gaps, level, convolutions, .. } = self;
        Descent { pressures, gaps, level, error, steps, convolutions }
    }

    /// Projects the active pressures so that they carry the load, less what fixed points do.
    fn keep_load(&mut self, fixed: f64) {
        let rows = self.active.par_iter().with_min_len(ROWS);
        let mut kept: Vec<Vec<f64>> =
            rows.map(|row| row.iter().map(|point| point.pressure).collect()).collect();
        project(&mut kept, self.load() - fixed, self.target.cap);
        self.active.par_iter_mut().zip(kept).with_min_len(ROWS).for_each(|(row, kept)| {
            row.iter_mut().zip(kept).for_each(|(point, kept)| point.pressure = kept);
        });
    }

    /// Takes the small pressures of points that would be open without them, of which a step that ended before its reach has left a
    /// part, and restores the load, which rounding has changed too: points without pressure stay so, or they would count as contacts.
    fn settle(&mut self, contact: &Contact) {
        let &Contact { count, fixed_load: fixed, .. } = contact;
        let (level, centre) = (self.level, self.grid.stencil.centre);
        let small = (SMALL * (self.load() - fixed) / count).max(0.0);
        self.active.par_iter_mut().with_min_len(ROWS).for_each(|row| {
            row.retain(|point| point.pressure > (centre * (point.gap - level)).clamp(0.0, small));
        });
        self.keep_load(fixed);
    }

    /// The gaps under the pressures.
    fn find_gaps(&mut self) {
        let ny = self.width();
        let (mut gaps, mut waves) = (mem::take(&mut self.gaps), mem::take(&mut self.waves));
        if waves.is_empty() {
            waves = self.grid.convolution.waves();
        }
        let sums = self.grid.convolution.apply(
            self.grid.progress,
            |i, row| self.fill(i, row),
            &mut gaps,
            &mut waves,
            |i, gaps| {
                gaps.iter_mut().zip(&self.grid.heights[i * ny..]).for_each(|(gap, height)| *gap -= height);
                self.free(i, gaps)
            },
        );
        (self.gaps, self.waves) = (gaps, waves);
        self.set_level(&sums);
    }

    /// Changes the gaps with the pressures of active points, which were their ends before: at first none, with gaps of minus the
    /// heights.
    fn follow(&mut self) {
        let ny = self.width();
        let mut gaps = mem::take(&mut self.gaps);
        let mut waves = mem::take(&mut self.single_waves);
        let sums = self.grid.convolution.apply_in_single(
            self.grid.progress,
            |i, row| {
                let points = self.active[i].iter().zip(&self.ends[i]);
                points.for_each(|(point, end)| row[point.column()] = (point.pressure - end) as f32);
            },
            &mut gaps,
            &mut waves,
            |i, changes, gaps| {
                if self.convolutions == 0 {
                    gaps.iter_mut()
                        .zip(&self.grid.heights[i * ny..])
                        .for_each(|(gap, height)| *gap = -height);
                }
                gaps.iter_mut().zip(changes).for_each(|(gap, &change)| *gap += f64::from(change));
                self.free(i, gaps)
            },
        );
        (self.gaps, self.single_waves) = (gaps, waves);
        self.set_level(&sums);
    }

    /// Number and gaps of the points of row `i` that carry pressure below the cap.
    fn free(&self, i: usize, gaps: &[f64]) -> Sums<2> {
        let is_free = |point: &&Active| point.pressure > 0.0 && point.pressure < self.target.cap;
        let points = self.active[i].iter().filter(is_free);
        Sums(points.fold([0.0; 2], |[count, sum], point| [count + 1.0, sum + gaps[point.column()]]))
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
            let (mut capped, mut open) = (f64::NEG_INFINITY, f64::INFINITY);
            let mut pressures = vec![0.0; self.width()];
            for (i, gaps) in self.gaps.chunks(self.width()).enumerate() {
                pressures.fill(0.0);
                self.fill(i, &mut pressures);
                for (&gap, &pressure) in gaps.iter().zip(&pressures) {
                    if pressure > 0.0 {
                        capped = capped.max(gap);
                    } else {
                        open = open.min(gap);
                    }
                }
            }
            0.5 * (capped + open)
        };
    }

    /// Moves the gaps along the last step and finds the points that are active.
    fn find_contact(&mut self) -> Contact {
        let (ny, cap, level, step) = (self.width(), self.target.cap, self.level, self.step);
        let rows: Vec<(Sums<6>, f64)> = self
            .gaps
            .par_chunks_mut(ny)
            .zip(self.response.par_chunks(ny))
            .zip(&mut self.active)
            .zip(self.fixed.rows_mut())
            .with_min_len(ROWS)
            .map_init(Vec::new, |before, (((gaps, response), active), fixed)| {
                if step != 0.0 {
                    gaps.iter_mut().zip(response).for_each(|(gap, &r)| *gap -= step * f64::from(r));
                }
                mem::swap(before, active);
                active.clear();
                let mut before = before.iter().peekable();
                let (mut sums, mut lowest) = ([0.0; 6], f64::INFINITY);
                for ((k, gaps), fixed) in gaps.chunks(64).enumerate().zip(fixed) {
                    let low = least(gaps);
                    lowest = lowest.min(low);
                    // Points that stay at the cap or touch, and those that were active.
                    let mut touching = *fixed;
                    if low < level {
                        touching |= bits(gaps, |gap| gap < level);
                    }
                    let is_here = |point: &Active| point.column() / 64 == k;
                    before
                        .clone()
                        .take_while(|point| is_here(point))
                        .for_each(|point| touching |= 1 << (point.column() % 64));
                    for bit in members(&[touching]) {
                        let (gap, column) = (gaps[bit], (64 * k + bit) as u32);
                        let above = gap - level;
                        let (p, direction) = match before.next_if(|point| point.column == column) {
                            Some(point) => (point.pressure, point.direction),
                            None if *fixed >> bit & 1 == 1 => (cap, 0.0),
                            None => (0.0, 0.0),
                        };
                        *fixed &= !(1 << bit);
                        if p <= 0.0 && above >= 0.0 {
                            continue;
                        }
                        // Load, load times gap; the dual gap under a cap.
                        sums[0] += p;
                        sums[1] += p * above;
                        sums[2] += if above > 0.0 { p * above } else { (cap - p) * -above };
                        if p >= cap && above <= 0.0 {
                            sums[3] += p;
                            *fixed |= 1 << bit;
                        } else {
                            sums[4] += 1.0;
                            sums[5] += gap;
                            let response = response[64 * k + bit];
                            active.push(Active { column, direction, response, pressure: p, gap });
                        }
                    }
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
        let &Contact { count, mean_gap, .. } = contact;
        let (grid, active) = (self.grid, &self.active);
        let residuals = |i: usize| active[i].iter().map(move |point| (point.column(), point.gap - mean_gap));
        let rows = self.ends.par_iter_mut().enumerate().with_min_len(ROWS).map_init(
            || Stencil::rows(ny),
            |rows, (i, z)| {
                z.clear();
                grid.stencil
                    .apply_row(rows, (grid.points, grid.wraps), i, residuals, |_, value| z.push(value));
                Sums(z.iter().zip(&active[i]).fold([0.0; 4], |[a, b, c, d], (&z, point)| {
                    let (response, direction) = (f64::from(point.response), f64::from(point.direction));
                    [a + z, b + z * response, c + response, d + direction]
                }))
            },
        );
        let rows: Vec<Sums<4>> = rows.collect();
        let [z_sum, z_response, response_sum, direction_sum] = total(&rows);
        let (z_mean, direction_mean) = (z_sum / count, direction_sum / count);
        let beta = if self.curvature > 0.0 {
            ((z_mean * response_sum - z_response) / self.curvature).max(0.0)
        } else {
            0.0
        };
        self.any(|point, z| {
            let conjugate = beta * (f64::from(point.direction) - direction_mean);
            point.direction = (*z - z_mean + conjugate) as f32;
            *z = point.pressure - reach * f64::from(point.direction);
            (*z < 0.0) | (*z > cap)
        })
    }

    /// Whether `change` says so of any active point and its end.
    fn any(&mut self, change: impl Fn(&mut Active, &mut f64) -> bool + Sync) -> bool {
        let rows = self.active.par_iter_mut().zip(&mut self.ends).with_min_len(ROWS);
        let of_row = |(row, ends): (&mut Vec<Active>, &mut Vec<f64>)| {
            row.iter_mut().zip(ends).fold(false, |any, (point, end)| any | change(point, end))
        };
        rows.map(of_row).reduce(|| false, |a, b| a | b)
    }

    /// Turns the direction to the projection of the pressures at its reach. `fixed` is the load of fixed points.
    fn bound(&mut self, fixed: f64) {
        let (load, reach) = (self.load() - fixed, self.reach);
        project(&mut self.ends, load, self.target.cap);
        self.any(|point, end| {
            point.direction = ((point.pressure - *end) / reach) as f32;
            false
        });
    }

    /// Goes to the minimum along the direction, or to its reach if pressures leave their bounds beyond. Whether they left them
    /// without a reach.
    fn advance(&mut self, contact: &Contact, is_bounded: bool) -> bool {
        let &Contact { count, mean_gap, .. } = contact;
        let (active, cap) = (&self.active, self.target.cap);
        let rows = self.grid.convolution.apply_in_single(
            self.grid.progress,
            |i, row| active[i].iter().for_each(|point| row[point.column()] = point.direction),
            &mut self.response,
            &mut self.single_waves,
            |i, found, response| {
                response.copy_from_slice(found);
                Sums(active[i].iter().fold([0.0; 3], |[slope, curvature, sum], point| {
                    let response = f64::from(found[point.column()]);
                    let direction = f64::from(point.direction);
                    [
                        slope + (point.gap - mean_gap) * direction,
                        curvature + response * direction,
                        sum + response,
                    ]
                }))
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
        let is_beyond = is_bounded && step > NEARLY * reach
            || self.any(|point, _| {
                point.pressure -= step * f64::from(point.direction);
                (point.pressure < 0.0) | (point.pressure > cap)
            });
        let stops = is_beyond && reach > 0.0;
        if stops {
            self.any(|point, end| {
                point.pressure = *end;
                false
            });
        }
        self.step = if stops { reach } else { step };
        self.level = mean_gap - self.step * response / count;
        is_beyond && !stops
    }
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
