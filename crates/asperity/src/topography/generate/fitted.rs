//! A random process fitted to a map: surfaces of its own autocorrelation and height distribution, of its size and with its missing points.

use std::f64::consts::PI;

use asperity_fft::Complex;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use super::super::fourier::{change_waves, with_small_factors};
use super::super::height_transform::Distortion;
use super::super::spectrum::GridSpectrum;
use super::super::{Boundary, CorrelationLengths, HeightMap, Moments, Rows};
use super::gaussian;
use crate::distribution::normal_nodes;
use crate::numeric::parallel::for_each_row;
use crate::progress::Silent;

/// The smallest number of correlation lengths along each side of a map that a process is fitted to.
const FEWEST_LENGTHS: f64 = 8.0;

/// Why no process is fitted to a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unfitted {
    /// The side of the map is shorter than eight correlation lengths, so that its longest waves are not seen.
    TooShort,
    /// The amplitude of its roughness varies from place to place, which the process does not.
    Patchy,
    /// Its heights do not scatter.
    Flat,
    /// It is periodic: a generated surface, of which more can be generated.
    Periodic,
}

/// A stationary process, Gaussian but for a transform of its heights, with the autocorrelation and the height distribution of a map.
#[derive(Debug, Clone)]
pub struct FittedProcess {
    points: [usize; 2],
    pixel: [f64; 2],
    /// Indices of missing points.
    missing: Vec<usize>,
    /// Of the Gaussian field, on a torus of one and a half times the sides.
    spectrum: GridSpectrum,
    heights: OwnHeights,
    sigma: f64,
    /// Correlation lengths along the sides of the map.
    lengths: [f64; 2],
    own_scatter: f64,
}

impl FittedProcess {
    /// The process of a levelled, filtered map with its moments and correlation lengths.
    ///
    /// The autocorrelation is that of the tapered map over that of the taper (0 and 1 at the ends of a cosine over a quarter of each side), so
    /// that the edges leave no trace in the shortest waves. It is kept up to lags of 0.2 of the sides and goes smoothly to zero at half of them (a
    /// flat-top lag window: Politis and Romano 1995, J. Time Series Analysis 16, 67).
    ///
    /// # Errors
    /// Why none is fitted.
    pub fn new(
        map: &HeightMap,
        moments: &Moments,
        correlation: &CorrelationLengths,
    ) -> Result<Self, Unfitted> {
        let (points, pixel) = (map.points(), map.pixel());
        if map.boundary() == Boundary::Periodic {
            return Err(Unfitted::Periodic);
        }
        let lengths = [0, 1].map(|axis| points[axis] as f64 * pixel[axis] / correlation.lengths[axis]);
        if lengths.iter().any(|lengths| *lengths < FEWEST_LENGTHS) {
            return Err(Unfitted::TooShort);
        }
        if correlation.patches.is_some() {
            return Err(Unfitted::Patchy);
        }
        let heights = OwnHeights::new(map, lengths[0] * lengths[1]).ok_or(Unfitted::Flat)?;
        let torus = points.map(|count| with_small_factors(count + count / 2));
        let mut of_heights = autocorrelation(map, moments.mean, torus);
        let inverse = Distortion::by(|g| heights.at(g)).inverse();
        for_each_row(&mut of_heights, torus[1], &|_, row| {
            row.iter_mut().for_each(|rho| *rho = inverse.of(*rho))
        });
        let missing = map.heights().iter().enumerate().filter(|(_, z)| z.is_nan()).map(|(k, _)| k).collect();
        let spectrum = GridSpectrum::from_autocorrelation(torus, of_heights);
        let own_scatter = roughness_scatter(map);
        Ok(Self { points, pixel, missing, spectrum, heights, sigma: moments.sq, lengths, own_scatter })
    }

    /// Points of its surfaces along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The [scatter of the roughness](roughness_scatter) over the map.
    pub fn own_scatter(&self) -> f64 {
        self.own_scatter
    }

    /// By how much the scatter of samples exceeds that of generated surfaces: the map shows its longest waves only in part, the less the fewer
    /// correlation lengths it holds (`[coverage]`).
    pub fn widening(&self) -> f64 {
        /// Of the mean of 1/lengths along both sides.
        const PER_LENGTH: f64 = 1.4;
        1.0 + PER_LENGTH / (self.lengths[0] * self.lengths[1]).sqrt()
    }

    /// A surface of the process, of the size of the map and with its missing points, not levelled.
    pub fn surface(&self, seed: [u8; 32]) -> HeightMap {
        let torus = self.spectrum.points();
        let mut field = gaussian(&self.spectrum, 1.0, seed);
        for_each_row(&mut field, torus[1], &|_, row| {
            row.iter_mut().for_each(|g| *g = self.sigma * self.heights.at(*g))
        });
        let [nx, ny] = self.points;
        let rows = field.chunks(torus[1]).take(nx);
        let mut heights: Vec<f64> = rows.flat_map(|row| &row[..ny]).copied().collect();
        self.missing.iter().for_each(|&point| heights[point] = f64::NAN);
        HeightMap::of_checked(self.points, self.pixel, heights)
    }
}

/// How much the mean square slope of the blocks of a map (four along each side) scatters: standard deviation over mean. Short waves are so many in
/// a block that it scatters little unless their amplitude varies.
pub fn roughness_scatter(map: &HeightMap) -> f64 {
    const ALONG: usize = 4;
    let ([nx, ny], pixel, heights) = (map.points(), map.pixel(), map.heights());
    let mut sums = [(0.0, 0usize); ALONG * ALONG];
    for (ix, row) in heights.chunks(ny).enumerate() {
        let next = heights.get((ix + 1) * ny..(ix + 2) * ny);
        for (iy, z) in row.iter().enumerate() {
            let (sum, count) = &mut sums[ix * ALONG / nx * ALONG + iy * ALONG / ny];
            let along_x = next.map(|next| (next[iy] - z) / pixel[0]);
            let along_y = row.get(iy + 1).map(|after| (after - z) / pixel[1]);
            for slope in along_x.into_iter().chain(along_y).filter(|slope| !slope.is_nan()) {
                *sum += slope * slope;
                *count += 1;
            }
        }
    }
    let blocks: Vec<f64> =
        sums.iter().filter(|(_, count)| *count > 0).map(|(sum, count)| sum / *count as f64).collect();
    let count = blocks.len() as f64;
    let mean = blocks.iter().sum::<f64>() / count;
    let squares: f64 = blocks.iter().map(|block| (block - mean).powi(2)).sum();
    (squares / (count - 1.0)).sqrt() / mean
}

/// The map from a standard normal g to a height of zero mean and unit standard deviation, from the heights of a map: a cubic through their
/// quantiles at equal steps of g, and beyond those that few independent heights exceed a straight line.
#[derive(Debug, Clone)]
struct OwnHeights {
    /// The lowest g.
    start: f64,
    /// Heights from it on.
    nodes: Vec<f64>,
    mean: f64,
    deviation: f64,
}

/// Distance of the nodes in g.
const STEP: f64 = 0.25;

impl OwnHeights {
    /// Of the present heights of a map, which are worth `independent` independent ones; `None` of a flat map.
    fn new(map: &HeightMap, independent: f64) -> Option<Self> {
        /// Independent heights beyond the outermost nodes.
        const BEYOND: f64 = 0.5;
        let mut sorted: Vec<f64> = map.heights().iter().copied().filter(|z| !z.is_nan()).collect();
        sorted.par_sort_unstable_by(f64::total_cmp);
        let normal = Normal::standard();
        let last = -normal.inverse_cdf((BEYOND / independent).min(0.2));
        let half = (last / STEP).floor();
        let nodes = (0..=2 * half as usize).map(|k| {
            let share = normal.cdf(STEP * (k as f64 - half));
            sorted[((share * sorted.len() as f64) as usize).min(sorted.len() - 1)]
        });
        let raw = Self { start: -STEP * half, nodes: nodes.collect(), mean: 0.0, deviation: 1.0 };
        let moment = |of: &dyn Fn(f64) -> f64| {
            normal_nodes(0.01).map(|[g, weight]| weight * of(raw.at(g))).sum::<f64>()
        };
        let mean = moment(&|z| z);
        let deviation = moment(&|z| (z - mean).powi(2)).sqrt();
        (deviation > 0.0).then_some(Self { mean, deviation, ..raw })
    }

    /// The height at g.
    fn at(&self, g: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let place = (g - self.start) / STEP;
        let slope = |k: usize| {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
            (self.nodes[after] - self.nodes[before]) / (after - before) as f64
        };
        // Slopes beyond the ends go on as between them.
        let beyond = |from: usize, before: usize, steps: f64| {
            let ratio = (slope(from) / slope(before)).abs().clamp(0.1, 4.0).powf(0.5);
            let l = ratio.ln();
            slope(from) * if l.abs() < 1e-3 { steps } else { ((l * steps).exp() - 1.0) / l }
        };
        let height = if place <= 0.0 {
            self.nodes[0] - beyond(1, 3, -place)
        } else if place >= last as f64 {
            self.nodes[last] + beyond(last - 1, last - 3, place - last as f64)
        } else {
            let k = (place as usize).min(last - 1);
            let (t, a, b) = (place - k as f64, self.nodes[k], self.nodes[k + 1]);
            let ends = [k, k + 1].map(|k| {
                if k == 0 {
                    slope(1)
                } else if k == last {
                    slope(last - 1)
                } else {
                    slope(k)
                }
            });
            let s = 1.0 - t;
            s * s * (a * (1.0 + 2.0 * t) + ends[0] * t) + t * t * (b * (1.0 + 2.0 * s) - ends[1] * s)
        };
        (height - self.mean) / self.deviation
    }
}

/// The autocorrelation of an open map about its `mean` (m) on a torus, times the lag window.
fn autocorrelation(map: &HeightMap, mean: f64, torus: [usize; 2]) -> Vec<f64> {
    let points = map.points();
    let tapers = points.map(taper);
    let tapered = |of: &(dyn Fn(f64) -> f64 + Sync)| {
        let mut field = map.embedded(torus, of);
        for_each_row(&mut field[..points[0] * torus[1]], torus[1], &|ix, row| {
            row.iter_mut().zip(&tapers[1]).for_each(|(value, taper)| *value *= tapers[0][ix] * taper);
        });
        pairs(field, torus)
    };
    let products = tapered(&|z| z - mean);
    let weights = tapered(&|_| 1.0);
    let variance = products[0] / weights[0];
    let mut correlation = products;
    for_each_row(&mut correlation, torus[1], &|i, row| {
        for (j, (value, weight)) in row.iter_mut().zip(&weights[i * torus[1]..]).enumerate() {
            let lag = |place: usize, axis: usize| {
                place.min(torus[axis] - place) as f64 / (0.5 * points[axis] as f64)
            };
            let window = lag_window(lag(i, 0).hypot(lag(j, 1)));
            *value = if window > 0.0 { window * *value / (weight * variance) } else { 0.0 };
        }
    });
    correlation
}

/// Sums over all pairs of points of the products of their values, by lag around the border.
fn pairs(mut field: Vec<f64>, points: [usize; 2]) -> Vec<f64> {
    let scale = ((points[0] * points[1]) as f64).recip();
    let power = |_: usize, waves: &mut [Complex<f64>]| {
        waves.iter_mut().for_each(|wave| *wave = Complex::new(wave.norm_sqr(), 0.0));
    };
    change_waves(&mut field, points, scale, &power, &Silent);
    field
}

/// One over the middle half, a cosine from zero over a quarter at each end.
fn taper(count: usize) -> Vec<f64> {
    let at = |k: usize| {
        let from_end = (k.min(count - 1 - k) as f64 + 0.5) / (0.25 * count as f64);
        if from_end < 1.0 { 0.5 - 0.5 * (PI * from_end).cos() } else { 1.0 }
    };
    (0..count).map(at).collect()
}

/// One up to 0.4 of the largest lag, and with all derivatives zero at it.
fn lag_window(lag: f64) -> f64 {
    const FLAT: f64 = 0.4;
    if lag >= 1.0 {
        return 0.0;
    }
    if lag <= FLAT {
        return 1.0;
    }
    let u = (lag - FLAT) / (1.0 - FLAT);
    let bump = |x: f64| (-x.recip()).exp();
    bump(1.0 - u) / (bump(u) + bump(1.0 - u))
}
