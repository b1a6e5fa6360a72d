//! The pressures under which a fixed set of points moves as one: K p = level on the patch, no pressure elsewhere, mean 1.
//!
//! Of a contact it is the derivative of the pressures by the load at a fixed patch, and its level that of the approach. With
//! the potential of a current in place of the displacement it is the current density through the patch, with a film on it
//! K p + film p = level.
//!
//! Displacements follow the steps in single precision; the level, whose error is of second order in that of the pressures, is
//! found from these in double precision.

use rayon::prelude::*;

use super::active::{Points, members};
use super::convolution::Convolution;
use super::descent::{ROWS, Sums, total};
use super::preconditioner::Stencil;
use crate::memory::zeros;
use crate::numeric::sum::sum_of;
use crate::progress::Progress;

/// The steps whose gains of energy exceed what all further ones gain: on rough surfaces a hundred times.
const LOOK_BACK: usize = 2;

/// A grid with the response to loads on it.
pub struct PatchGrid<'a> {
    pub points: [usize; 2],
    pub convolution: &'a Convolution,
    pub stencil: Stencil,
    /// Whether a point on the border has its neighbours at the opposite one.
    pub wraps: bool,
    /// What each load adds to the field at its own point, over the load.
    pub film: f64,
    /// Whoever watches: it is shown that the solution goes on.
    pub progress: &'a dyn Progress,
}

/// A patch that moves as one.
#[derive(Debug, Clone)]
pub struct PatchResponse {
    /// Pressure at each point over the mean pressure of the grid.
    pub pressures: Vec<f64>,
    /// Displacement at each point over the mean pressure, m/Pa.
    pub displacements: Vec<f64>,
    /// p K p over the points, m/Pa: the displacement of the patch, from above, with an error of second order in that of the pressures.
    pub level: f64,
    /// What the last steps gained of it, relative: an estimate of its error from above.
    pub error: f64,
    pub steps: usize,
    /// Points of the patch.
    pub count: usize,
}

/// The state of conjugate gradients.
struct State<'a> {
    grid: &'a PatchGrid<'a>,
    patch: &'a Points,
    /// Points of the patch.
    count: f64,
    pressures: Vec<f64>,
    displacements: Vec<f64>,
    direction: Vec<f32>,
    response: Vec<f32>,
    /// Between transforms the preconditioned residual.
    waves: Vec<f64>,
    single_waves: Vec<f32>,
}

impl PatchGrid<'_> {
    /// Minimises p K p over the pressures on `patch` with a mean of 1 over the grid, from uniform ones, until the last steps gained
    /// less than the part `error`, or after `steps`. `None` for a patch without points.
    pub fn respond(&self, patch: &Points, error: f64, steps: usize) -> Option<PatchResponse> {
        // On a thread of the pool, as a load is solved.
        rayon::join(|| self.responded(patch, error, steps), || ()).0
    }

    fn responded(&self, patch: &Points, error: f64, steps: usize) -> Option<PatchResponse> {
        let all = self.points[0] * self.points[1];
        let count = (0..self.points[0]).map(|i| members(patch.row(i)).count()).sum::<usize>();
        if count == 0 {
            return None;
        }
        let mut state = State {
            grid: self,
            patch,
            count: count as f64,
            pressures: zeros(all),
            displacements: zeros(all),
            direction: zeros(all),
            response: zeros(all),
            waves: self.convolution.waves(),
            single_waves: self.convolution.single_waves(),
        };
        state.change_pressures(|_| all as f64 / count as f64);
        let mut level = state.find_displacements() / all as f64;
        let (mut gains, mut product) = (Vec::new(), 0.0);
        let gained = |gains: &[f64]| gains.iter().rev().take(LOOK_BACK).sum::<f64>();
        while gains.len() < LOOK_BACK || (gains.len() < steps && gained(&gains) > error * level) {
            product = state.turn(product);
            // Of the solution nothing but rounding is left.
            let gain = if product > 0.0 { state.advance(product) / all as f64 } else { 0.0 };
            level -= gain;
            gains.push(gain);
        }
        // Directions in single precision do not sum to zero.
        let mean = sum_of(all, |k| state.pressures[k]) / all as f64;
        state.change_pressures(|pressure| pressure / mean);
        let level = state.find_displacements() / all as f64;
        Some(PatchResponse {
            pressures: state.pressures,
            displacements: state.displacements,
            level,
            error: gained(&gains) / level,
            steps: gains.len(),
            count,
        })
    }
}

impl State<'_> {
    fn width(&self) -> usize {
        self.grid.points[1]
    }

    /// Replaces each pressure on the patch.
    fn change_pressures(&mut self, to: impl Fn(f64) -> f64 + Sync) {
        let ny = self.width();
        self.pressures.par_chunks_mut(ny).zip(self.patch.rows()).for_each(|(row, words)| {
            members(words).for_each(|j| row[j] = to(row[j]));
        });
    }

    /// The displacements under the pressures; the sum of the products of both.
    fn find_displacements(&mut self) -> f64 {
        let ny = self.width();
        let (pressures, patch, film) = (&self.pressures, self.patch, self.grid.film);
        let rows = self.grid.convolution.apply(
            self.grid.progress,
            |i, row| row.copy_from_slice(&pressures[i * ny..][..ny]),
            &mut self.displacements,
            &mut self.waves,
            |i, row| {
                let mut product = 0.0;
                for j in members(patch.row(i)) {
                    let pressure = pressures[i * ny + j];
                    row[j] += film * pressure;
                    product += pressure * row[j];
                }
                Sums([product])
            },
        );
        total(&rows)[0]
    }

    /// The next direction; the residual times the preconditioned one, which was `last` before.
    fn turn(&mut self, last: f64) -> f64 {
        let ny = self.width();
        let (grid, patch, count, displacements) = (self.grid, self.patch, self.count, &self.displacements);
        let rows = displacements.par_chunks(ny).zip(patch.rows()).with_min_len(ROWS);
        let sums: Vec<Sums<1>> =
            rows.map(|(row, words)| Sums([members(words).map(|j| row[j]).sum()])).collect();
        let mean = total(&sums)[0] / count;
        let z = &mut self.waves[..displacements.len()];
        let rows: Vec<Sums<2>> = z
            .par_chunks_mut(ny)
            .enumerate()
            .with_min_len(ROWS)
            .map_init(
                || Stencil::rows(ny),
                |rows, (i, z)| {
                    let mut sums = [0.0; 2];
                    let residual = |i: usize, j: usize| displacements[i * ny + j] - mean;
                    let residuals = |i: usize| members(patch.row(i)).map(move |j| (j, residual(i, j)));
                    grid.stencil.apply_row(rows, (grid.points, grid.wraps), i, residuals, |j, value| {
                        z[j] = value;
                        sums[0] += value;
                        sums[1] += value * residual(i, j);
                    });
                    Sums(sums)
                },
            )
            .collect();
        // The residual has no mean, so that the mean of z does not count in their product.
        let [z_sum, product] = total(&rows);
        let z_mean = z_sum / count;
        let beta = if last > 0.0 { product / last } else { 0.0 };
        let z = &*z;
        let rows = self.direction.par_chunks_mut(ny).zip(z.par_chunks(ny)).zip(patch.rows());
        rows.with_min_len(ROWS).for_each(|((direction, z), words)| {
            members(words)
                .for_each(|j| direction[j] = (z[j] - z_mean + beta * f64::from(direction[j])) as f32);
        });
        product
    }

    /// Goes to the minimum along the direction, the slope there being minus `product`; what p K p loses.
    fn advance(&mut self, product: f64) -> f64 {
        let ny = self.width();
        let (direction, patch, film) = (&self.direction, self.patch, self.grid.film);
        let rows = self.grid.convolution.apply_in_single(
            self.grid.progress,
            |i, row| members(patch.row(i)).for_each(|j| row[j] = direction[i * ny + j]),
            &mut self.response,
            &mut self.single_waves,
            |i, found, response| {
                response.copy_from_slice(found);
                let mut product = 0.0;
                for j in members(patch.row(i)) {
                    let direction = f64::from(direction[i * ny + j]);
                    response[j] += (film * direction) as f32;
                    product += direction * f64::from(response[j]);
                }
                Sums([product])
            },
        );
        let step = product / total(&rows)[0];
        let response = &self.response;
        let rows = self.pressures.par_chunks_mut(ny).zip(self.displacements.par_chunks_mut(ny)).enumerate();
        rows.with_min_len(ROWS).for_each(|(i, (pressures, displacements))| {
            let at = i * ny;
            displacements.iter_mut().zip(&response[at..]).for_each(|(u, &r)| *u -= step * f64::from(r));
            members(patch.row(i)).for_each(|j| pressures[j] -= step * f64::from(direction[at + j]));
        });
        step * product
    }
}
