//! Weighted sums of two Gaussian fields that differ a little in bandwidth, and their summits at every weight without a map
//! of each.
//!
//! Both fields have the same random numbers. With n the standard deviation of a field whose amplitudes along the power law are
//! those of the other, the field at the weight t is (1 - t) n_a a + t n_b b, divided by the standard deviation that is expected
//! of it: the one that is generated of a [`SpectrumShape::Between`](crate::topography::spectrum::SpectrumShape::Between). A
//! point is a summit where all its drops to neighbours are positive: each is linear in t and sets an interval. Points that are summits for some t are found once; the product of any t follows from them alone. A transform of
//! the heights is increasing and keeps the summits.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::{SIGNS, SigmaOf, TargetGenerator, mean_and_sq, sums};
use crate::distribution::Heights;
use crate::numeric::lanes::Real;
use crate::numeric::parallel::{Results, for_each_row, map};
use crate::numeric::sum::{CHUNK, Terms, sums_of_present};
use crate::progress::Progress;
use crate::topography::spectrum::SpectrumError;
use crate::topography::summits::Neighbours;

/// Rows of one task.
const ROWS: usize = 16;

/// Points of a map for each one that is kept, about.
const POINTS: usize = 32;

/// A Gaussian field of unit pixel and unit expected variance.
pub(super) struct Field {
    pub log_bandwidth: f64,
    pub heights: Vec<f64>,
    /// Standard deviation of its points after a transform of heights, where the target is that of the surface.
    pub transformed_sq: Option<f64>,
}

/// A point that is a summit of some mixtures.
#[derive(Clone, Copy)]
struct Point {
    /// The weights between which it is one.
    from: f64,
    to: f64,
    /// Heights of the point and its four nearest neighbours in both fields.
    heights: [[f64; 2]; 5],
}

/// Statistics of the summits of a mixture, with unit pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Summits {
    pub density: f64,
    pub mean_radius: f64,
    /// Standard deviation of the heights that the target prescribes.
    pub sigma: f64,
}

impl Summits {
    pub fn product(&self) -> f64 {
        self.density * self.mean_radius * self.sigma
    }
}

/// All mixtures of two fields.
pub(super) struct Mixtures<'a> {
    generator: &'a TargetGenerator,
    sigma_of: SigmaOf,
    /// The first has the smaller bandwidth.
    pub ends: [Field; 2],
    /// Those that are summits at some weight, in parts.
    points: Vec<Vec<Point>>,
    /// Standard deviations of the fields of equal amplitudes along the power law, and their covariance.
    deviations: [f64; 2],
    covariance: f64,
    /// Mean squares and mean product of the points of both fields, whose means are zero.
    squares: Squares,
}

/// Mean squares of both fields, and between them the mean of their product.
type Squares = [f64; 3];

impl<'a> Mixtures<'a> {
    pub fn new(
        generator: &'a TargetGenerator,
        sigma_of: SigmaOf,
        ends: [Field; 2],
        progress: &dyn Progress,
    ) -> Result<Self, SpectrumError> {
        let [nx, ny] = generator.points;
        let bandwidths = ends.each_ref().map(|end| end.log_bandwidth.exp());
        let variance = |weight: f64| {
            let spectrum = generator.between(bandwidths, weight, 1.0);
            spectrum.map(|spectrum| spectrum.on_grid([nx, ny], [1.0; 2]).variance())
        };
        let [a, b, both] = [variance(0.0)?, variance(1.0)?, variance(0.5)?];
        let deviations = [a.sqrt(), b.sqrt()];
        let search = Search {
            fields: [0, 1].map(|end| ends[end].heights.as_slice()),
            deviations,
            points: [nx, ny],
            neighbours: generator.neighbours,
        };
        let arch = Arch::new();
        let parts = map(nx.div_ceil(ROWS), |k| {
            progress.advance(0.0);
            search.rows(arch, k * ROWS..nx.min((k + 1) * ROWS))
        });
        let mut squares = Squares::default();
        for (part, _) in &parts {
            squares.iter_mut().zip(part).for_each(|(all, part)| *all += part / (nx * ny) as f64);
        }
        let points = parts.into_iter().map(|(_, points)| points).collect();
        let covariance = 2.0 * both - 0.5 * (a + b);
        Ok(Self { generator, sigma_of, ends, points, deviations, covariance, squares })
    }

    /// The logarithm of the bandwidth at a weight: the weighted mean of both.
    pub fn log_bandwidth(&self, t: f64) -> f64 {
        (1.0 - t) * self.ends[0].log_bandwidth + t * self.ends[1].log_bandwidth
    }

    /// Difference of the logarithms of both bandwidths.
    pub fn width(&self) -> f64 {
        self.ends[1].log_bandwidth - self.ends[0].log_bandwidth
    }

    /// Factors of the fields at a weight, so that the variance expected of the sum is 1.
    fn factors(&self, t: f64) -> [f64; 2] {
        let [a, b] = [(1.0 - t) * self.deviations[0], t * self.deviations[1]];
        let deviation = (a * a + b * b + 2.0 * t * (1.0 - t) * self.covariance).sqrt();
        [a / deviation, b / deviation]
    }

    /// The summits at a weight; all 0 if there are none.
    pub fn summits(&self, t: f64) -> Summits {
        let factors = self.factors(t);
        let parts = map(self.points.len(), |k| {
            let points = &self.points[k];
            let mut heights = Vec::with_capacity(5 * points.len());
            for point in points.iter().filter(|point| point.from < t && t < point.to) {
                heights.extend(point.heights.map(|pair| mixed(factors, pair)));
            }
            if self.generator.heights != Heights::GAUSSIAN {
                self.generator.heights.map_normals(&mut heights, 1.0);
            }
            let mut sums = [0.0; 4];
            for [z, near @ ..] in heights.as_chunks::<5>().0 {
                let curvature = 2.0 * z - 0.5 * near.iter().sum::<f64>();
                for (sum, term) in sums.iter_mut().zip([1.0, curvature.recip(), *z, z * z]) {
                    *sum += term;
                }
            }
            sums
        });
        let mut sums = [0.0; 4];
        parts.iter().for_each(|part| sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part));
        let [count, ..] = sums;
        if count == 0.0 {
            return Summits { density: 0.0, mean_radius: 0.0, sigma: 0.0 };
        }
        let [_, mean_radius, mean, square] = sums.map(|sum| sum / count);
        Summits {
            density: count / (self.generator.points[0] * self.generator.points[1]) as f64,
            mean_radius,
            sigma: match self.sigma_of {
                SigmaOf::Summits => (square - mean * mean).max(0.0).sqrt(),
                SigmaOf::Surface => {
                    let [a, b] = [0, 1].map(|end| {
                        self.ends[end].transformed_sq.unwrap_or_else(|| self.squares[2 * end].sqrt())
                    });
                    (1.0 - t) * a + t * b
                }
            },
        }
    }

    /// The heights of the map at a weight about their mean, times a `scale` that may depend on their standard deviation; and this scale.
    pub fn into_heights(
        self,
        t: f64,
        scale: impl Fn(f64) -> f64,
        progress: &dyn Progress,
    ) -> (Vec<f64>, f64) {
        let factors = self.factors(t);
        let Self {
            generator, ends: [Field { mut heights, .. }, Field { heights: other, .. }], squares, ..
        } = self;
        let goes_on = |k: usize| {
            if k.is_multiple_of(SIGNS) {
                progress.advance(0.0);
            }
        };
        let mix = |k: usize, heights: &mut [f64], factors: [f64; 2]| {
            for (z, &other) in heights.iter_mut().zip(&other[k * CHUNK..]) {
                *z = mixed(factors, [*z, other]);
            }
        };
        if generator.heights == Heights::GAUSSIAN {
            let ([a, b], [aa, ab, bb]) = (factors, squares);
            let scale = scale((a * a * aa + 2.0 * a * b * ab + b * b * bb).sqrt());
            for_each_row(&mut heights, CHUNK, &|k, heights| {
                goes_on(k);
                mix(k, heights, factors.map(|factor| scale * factor));
            });
            return (heights, scale);
        }
        let found = Results::new(heights.len().div_ceil(CHUNK));
        for_each_row(&mut heights, CHUNK, &|k, heights| {
            goes_on(k);
            mix(k, heights, factors);
            generator.heights.map_normals(heights, 1.0);
            found.set(k, sums(heights));
        });
        let [mean, sq] = mean_and_sq(&found.into_vec(), heights.len());
        let scale = scale(sq);
        for_each_row(&mut heights, CHUNK, &|_, heights| {
            heights.iter_mut().for_each(|z| *z = scale * (*z - mean));
        });
        (heights, scale)
    }
}

fn mixed(factors: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    factors[0] * a + factors[1] * b
}

/// A search for points that are summits at some weight.
struct Search<'a> {
    fields: [&'a [f64]; 2],
    /// Factors of the fields.
    deviations: [f64; 2],
    points: [usize; 2],
    neighbours: Neighbours,
}

impl Search<'_> {
    /// The points of some rows, and sums over all points of the rows.
    fn rows(&self, arch: Arch, rows: Range<usize>) -> (Squares, Vec<Point>) {
        let [nx, ny] = self.points;
        let mut squares = Squares::default();
        let mut found = Vec::with_capacity(rows.len() * ny / POINTS);
        let mut flags = vec![false; ny];
        for i in rows {
            let windows = self.fields.map(|field| {
                [(i + nx - 1) % nx, i, (i + 1) % nx].map(|row| &field[row * ny..(row + 1) * ny])
            });
            let (sums, _) = sums_of_present(windows.map(|[_, row, _]| row), Products);
            squares.iter_mut().zip(sums).for_each(|(all, sum)| *all += sum);
            arch.dispatch(Mark { windows, flags: &mut flags });
            for (block, eight) in flags.chunks(8).enumerate().filter(|(_, eight)| eight.contains(&true)) {
                let places = (8 * block..).zip(eight).filter(|&(_, &flag)| flag);
                found.extend(places.filter_map(|(place, _)| self.point(windows, place)));
            }
        }
        (squares, found)
    }

    /// The point of the middle row, if it is a summit at some weight.
    fn point(&self, windows: [[&[f64]; 3]; 2], place: usize) -> Option<Point> {
        let ny = self.points[1];
        let at = |[dx, dy]: [isize; 2]| {
            let column = (place + ny).wrapping_add_signed(dy) % ny;
            windows.map(|window| window[(1 + dx) as usize][column])
        };
        let here = at([0, 0]);
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for &step in self.neighbours.steps() {
            let other = at(step);
            let drops = [0, 1].map(|end| self.deviations[end] * (here[end] - other[end]));
            let even = drops[0] / (drops[0] - drops[1]);
            match drops.map(|drop| drop > 0.0) {
                [true, true] => {}
                [true, false] => to = to.min(even),
                [false, true] => from = from.max(even),
                [false, false] => return None,
            }
        }
        let mut heights = [here; 5];
        heights[1..].iter_mut().zip(Neighbours::Four.steps()).for_each(|(pair, &step)| *pair = at(step));
        (from < to).then_some(Point { from, to, heights })
    }
}

/// The terms of [`Squares`].
#[derive(Clone, Copy)]
struct Products;

impl Terms<2, 3> for Products {
    #[inline(always)]
    fn of<N: Real>(self, [a, b]: [N; 2]) -> [N; 3] {
        [a * a, a * b, b * b]
    }
}

/// Marks the points of the middle rows that are above each of the four nearest neighbours in one field or the other, and both
/// ends. Written to be vectorised by the compiler.
struct Mark<'a> {
    windows: [[&'a [f64]; 3]; 2],
    flags: &'a mut [bool],
}

impl WithSimd for Mark<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { windows, flags } = self;
        let inner = flags.len() - 2;
        (flags[0], flags[inner + 1]) = (true, true);
        let flags = &mut flags[1..=inner];
        let [(a, beside_a), (b, beside_b)] = windows.map(|[before, row, after]| {
            (&row[1..=inner], [&before[1..=inner], &after[1..=inner], &row[..inner], &row[2..inner + 2]])
        });
        for i in 0..inner {
            let (a, b) = (a[i], b[i]);
            flags[i] = ((a > beside_a[0][i]) | (b > beside_b[0][i]))
                & ((a > beside_a[1][i]) | (b > beside_b[1][i]))
                & ((a > beside_a[2][i]) | (b > beside_b[2][i]))
                & ((a > beside_a[3][i]) | (b > beside_b[3][i]));
        }
    }
}
