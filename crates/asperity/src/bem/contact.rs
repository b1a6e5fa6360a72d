//! A solved contact: pressures, gap and area at one load.

use std::f64::consts::{LN_2, PI};

use rayon::prelude::*;

use super::Boundary;
use crate::numeric::sum::sum_of;
use crate::topography::Blocks;

/// How much of a pixel a side of the border between contact and gap adds to the counted area on average (Yastrebov,
/// Anciaux and Molinari 2017, Tribology International 114, 161, Eq. 15): the mean smaller part of a pixel that a straight
/// border cuts, times pi/4 for the length of the border along the pixels. On self-affine surfaces the error is 0.099 to
/// 0.110 a side, so that the correction removes it up to about a fifth.
const BORDER: f64 = (PI - 1.0 + LN_2) / 24.0;

/// A pressure this close to the cap counts as at it.
pub(super) const AT_CAP: f64 = 1.0 - 1e-12;

/// Pressures and gap at one load.
#[derive(Debug, Clone)]
pub struct Contact {
    pub(super) points: [usize; 2],
    /// m.
    pub(super) pixel: [f64; 2],
    pub(super) boundary: Boundary,
    pub(super) is_layered: bool,
    pub(super) cap: f64,
    pub(super) pressures: Vec<f64>,
    pub(super) mean_gap: f64,
    pub(super) approach: f64,
    pub(super) mean_height: f64,
    /// Dual gap over mean pressure and standard deviation of the heights: a bound of how far the elastic energy is from
    /// its minimum.
    pub error: f64,
    /// Steps of conjugate gradients on the finest grid.
    pub steps: usize,
    /// Convolutions on the finest grid.
    pub convolutions: usize,
}

impl Contact {
    /// Points along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// Distance of the points along x and y, m.
    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// What lies beyond the border of the map.
    pub fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// The pressure at each point, Pa, the y index running fastest.
    pub fn pressures(&self) -> &[f64] {
        &self.pressures
    }

    /// The mean pressure, Pa.
    pub fn pressure(&self) -> f64 {
        sum_of(self.pressures.len(), |k| self.pressures[k]) / self.pressures.len() as f64
    }

    /// The mean distance of the surfaces, m, zero at points in contact. On a map that repeats it is also the distance of
    /// the flat from the mean plane of the undeformed heights, if nothing yields.
    pub fn mean_gap(&self) -> f64 {
        self.mean_gap
    }

    /// Displacement less height at points in contact, m: how far the flat lies below height 0 of the map, measured far from
    /// the contact. Of a paraboloid with its tip at 0 on a finite map it is the indentation. On a map that repeats it is minus
    /// the mean gap where heights have zero mean and nothing yields.
    pub fn approach(&self) -> f64 {
        self.approach
    }

    /// The distance of the flat from the mean plane of the undeformed heights, m: the mean gap less the mean deflection. Of a
    /// finite patch it is negative under loads that sink the patch further than it is rough.
    pub fn undeformed_gap(&self) -> f64 {
        -self.approach - self.mean_height
    }

    /// Points in contact over all points.
    pub fn raw_area_ratio(&self) -> f64 {
        self.ratio(|p| p > 0.0)
    }

    /// Points at the cap over all points.
    pub fn capped_area_ratio(&self) -> f64 {
        self.ratio(|p| p >= AT_CAP * self.cap)
    }

    /// Contact area over nominal area: the raw ratio, corrected for the points that the border of the contact cuts. No
    /// correction where the contact has no border, in full contact, nor where it is at the cap: a point there bears the
    /// cap on all of its pixel. At least the area that carries the load at the cap.
    pub fn area_ratio(&self) -> f64 {
        let corrected = self.raw_area_ratio() - BORDER * self.border() as f64 / self.pressures.len() as f64;
        corrected.max(self.pressure() / self.cap)
    }

    /// Pairs of neighbours of which one is in contact below the cap and the other is not: sides of pixels that make up the
    /// border of the contact, where the pressure falls to zero.
    pub fn border(&self) -> usize {
        self.sides(|a, b| self.is_border(a, b)).into_iter().sum()
    }

    /// Pairs of neighbours of which one is in contact and the other is not, along x and along y: also where the contact is at the cap.
    pub fn outline(&self) -> [usize; 2] {
        self.sides(|a, b| (a > 0.0) != (b > 0.0))
    }

    /// Pairs of neighbours along x and along y that `differ`, by their pressures.
    fn sides(&self, differ: impl Fn(f64, f64) -> bool + Sync) -> [usize; 2] {
        let [nx, ny] = self.points;
        let wraps = self.boundary.wraps();
        let row = |i: usize| &self.pressures[i * ny..][..ny];
        let of_row = |i: usize| {
            let differ = |a: f64, b: f64| usize::from(differ(a, b));
            let here = row(i);
            let along: usize = here.windows(2).map(|pair| differ(pair[0], pair[1])).sum();
            let around = if wraps { differ(here[0], here[ny - 1]) } else { 0 };
            let next = if i + 1 < nx { Some(i + 1) } else { wraps.then_some(0) };
            let across = next.map_or(0, |next| here.iter().zip(row(next)).map(|(&a, &b)| differ(a, b)).sum());
            [across, along + around]
        };
        (0..nx).into_par_iter().map(of_row).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
    }

    /// Whether neighbours with the pressures `a` and `b` (Pa) make up the border.
    fn is_border(&self, a: f64, b: f64) -> bool {
        (a > 0.0) != (b > 0.0) && a.max(b) < AT_CAP * self.cap
    }

    /// What each block of a division of the points contributes to mean pressure (Pa) and corrected area ratio; `blocks` must
    /// divide as many points. The border between two blocks counts for the first.
    pub fn block_sums(&self, blocks: &Blocks) -> Vec<[f64; 2]> {
        let [nx, ny] = self.points;
        let wraps = self.boundary.wraps();
        let all = self.pressures.len() as f64;
        let mut sums = vec![[0.0; 2]; blocks.count()];
        let at = |i: usize, j: usize| self.pressures[i * ny + j];
        for (k, &p) in self.pressures.iter().enumerate() {
            let (i, j) = (k / ny, k % ny);
            let across = if i + 1 < nx { Some(i + 1) } else { wraps.then_some(0) };
            let along = if j + 1 < ny { Some(j + 1) } else { wraps.then_some(0) };
            let sides = usize::from(across.is_some_and(|i| self.is_border(at(i, j), p)))
                + usize::from(along.is_some_and(|j| self.is_border(at(i, j), p)));
            if p > 0.0 || sides > 0 {
                let [pressure, area] = &mut sums[blocks.of_point(k)];
                *pressure += p / all;
                *area += (f64::from(u8::from(p > 0.0)) - BORDER * sides as f64) / all;
            }
        }
        sums
    }

    fn ratio(&self, is_counted: impl Fn(f64) -> bool) -> f64 {
        let count = self.pressures.iter().filter(|&&p| is_counted(p)).count();
        count as f64 / self.pressures.len() as f64
    }
}
