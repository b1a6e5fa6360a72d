//! An approximate inverse of the displacements: the part of 1/compliance that acts between neighbours.

use std::array;
use std::f64::consts::PI;

use super::compliance::SurfaceResponse;

/// Wave numbers along each axis at which the compliance is sampled.
const SAMPLES: usize = 128;

/// The least part of its value in the middle that a stencil leaves of a uniform field: above 0, or it is no inverse of a
/// positive operator.
const LEAST: f64 = 0.02;

/// Weights of a point's neighbours along x, along y and at the corners, relative to its own.
#[derive(Debug, Clone, Copy)]
pub struct Stencil {
    /// The weight in the middle, Pa/m: the pressure of a point over its displacement.
    pub centre: f64,
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// At the corners.
    pub corner: f64,
}

impl Stencil {
    /// The 3 x 3 middle of the inverse of `pair`'s response on a grid of `pixel` (m), with a `film` that adds so much of each load to the
    /// field at its point.
    pub fn new(pixel: [f64; 2], pair: &impl SurfaceResponse, film: f64) -> Self {
        let angle = |k: usize| PI * (k as f64 + 0.5) / SAMPLES as f64;
        let angles: [[f64; 2]; SAMPLES] = array::from_fn(|k| [angle(k), angle(k).cos()]);
        let mut sums = [0.0; 4];
        for [x, cos_x] in angles {
            for [y, cos_y] in angles {
                let inverse = (pair.to_wave((x / pixel[0]).hypot(y / pixel[1])) + film).recip();
                for (sum, factor) in sums.iter_mut().zip([1.0, cos_x, cos_y, cos_x * cos_y]) {
                    *sum += inverse * factor;
                }
            }
        }
        let [x, y, corner] = [sums[1], sums[2], sums[3]].map(|sum| sum / sums[0]);
        let neighbours = -(2.0 * (x + y) + 4.0 * corner);
        let scale = if neighbours > 1.0 - LEAST { (1.0 - LEAST) / neighbours } else { 1.0 };
        let centre = sums[0] / (SAMPLES * SAMPLES) as f64;
        Self { centre, x: scale * x, y: scale * y, corner: scale * corner }
    }

    /// The rows that [`Self::apply_row`] needs of a grid with `ny` points a row, for any number of calls.
    pub fn rows(ny: usize) -> [Vec<f64>; 2] {
        [vec![0.0; ny + 2], vec![0.0; ny + 2]]
    }

    /// The inverse applied to a field on a grid of so many points that wraps or not: `each` sees every point of row `i` that has a
    /// value, with that of the inverse. `field` gives the points of a row that have one, and it; it is zero at all others.
    pub fn apply_row<Field: Iterator<Item = (usize, f64)>>(
        &self,
        rows: &mut [Vec<f64>; 2],
        ([nx, ny], wraps): ([usize; 2], bool),
        i: usize,
        field: impl Fn(usize) -> Field,
        mut each: impl FnMut(usize, f64),
    ) {
        let edge = |beyond: usize, opposite: usize| if wraps { opposite } else { beyond };
        let up = if i == 0 { edge(0, nx - 1) } else { i - 1 };
        let down = if i + 1 == nx { edge(i, 0) } else { i + 1 };
        if field(i).next().is_none() {
            return;
        }
        // The field of the row, and that of both beside it; a point more on each side.
        let [here, over] = rows;
        field(i).for_each(|(j, value)| here[j + 1] = value);
        for beside in [up, down] {
            field(beside).for_each(|(j, value)| over[j + 1] += value);
        }
        for row in [&mut *here, &mut *over] {
            (row[0], row[ny + 1]) = if wraps { (row[ny], row[1]) } else { (row[1], row[ny]) };
        }
        for (j, value) in field(i) {
            let beside = here[j] + here[j + 2];
            let corners = over[j] + over[j + 2];
            each(j, value + self.x * over[j + 1] + self.y * beside + self.corner * corners);
        }
        field(i).for_each(|(j, _)| here[j + 1] = 0.0);
        for beside in [up, down] {
            field(beside).for_each(|(j, _)| over[j + 1] = 0.0);
        }
    }
}
